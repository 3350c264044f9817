// Part of executables that run under the leak sanitizer. Loaded libraries stay where they are: the
// leaks of an OpenGL driver that was unloaded before the end could not be told by its name.
extern "C" int dlclose(void*) noexcept
{
  return 0;
}
