// Finishing an action's goal from a control loop: the loop says how, a timer tells the client.
#pragma once

#include <memory>
#include <mutex>

#include <actionlib/server/action_server.h>
#include <ros/timer.h>

namespace realtime_tools
{

template <class Action>
class RealtimeServerGoalHandle
{
private:
  ACTION_DEFINITION(Action)
  typedef actionlib::ServerGoalHandle<Action> GoalHandle;

public:
  GoalHandle gh_;
  ResultPtr preallocated_result_;      // for the loop, which must not allocate
  FeedbackPtr preallocated_feedback_;  // likewise

  RealtimeServerGoalHandle(GoalHandle& gh, const ResultPtr& preallocated_result = ResultPtr(),
                           const FeedbackPtr& preallocated_feedback = FeedbackPtr())
    : gh_(gh)
    , preallocated_result_(preallocated_result)
    , preallocated_feedback_(preallocated_feedback)
  {
    if (!preallocated_result_)
      preallocated_result_.reset(new Result);
    if (!preallocated_feedback_)
      preallocated_feedback_.reset(new Feedback);
  }

  // For the loop. The first of these three holds.

  void setAborted(ResultConstPtr result = ResultConstPtr()) { end(End::ABORTED, result); }
  void setCanceled(ResultConstPtr result = ResultConstPtr()) { end(End::CANCELED, result); }
  void setSucceeded(ResultConstPtr result = ResultConstPtr()) { end(End::SUCCEEDED, result); }

  void setFeedback(FeedbackConstPtr feedback = FeedbackConstPtr())
  {
    const std::lock_guard<std::mutex> locked(mutex_);
    feedback_ = feedback;
  }

  bool valid() { return gh_.getGoal() != nullptr; }

  /// For a timer: tells the client what the loop has said.
  void runNonRealtime(const ros::TimerEvent& /*event*/)
  {
    typedef actionlib_msgs::GoalStatus Status;
    if (!valid())
      return;
    const Status status = gh_.getGoalStatus();
    const bool preempting = status.status == Status::PREEMPTING;
    const bool open = status.status == Status::ACTIVE || preempting;
    End how;
    ResultConstPtr last_words;
    FeedbackConstPtr feedback;
    {
      const std::lock_guard<std::mutex> locked(mutex_);
      const bool fits = end_ == End::CANCELED ? preempting : open;
      how = fits && !told_ ? end_ : End::NOT_YET;
      told_ = told_ || how != End::NOT_YET;
      last_words = result_;
      feedback = feedback_;
    }
    const Result result = last_words ? *last_words : Result();
    if (how == End::ABORTED)
      gh_.setAborted(result);
    else if (how == End::CANCELED)
      gh_.setCanceled(result);
    else if (how == End::SUCCEEDED)
      gh_.setSucceeded(result);
    if (feedback && status.status == Status::ACTIVE)
      gh_.publishFeedback(*feedback);
  }

private:
  enum class End
  {
    NOT_YET,
    ABORTED,
    CANCELED,
    SUCCEEDED
  };

  void end(End how, const ResultConstPtr& result)
  {
    const std::lock_guard<std::mutex> locked(mutex_);
    if (end_ != End::NOT_YET)
      return;
    result_ = result;
    end_ = how;
  }

  std::mutex mutex_;  // held for the copies of pointers alone
  End end_ = End::NOT_YET;
  bool told_ = false;
  ResultConstPtr result_;
  FeedbackConstPtr feedback_;
};

}  // namespace realtime_tools
