// Servoing within a program: two seconds by a twist, two by a joint.
#include <moveit_servo/make_shared_from_pool.h>

#include "example.hpp"

int main(int argc, char** argv)
{
  ros::init(argc, argv, "cpp_interface_example");
  ros::NodeHandle nh("~");
  ros::AsyncSpinner spinner(8);
  spinner.start();
  const auto monitor = monitorScene();
  if (!monitor)
    return EXIT_FAILURE;
  moveit_servo::Servo servo(nh, monitor);
  servo.start();
  const auto& parameters = servo.getParameters();
  const ros::Subscriber status = printStatus(nh, parameters.status_topic);
  ros::Publisher twists = nh.advertise<geometry_msgs::TwistStamped>(parameters.cartesian_command_in_topic, 1);
  ros::Publisher jogs = nh.advertise<control_msgs::JointJog>(parameters.joint_command_in_topic, 1);

  ros::Rate rate(100);
  for (int i = 0; ros::ok() && i < 200; ++i)
  {
    const auto msg = moveit::util::make_shared_from_pool<geometry_msgs::TwistStamped>();
    msg->header.stamp = ros::Time::now();
    msg->header.frame_id = parameters.planning_frame;
    msg->twist.linear.y = 0.01;
    msg->twist.linear.z = -0.01;
    twists.publish(msg);
    rate.sleep();
  }
  ros::Duration(2.0).sleep();  // it halts after incoming_command_timeout
  for (int i = 0; ros::ok() && i < 200; ++i)
  {
    const auto msg = moveit::util::make_shared_from_pool<control_msgs::JointJog>();
    msg->header.stamp = ros::Time::now();
    msg->joint_names.push_back(
        monitor->getRobotModel()->getJointModelGroup(parameters.move_group_name)->getActiveJointModelNames()[2]);
    msg->velocities.push_back(0.2);
    jogs.publish(msg);
    rate.sleep();
  }
  servo.setPaused(true);
  return EXIT_SUCCESS;
}
