// The other end of RemoteControl: what the panel's buttons send.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

namespace rviz_visual_tools {

class RemoteReciever {
 public:
  RemoteReciever() : joy_publisher_(nh_.advertise<sensor_msgs::Joy>("/rviz_visual_tools_gui", 1)) {}

  void publishNext() { press(1); }
  void publishContinue() { press(2); }
  void publishBreak() { press(3); }
  void publishStop() { press(4); }

 protected:
  void press(std::size_t button) {
    sensor_msgs::Joy msg;
    msg.buttons.resize(9);
    msg.buttons[button] = 1;
    joy_publisher_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher joy_publisher_;
};

}  // namespace rviz_visual_tools
