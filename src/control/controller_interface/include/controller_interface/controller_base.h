// Life of a controller: constructed -> initialized -> running <-> stopped, waiting, aborted.
#pragma once

#include <memory>
#include <vector>

#include <hardware_interface/robot_hw.h>
#include <ros/node_handle.h>

namespace controller_interface
{

/// Derive from Controller or MultiInterfaceController instead.
///
/// starting, update, stopping, waiting and aborting are called by the control loop and must not block.
class ControllerBase
{
public:
  ControllerBase() = default;
  virtual ~ControllerBase() = default;
  ControllerBase(const ControllerBase&) = delete;
  ControllerBase& operator=(const ControllerBase&) = delete;
  ControllerBase(ControllerBase&&) = delete;
  ControllerBase& operator=(ControllerBase&&) = delete;

  /// Once, before the first update.
  virtual void starting(const ros::Time& /*time*/) {}
  /// In every cycle while running. \param period since the last cycle
  virtual void update(const ros::Time& time, const ros::Duration& period) = 0;
  /// Once, after the last update.
  virtual void stopping(const ros::Time& /*time*/) {}
  /// In every cycle while the hardware is still switching for this controller.
  virtual void waiting(const ros::Time& /*time*/) {}
  /// When the hardware failed to switch.
  virtual void aborting(const ros::Time& /*time*/) {}

  bool isInitialized() const { return state_ == ControllerState::INITIALIZED; }
  bool isRunning() const { return state_ == ControllerState::RUNNING; }
  bool isStopped() const { return state_ == ControllerState::STOPPED; }
  bool isWaiting() const { return state_ == ControllerState::WAITING; }
  bool isAborted() const { return state_ == ControllerState::ABORTED; }

  /// Updates it if it is running.
  void updateRequest(const ros::Time& time, const ros::Duration& period)
  {
    if (state_ == ControllerState::RUNNING)
      update(time, period);
  }

  // The following four are refused before the controller is initialised.

  bool startRequest(const ros::Time& time) { return enter(ControllerState::RUNNING, &ControllerBase::starting, time, "start"); }
  bool stopRequest(const ros::Time& time) { return enter(ControllerState::STOPPED, &ControllerBase::stopping, time, "stop"); }
  bool waitRequest(const ros::Time& time) { return enter(ControllerState::WAITING, &ControllerBase::waiting, time, "wait"); }
  bool abortRequest(const ros::Time& time) { return enter(ControllerState::ABORTED, &ControllerBase::aborting, time, "abort"); }

  typedef std::vector<hardware_interface::InterfaceResources> ClaimedResources;

  /// Initialise. \param[out] claimed_resources one entry for each interface \return false: refused, the log says why
  virtual bool initRequest(hardware_interface::RobotHW* robot_hw, ros::NodeHandle& root_nh, ros::NodeHandle& controller_nh,
                           ClaimedResources& claimed_resources) = 0;

  enum class ControllerState
  {
    CONSTRUCTED,
    INITIALIZED,
    RUNNING,
    STOPPED,
    WAITING,
    ABORTED
  };

  ControllerState state_ = ControllerState::CONSTRUCTED;

private:
  bool enter(ControllerState state, void (ControllerBase::*call)(const ros::Time&), const ros::Time& time, const char* verb)
  {
    if (state_ == ControllerState::CONSTRUCTED)
    {
      ROS_FATAL("Failed to %s controller. It is not initialized.", verb);
      return false;
    }
    (this->*call)(time);
    state_ = state;
    return true;
  }
};

typedef std::shared_ptr<ControllerBase> ControllerBaseSharedPtr;

}  // namespace controller_interface
