// A six-axis mouse (sensor_msgs/Joy on spacenav/joy) jogs the arm of a node servo_server: the axes are a twist, the two buttons turn
// ~joint_name. For another device, copy this and change it.
#include <control_msgs/JointJog.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "spacenav_to_twist");
  ros::NodeHandle nh;
  const std::string joint = ros::NodeHandle("~").param<std::string>("joint_name", "shoulder_pan_joint");
  ros::Publisher twists = nh.advertise<geometry_msgs::TwistStamped>("servo_server/delta_twist_cmds", 1);
  ros::Publisher jogs = nh.advertise<control_msgs::JointJog>("servo_server/delta_joint_cmds", 1);
  const boost::function<void(const sensor_msgs::JoyConstPtr&)> translate = [&](const sensor_msgs::JoyConstPtr& joy) {
    if (joy->axes.size() < 6 || joy->buttons.size() < 2)
    {
      ROS_WARN_THROTTLE(10, "A Joy message of %zu axes and %zu buttons is skipped: six and two are needed", joy->axes.size(),
                        joy->buttons.size());
      return;
    }
    geometry_msgs::TwistStamped twist;
    twist.header.stamp = ros::Time::now();
    twist.twist.linear.x = joy->axes[0];
    twist.twist.linear.y = joy->axes[1];
    twist.twist.linear.z = joy->axes[2];
    twist.twist.angular.x = joy->axes[3];
    twist.twist.angular.y = joy->axes[4];
    twist.twist.angular.z = joy->axes[5];
    control_msgs::JointJog jog;
    jog.header.stamp = twist.header.stamp;
    jog.joint_names.push_back(joint);
    jog.velocities.push_back(joy->buttons[0] - joy->buttons[1]);
    twists.publish(twist);
    jogs.publish(jog);
  };
  const ros::Subscriber subscriber = nh.subscribe<sensor_msgs::Joy>("spacenav/joy", 1, translate);
  ros::spin();
  return 0;
}
