// Who executes trajectories: handles of controllers, and a manager that knows them.
#pragma once

#include <moveit_msgs/RobotTrajectory.h>
#include <ros/duration.h>

#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>

namespace moveit_controller_manager
{
struct ExecutionStatus
{
  enum Value
  {
    UNKNOWN,
    RUNNING,
    SUCCEEDED,
    PREEMPTED,
    TIMED_OUT,
    ABORTED,
    FAILED
  };
  ExecutionStatus(Value value = UNKNOWN) : status_(value) {}
  operator Value() const { return status_; }
  explicit operator bool() const { return status_ == SUCCEEDED; }
  std::string asString() const
  {
    static const char* const names[] = { "UNKNOWN", "RUNNING", "SUCCEEDED", "PREEMPTED", "TIMED_OUT", "ABORTED", "FAILED" };
    return names[status_];
  }

private:
  Value status_;
};

MOVEIT_CLASS_FORWARD(MoveItControllerHandle);

class MoveItControllerHandle
{
public:
  MoveItControllerHandle(const std::string& name) : name_(name) {}
  virtual ~MoveItControllerHandle() {}
  const std::string& getName() const { return name_; }
  virtual bool sendTrajectory(const moveit_msgs::RobotTrajectory& trajectory) = 0;  // returns at once
  virtual bool cancelExecution() = 0;
  // 0: for as long as it takes. True when it has ended, well or not.
  virtual bool waitForExecution(const ros::Duration& timeout = ros::Duration(0)) = 0;
  virtual ExecutionStatus getLastExecutionStatus() = 0;

protected:
  std::string name_;
};

MOVEIT_CLASS_FORWARD(MoveItControllerManager);

class MoveItControllerManager
{
public:
  struct ControllerState
  {
    bool active_ = false;   // takes trajectories now
    bool default_ = false;  // preferred where several would do
  };
  MoveItControllerManager() {}
  virtual ~MoveItControllerManager() {}
  virtual MoveItControllerHandlePtr getControllerHandle(const std::string& name) = 0;
  virtual void getControllersList(std::vector<std::string>& names) = 0;
  virtual void getActiveControllers(std::vector<std::string>& names) = 0;
  virtual void getControllerJoints(const std::string& name, std::vector<std::string>& joints) = 0;
  virtual ControllerState getControllerState(const std::string& name) = 0;
  virtual bool switchControllers(const std::vector<std::string>& activate, const std::vector<std::string>& deactivate) = 0;
};
}  // namespace moveit_controller_manager
