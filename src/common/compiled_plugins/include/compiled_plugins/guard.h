// Whose compiled code runs at this moment: for the one line that names it when it crashes, blocks or ends the process.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace compiled_plugins
{

/// What a thread is doing in plugins. Written by that thread, read by the watchdog and by the handlers of signals.
struct Doing
{
  std::atomic<const char*> who{ nullptr };   // "controller 'arm' (my_controllers/Arm, /home/.../libmy_controllers.so)"
  std::atomic<const char*> what{ nullptr };  // "update()"
  std::atomic<std::uint32_t> since{ 0 };     // tick of the watchdog at which it began
  std::atomic<bool> reported{ false };
};

/// That of the calling thread.
Doing& doing();

/// Ticks of the watchdog, two each second.
extern std::atomic<std::uint32_t> tick;

/// While it lives, the thread is in ``what`` of ``who``. Both texts have to live as long. Costs some nanoseconds.
class Call
{
public:
  Call(const char* who, const char* what) : doing_(doing()), who_(doing_.who), what_(doing_.what), since_(doing_.since)
  {
    doing_.since.store(tick.load(std::memory_order_relaxed), std::memory_order_relaxed);
    doing_.what.store(what, std::memory_order_relaxed);
    doing_.who.store(who, std::memory_order_relaxed);
  }

  ~Call()
  {
    doing_.who.store(who_, std::memory_order_relaxed);
    doing_.what.store(what_, std::memory_order_relaxed);
    doing_.since.store(since_, std::memory_order_relaxed);
  }

  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

private:
  Doing& doing_;
  const char* who_;
  const char* what_;
  std::uint32_t since_;
};

/// Begin to watch: crashes, exit() and calls of 5 s and more are named from now on. May be called again.
void watch();

/// A library of plugins: a crash in one of its own threads is then known to be its.
void remember(const std::string& library);

/// Why the library cannot be loaded, in words: not there, a library that it needs is not there, or it lacks symbols that this
/// process does not have either; "" if it can be. Symbols that a library beside it defines are supplied by loading that one, with a
/// warning; else nothing is loaded.
std::string why_not(const std::string& library);

}  // namespace compiled_plugins
