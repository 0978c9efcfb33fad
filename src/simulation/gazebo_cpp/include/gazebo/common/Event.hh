// Events: functions that are called together. A connection ends when its last pointer goes.
#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/Time.hh>

namespace gazebo
{
namespace internal
{

/// Whose code runs in this thread: "model plugin 'x' (libx.so)"; null: the simulator's own. The text lives for ever.
GAZEBO_VISIBLE const char* CurrentPlugin();

/// While it lives, the code of a plugin runs in this thread; a crash is then known to be its.
class GAZEBO_VISIBLE Running
{
public:
  Running(const char* who, const char* what);
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

private:
  const char* before_;
  alignas(8) char call_[32];
};

/// One line for the user; who shows it.
GAZEBO_VISIBLE void Report(bool error, const std::string& line);
GAZEBO_VISIBLE void SetReporter(std::function<void(bool error, const std::string& line)> f);

/// One line for what a plugin threw.
GAZEBO_VISIBLE void Failed(const char* who, const char* what, const char* reason);

}  // namespace internal

namespace event
{

struct Slot
{
  std::atomic<bool> on{ true };
  const char* owner = internal::CurrentPlugin();
  int id = 0;
  virtual ~Slot() = default;
};

class Event
{
public:
  virtual ~Event() = default;
  virtual void Disconnect(int id) = 0;
  bool GetSignaled() const { return Signaled(); }
  bool Signaled() const { return signaled_; }
  void SetSignaled(bool signaled) { signaled_ = signaled; }

private:
  std::atomic<bool> signaled_{ false };
};

class GAZEBO_VISIBLE Connection
{
public:
  Connection() = default;
  explicit Connection(std::weak_ptr<Slot> slot) : slot_(std::move(slot)) {}
  ~Connection()
  {
    if (const auto slot = slot_.lock())
      slot->on = false;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  int Id() const
  {
    const auto slot = slot_.lock();
    return slot ? slot->id : -1;
  }
  int GetId() const { return Id(); }

private:
  std::weak_ptr<Slot> slot_;
};

template <typename T>
class EventT : public Event
{
  struct Function : Slot
  {
    std::function<T> call;
  };
  using Functions = std::vector<std::shared_ptr<Function>>;

  struct State
  {
    std::mutex mutex;
    std::shared_ptr<const Functions> functions = std::make_shared<Functions>();
    int next = 0;
  };

public:
  EventT() = default;
  EventT(const EventT&) = delete;
  EventT& operator=(const EventT&) = delete;

  /// Plugins end their connections by calling the destructor of an event that is a member: it runs twice. Nobody is called then.
  ~EventT() override { delete state_.exchange(nullptr); }

  ConnectionPtr Connect(const std::function<T>& subscriber)
  {
    State* const state = state_;
    if (!state)
      return ConnectionPtr(new Connection);
    const auto added = std::make_shared<Function>();
    added->call = subscriber;
    const std::lock_guard<std::mutex> lock(state->mutex);
    added->id = state->next++;
    auto functions = std::make_shared<Functions>();
    for (const auto& function : *state->functions)
      if (function->on)
        functions->push_back(function);
    functions->push_back(added);
    state->functions = functions;
    return ConnectionPtr(new Connection(added));
  }

  void Disconnect(int id) override
  {
    const auto functions = all();
    for (const auto& function : *functions)
      if (function->id == id)
        function->on = false;
  }
  void Disconnect(const ConnectionPtr& connection)
  {
    if (connection)
      Disconnect(connection->Id());
  }

  unsigned int ConnectionCount() const
  {
    unsigned int count = 0;
    const auto functions = all();
    for (const auto& function : *functions)
      count += function->on;
    return count;
  }

  template <typename... Arguments>
  void operator()(const Arguments&... arguments)
  {
    Signal(arguments...);
  }

  /// What a plugin throws ends its connection, with one line.
  template <typename... Arguments>
  void Signal(const Arguments&... arguments)
  {
    SetSignaled(true);
    const auto functions = all();  // kept while they are called: a callback may connect another
    for (const auto& function : *functions)
    {
      if (!function->on)
        continue;
      const internal::Running running(function->owner, "update");
      try
      {
        function->call(arguments...);
      }
      catch (const std::exception& error)
      {
        function->on = false;
        internal::Failed(function->owner, "update", error.what());
      }
      catch (...)
      {
        function->on = false;
        internal::Failed(function->owner, "update", nullptr);
      }
    }
  }

private:
  std::shared_ptr<const Functions> all() const
  {
    State* const state = state_;
    if (!state)
      return std::make_shared<Functions>();
    const std::lock_guard<std::mutex> lock(state->mutex);
    return state->functions;
  }

  std::atomic<State*> state_{ new State };
};

}  // namespace event
}  // namespace gazebo
