#include "jobs.hpp"

#include <ros/console.h>

namespace moveit_rviz_plugin {

Jobs::Jobs() : thread_([this]() { work(); }) {}

Jobs::~Jobs() { end(); }

void Jobs::end() {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    ending_ = true;
    count_ -= static_cast<int>(jobs_.size());
    jobs_.clear();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  for (Spawned& spawned : spawned_)
    if (spawned.thread.joinable()) spawned.thread.join();
  spawned_.clear();
  const std::lock_guard<std::mutex> lock(later_lock_);
  later_.clear();
}

void Jobs::add(Job job) {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    if (ending_) return;
    ++count_;
    jobs_.push_back(std::move(job));
  }
  changed_.notify_one();
}

void Jobs::spawn(Job job) {
  const std::lock_guard<std::mutex> lock(lock_);
  if (ending_) return;
  for (auto it = spawned_.begin(); it != spawned_.end();) {
    if (!it->done) {
      ++it;
      continue;
    }
    it->thread.join();
    it = spawned_.erase(it);
  }
  ++count_;
  Spawned& spawned = spawned_.emplace_back();
  spawned.thread = std::thread([this, &spawned, job]() {
    run(job);
    spawned.done = true;
  });
}

void Jobs::later(Job job) {
  const std::lock_guard<std::mutex> lock(later_lock_);
  if (!ending_) later_.push_back(std::move(job));
}

void Jobs::runLater() {
  std::deque<Job> now;
  {
    const std::lock_guard<std::mutex> lock(later_lock_);
    now.swap(later_);
  }
  for (const Job& job : now) job();
}

void Jobs::work() {
  for (;;) {
    Job job;
    {
      std::unique_lock<std::mutex> lock(lock_);
      changed_.wait(lock, [this]() { return ending_ || !jobs_.empty(); });
      if (ending_) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    run(job);
  }
}

void Jobs::run(const Job& job) {
  try {
    job();
  } catch (const std::exception& error) {
    ROS_ERROR_NAMED("moveit_rviz_plugin", "%s", error.what());
  }
  --count_;
}

}  // namespace moveit_rviz_plugin
