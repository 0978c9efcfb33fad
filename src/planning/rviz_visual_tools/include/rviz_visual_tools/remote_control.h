// Step by step through a program from the panel in RViz (buttons of a sensor_msgs/Joy on /rviz_visual_tools_gui).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

namespace rviz_visual_tools {

/// Told true when the program begins to wait, false when it goes on.
typedef std::function<void(bool)> DisplayWaitingState;

class RemoteControl {
 public:
  explicit RemoteControl(const ros::NodeHandle& nh);

  /// Button 1: next step, 2: run on, 3: run on over full steps too, 4: stop.
  void rvizDashboardCallback(const sensor_msgs::Joy::ConstPtr& msg);

  /// Let the step go on that waits now.
  bool setReadyForNextStep();

  /// Wait at no step any more.
  void setAutonomous(bool autonomous = true);
  void setFullAutonomous(bool autonomous = true);
  bool getAutonomous();
  bool getFullAutonomous();

  /// Wait at each step again.
  void setStop(bool stop = true);
  bool getStop();

  /// Print the caption and wait until the next step is asked for. The process ends when ROS does meanwhile.
  bool waitForNextStep(const std::string& caption = "go to next step");
  bool waitForNextFullStep(const std::string& caption = "go to next full step");

  bool isWaiting() { return is_waiting_; }
  void setDisplayWaitingState(DisplayWaitingState display) { display_waiting_state_ = std::move(display); }

 private:
  bool wait(const std::string& caption, const std::atomic<bool>& autonomous);

  ros::NodeHandle nh_;
  ros::Subscriber dashboard_;
  std::atomic<bool> is_waiting_{false};
  std::atomic<bool> next_step_ready_{false};
  std::atomic<bool> autonomous_{false};
  std::atomic<bool> full_autonomous_{false};
  std::atomic<bool> stop_{false};
  DisplayWaitingState display_waiting_state_;
};

typedef std::shared_ptr<RemoteControl> RemoteControlPtr;
typedef std::shared_ptr<const RemoteControl> RemoteControlConstPtr;

}  // namespace rviz_visual_tools
