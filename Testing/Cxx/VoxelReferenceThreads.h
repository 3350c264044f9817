/**
 * @file   VoxelReferenceThreads.h
 * @brief  The one parallel loop of the reference implementations, on plain std::thread.
 */
#ifndef VoxelReferenceThreads_h
#define VoxelReferenceThreads_h

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace VoxelReference
{

/// Calls body(begin, end, thread) on consecutive ranges of at most `grain` items that together
/// cover [0, count). Threads take the ranges as they become free; the caller's thread is number 0.
template <typename Body>
void ParallelFor(std::int64_t count, std::int64_t grain, int threads, Body&& body)
{
  std::atomic<std::int64_t> next{ 0 };
  const auto work = [&](int thread)
  {
    for (std::int64_t begin = next.fetch_add(grain); begin < count; begin = next.fetch_add(grain))
    {
      body(begin, std::min(begin + grain, count), thread);
    }
  };

  const auto useful = std::min<std::int64_t>(threads, (count + grain - 1) / grain);
  std::vector<std::thread> helpers;
  for (int thread = 1; thread < useful; ++thread)
  {
    helpers.emplace_back(work, thread);
  }
  work(0);
  for (std::thread& helper : helpers)
  {
    helper.join();
  }
}

}

#endif
