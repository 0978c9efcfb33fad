#include <moveit/background_processing/background_processing.h>

#include <ros/console.h>

namespace moveit
{
namespace tools
{
BackgroundProcessing::BackgroundProcessing() : thread_([this]() { work(); }) {}

BackgroundProcessing::~BackgroundProcessing()
{
  {
    std::lock_guard<std::mutex> lock(lock_);
    running_ = false;
    jobs_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

void BackgroundProcessing::addJob(const JobCallback& job, const std::string& name)
{
  {
    std::lock_guard<std::mutex> lock(lock_);
    jobs_.emplace_back(name, job);
  }
  changed_.notify_all();
  tell(ADD, name);
}

std::size_t BackgroundProcessing::getJobCount() const
{
  std::lock_guard<std::mutex> lock(lock_);
  return jobs_.size() + (busy_ ? 1 : 0);
}

void BackgroundProcessing::clear()
{
  std::deque<std::pair<std::string, JobCallback>> dropped;
  {
    std::lock_guard<std::mutex> lock(lock_);
    dropped.swap(jobs_);
  }
  for (const auto& job : dropped)
    tell(REMOVE, job.first);
}

void BackgroundProcessing::setJobUpdateEvent(const JobUpdateCallback& event)
{
  std::lock_guard<std::mutex> lock(lock_);
  event_ = event;
}

void BackgroundProcessing::tell(JobEvent event, const std::string& name)
{
  JobUpdateCallback callback;
  {
    std::lock_guard<std::mutex> lock(lock_);
    callback = event_;
  }
  if (callback)
    callback(event, name);
}

void BackgroundProcessing::work()
{
  std::unique_lock<std::mutex> lock(lock_);
  while (running_)
  {
    if (jobs_.empty())
    {
      changed_.wait(lock);
      continue;
    }
    const std::pair<std::string, JobCallback> job = jobs_.front();
    jobs_.pop_front();
    busy_ = true;
    lock.unlock();
    try
    {
      job.second();
    }
    catch (const std::exception& error)
    {
      ROS_ERROR_NAMED("background_processing", "Exception caught while processing action '%s': %s", job.first.c_str(),
                      error.what());
    }
    lock.lock();
    busy_ = false;
    lock.unlock();
    tell(COMPLETE, job.first);
    lock.lock();
  }
}
}  // namespace tools
}  // namespace moveit
