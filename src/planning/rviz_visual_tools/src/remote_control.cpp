#include <rviz_visual_tools/remote_control.h>

#include <cstdlib>
#include <iostream>

namespace rviz_visual_tools {
namespace {

const char LOGNAME[] = "remote_control";
const char CYAN[] = "\033[96m", PLAIN[] = "\033[0m";
const double POLL = 0.05;  // s of wall time: a paused simulation does not keep a prompt from being answered

}  // namespace

RemoteControl::RemoteControl(const ros::NodeHandle& nh) : nh_(nh) {
  dashboard_ = nh_.subscribe<sensor_msgs::Joy>("/rviz_visual_tools_gui", 10, &RemoteControl::rvizDashboardCallback, this);
  ROS_INFO_STREAM_NAMED(LOGNAME, "RemoteControl Ready.");
}

void RemoteControl::rvizDashboardCallback(const sensor_msgs::Joy::ConstPtr& msg) {
  const auto pressed = [&](std::size_t button) { return msg->buttons.size() > button && msg->buttons[button] != 0; };
  if (pressed(1)) setReadyForNextStep();
  else if (pressed(2)) setAutonomous();
  else if (pressed(3)) setFullAutonomous();
  else if (pressed(4)) setStop();
  else ROS_ERROR_STREAM_NAMED(LOGNAME, "Unknown input button");
}

bool RemoteControl::setReadyForNextStep() {
  stop_ = false;
  if (is_waiting_) next_step_ready_ = true;
  return true;
}

void RemoteControl::setAutonomous(bool autonomous) {
  autonomous_ = autonomous;
  stop_ = false;
}

void RemoteControl::setFullAutonomous(bool autonomous) {
  full_autonomous_ = autonomous;
  autonomous_ = autonomous;
  stop_ = false;
}

void RemoteControl::setStop(bool stop) {
  if (stop) setFullAutonomous(false);
  stop_ = stop;
}

bool RemoteControl::getStop() { return stop_; }
bool RemoteControl::getAutonomous() { return autonomous_; }
bool RemoteControl::getFullAutonomous() { return full_autonomous_; }

bool RemoteControl::waitForNextStep(const std::string& caption) { return wait(caption, autonomous_); }
bool RemoteControl::waitForNextFullStep(const std::string& caption) { return wait(caption, full_autonomous_); }

bool RemoteControl::wait(const std::string& caption, const std::atomic<bool>& autonomous) {
  if (next_step_ready_ || autonomous || !ros::ok()) return true;
  std::cout << std::endl << CYAN << "Waiting to continue: " << caption << PLAIN << std::flush;
  if (display_waiting_state_) display_waiting_state_(true);
  is_waiting_ = true;
  while (!next_step_ready_ && !autonomous && ros::ok()) {
    ros::WallDuration(POLL).sleep();
    ros::spinOnce();
  }
  if (!ros::ok()) std::exit(0);
  next_step_ready_ = false;
  is_waiting_ = false;
  std::cout << CYAN << "... continuing" << PLAIN << std::endl;
  if (display_waiting_state_) display_waiting_state_(false);
  return true;
}

}  // namespace rviz_visual_tools
