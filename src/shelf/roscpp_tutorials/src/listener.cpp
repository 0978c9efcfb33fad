// Logs what it hears.
#include <ros/ros.h>
#include <std_msgs/String.h>

namespace {
void hear(const std_msgs::String::ConstPtr& message) { ROS_INFO("I heard: [%s]", message->data.c_str()); }
}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "listener");
  ros::NodeHandle node;
  const ros::Subscriber subscriber = node.subscribe("chatter", 1000, hear);
  ros::spin();
}
