// Work that may wait for other nodes, kept out of the window's thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

namespace moveit_rviz_plugin {

// Jobs run one after another in one thread (`add`), or beside it (`spawn`); what they have to show runs in the window's
// thread (`later`), which calls `runLater` at each of its updates.
class Jobs {
 public:
  using Job = std::function<void()>;

  Jobs();
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  void add(Job job);
  void spawn(Job job);
  void later(Job job);
  void runLater();

  // Waiting jobs are dropped, running ones are waited for. Long jobs ask `ending` now and then. Nothing is taken after it.
  void end();
  bool ending() const { return ending_; }
  // How many are waiting or running.
  int count() const { return count_; }

 private:
  void work();
  void run(const Job& job);

  std::atomic<bool> ending_{false};
  std::atomic<int> count_{0};
  std::mutex lock_, later_lock_;
  std::condition_variable changed_;
  std::deque<Job> jobs_, later_;
  struct Spawned {
    std::thread thread;
    std::atomic<bool> done{false};
  };
  std::list<Spawned> spawned_;
  std::thread thread_;
};

// Where a sum of errors is told once: a line is logged when it differs from the last one.
class Told {
 public:
  bool news(const std::string& line) {
    if (line == last_) return false;
    last_ = line;
    return !line.empty();
  }

 private:
  std::string last_;
};

}  // namespace moveit_rviz_plugin
