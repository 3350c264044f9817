"""What the benchmarks in Python share."""
import time

# A measurement takes no longer than this, unless one run does.
SECONDS = 10


def minimum(function, times=5):
    """Milliseconds that a function takes at best; it runs once at least, and `times` times if there is time."""
    best = float("inf")
    begin = time.perf_counter()
    for _ in range(times):
        start = time.perf_counter()
        function()
        end = time.perf_counter()
        best = min(best, end - start)
        if end - begin > SECONDS:
            break
    return 1e3 * best
