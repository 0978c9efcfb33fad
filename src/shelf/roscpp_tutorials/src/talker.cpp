// Says hello ten times a second.
#include <ros/ros.h>
#include <std_msgs/String.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<std_msgs::String>("chatter", 1000);
  ros::Rate rate(10);  // Hz
  for (int count = 0; ros::ok(); ++count) {
    std_msgs::String message;
    message.data = "hello world " + std::to_string(count);
    ROS_INFO("%s", message.data.c_str());
    publisher.publish(message);
    ros::spinOnce();
    rate.sleep();
  }
}
