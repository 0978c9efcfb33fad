// Finishing an action's goal from a control loop: the loop says how, a timer tells the client.
#pragma once

#include <memory>

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

  void setFeedback(FeedbackConstPtr feedback = FeedbackConstPtr()) { feedback_ = feedback; }

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
    const Result result = result_ ? *result_ : Result();
    if (end_ == End::ABORTED && open)
      gh_.setAborted(result);
    else if (end_ == End::CANCELED && preempting)
      gh_.setCanceled(result);
    else if (end_ == End::SUCCEEDED && open)
      gh_.setSucceeded(result);
    if (feedback_ && status.status == Status::ACTIVE)
      gh_.publishFeedback(*feedback_);
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
    if (end_ != End::NOT_YET)
      return;
    result_ = result;
    end_ = how;
  }

  End end_ = End::NOT_YET;
  ResultConstPtr result_;
  FeedbackConstPtr feedback_;
};

}  // namespace realtime_tools
