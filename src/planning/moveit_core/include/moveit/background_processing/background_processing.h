// Jobs that are done one after the other in a thread of their own.
#pragma once

#include <boost/function.hpp>
#include <boost/noncopyable.hpp>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace moveit
{
namespace tools
{
class BackgroundProcessing : private boost::noncopyable
{
public:
  enum JobEvent
  {
    ADD,
    REMOVE,
    COMPLETE
  };
  typedef boost::function<void(JobEvent, const std::string&)> JobUpdateCallback;
  typedef boost::function<void()> JobCallback;

  BackgroundProcessing();
  ~BackgroundProcessing();  // waits for the job that is being done; the others are dropped

  void addJob(const JobCallback& job, const std::string& name);
  std::size_t getJobCount() const;  // also the one that is being done
  void clear();                     // all that have not begun
  void setJobUpdateEvent(const JobUpdateCallback& event);
  void clearJobUpdateEvent() { setJobUpdateEvent(JobUpdateCallback()); }

private:
  void work();
  void tell(JobEvent event, const std::string& name);

  mutable std::mutex lock_;
  std::condition_variable changed_;
  std::deque<std::pair<std::string, JobCallback>> jobs_;
  JobUpdateCallback event_;
  bool running_ = true, busy_ = false;
  std::thread thread_;
};
}  // namespace tools
}  // namespace moveit
