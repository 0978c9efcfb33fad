#include <compiled_plugins/guard.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <execinfo.h>
#include <mutex>
#include <pthread.h>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <ros/console.h>

namespace compiled_plugins
{

std::atomic<std::uint32_t> tick{ 0 };

namespace
{

constexpr std::uint32_t patience = 10;  // ticks: 5 s
constexpr int most_libraries = 256;
constexpr int most_frames = 64;
const int signals[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };

struct sigaction before[NSIG];
const char* libraries[most_libraries];  // never freed: handlers of signals read them
std::atomic<int> library_count{ 0 };

std::mutex& threads_mutex()
{
  static std::mutex* mutex = new std::mutex;  // threads end after static objects
  return *mutex;
}

std::vector<Doing*>& threads()
{
  static std::vector<Doing*>* all = new std::vector<Doing*>;
  return *all;
}

/// That of this thread, once it has called a plugin. Handlers of signals read it, and must not make one.
thread_local Doing* mine = nullptr;

/// One for each thread that ever called a plugin.
struct Registered
{
  Doing doing;

  Registered()
  {
    const std::lock_guard<std::mutex> lock(threads_mutex());
    threads().push_back(&doing);
    mine = &doing;
  }

  ~Registered()
  {
    const std::lock_guard<std::mutex> lock(threads_mutex());
    for (std::size_t i = 0; i < threads().size(); ++i)
      if (threads()[i] == &doing)
      {
        threads()[i] = threads().back();
        threads().pop_back();
        return;
      }
  }
};

// -- what a handler of a signal may do: no allocation, no lock ---------------------------------------------------------------------

struct Line
{
  char text[1024];
  std::size_t length = 0;

  Line& operator<<(const char* more)
  {
    const std::size_t size = std::min(std::strlen(more), sizeof text - length);
    std::memcpy(text + length, more, size);
    length += size;
    return *this;
  }

  void show() const
  {
    const ssize_t written = write(STDERR_FILENO, text, length);
    (void)written;
  }
};

const char* name_of(int signal)
{
  switch (signal)
  {
    case SIGSEGV:
      return "segmentation fault";
    case SIGBUS:
      return "bus error";
    case SIGFPE:
      return "arithmetic error, such as a whole number divided by 0";
    case SIGILL:
      return "illegal instruction";
    case SIGABRT:
      return "aborted: a failed assertion, or an exception that nobody caught";
    default:
      return "signal";
  }
}

/// The first remembered library that is on the stack, or null.
const char* library_on_stack()
{
  void* frames[most_frames];
  const int depth = backtrace(frames, most_frames);
  for (int i = 0; i < depth; ++i)
  {
    Dl_info info;
    if (!dladdr(frames[i], &info) || !info.dli_fname)
      continue;
    for (int l = 0; l < library_count; ++l)
      if (!std::strcmp(info.dli_fname, libraries[l]))
        return libraries[l];
  }
  return nullptr;
}

void crashed(int signal, siginfo_t*, void*)
{
  sigaction(signal, &before[signal], nullptr);  // whatever happens below: once
  const char* who = mine ? mine->who.load() : nullptr;
  const char* library = who ? nullptr : library_on_stack();
  if (who || library)
  {
    Line line;
    line << "\033[31m[FATAL] ";
    if (who)
      line << who << " crashed in its " << mine->what;
    else
      line << "the plugin library " << library << " crashed in a thread or callback of its own";
    line << ": " << name_of(signal) << ". The process ends\033[0m\n";
    line.show();
  }
  if (signal == SIGABRT)
    raise(signal);
  // the others come again from the same instruction, to whoever had the signal before
}

/// Ends the process here: the other threads still run (those of roscpp, say), and static objects would be destroyed below them.
void at_exit(int status, void*)
{
  if (!mine || !mine->who)
    return;
  Line line;
  line << "\033[31m[FATAL] " << mine->who << " called exit() in its " << mine->what << ". The process ends\033[0m\n";
  line.show();
  std::fflush(nullptr);
  _exit(status);
}

// ----------------------------------------------------------------------------------------------------------------------------------

void look()
{
  const std::uint32_t now = ++tick;
  const std::lock_guard<std::mutex> lock(threads_mutex());
  for (Doing* thread : threads())
  {
    const char* who = thread->who;
    if (!who || now - thread->since < patience)
      thread->reported = false;
    else if (!thread->reported.exchange(true))
      ROS_ERROR("%s has not come back from its %s for 5 s: it blocks, and what called it waits", who, thread->what.load());
  }
}

void keep_looking()
{
  while (true)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    look();
  }
}

}  // namespace

Doing& doing()
{
  static thread_local Registered own;
  return own.doing;
}

void watch()
{
  static std::once_flag once;
  std::call_once(once, [] {
    void* frames[2];
    backtrace(frames, 2);  // loads what it needs now, as a handler must not
    struct sigaction action;
    std::memset(&action, 0, sizeof action);
    action.sa_sigaction = crashed;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (const int signal : signals)
      sigaction(signal, &action, &before[signal]);
    on_exit(at_exit, nullptr);
    std::thread(keep_looking).detach();
  });
}

void remember(const std::string& library)
{
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const int count = library_count;
  for (int i = 0; i < count; ++i)
    if (library == libraries[i])
      return;
  if (count < most_libraries)
  {
    libraries[count] = strdup(library.c_str());
    library_count = count + 1;
  }
}

}  // namespace compiled_plugins
