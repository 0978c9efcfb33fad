// The arm follows a pose that begins 10 cm beside its own and climbs.
#include <thread>

#include <moveit_servo/pose_tracking.h>

#include "example.hpp"

int main(int argc, char** argv)
{
  ros::init(argc, argv, "pose_tracking_example");
  ros::NodeHandle nh("~");
  ros::AsyncSpinner spinner(8);
  spinner.start();
  const auto monitor = monitorScene();
  if (!monitor)
    return EXIT_FAILURE;
  moveit_servo::PoseTracking tracker(nh, monitor);
  ros::Publisher targets = nh.advertise<geometry_msgs::PoseStamped>("target_pose", 1, true);
  const ros::Subscriber status = printStatus(nh, tracker.servo_->getParameters().status_topic);
  while (ros::ok() && targets.getNumSubscribers() == 0)
    ros::WallDuration(0.01).sleep();

  geometry_msgs::TransformStamped now;
  tracker.getCommandFrameTransform(now);
  geometry_msgs::PoseStamped target;
  target.header.frame_id = now.header.frame_id;
  target.pose.position.x = now.transform.translation.x + 0.1;
  target.pose.position.y = now.transform.translation.y;
  target.pose.position.z = now.transform.translation.z;
  target.pose.orientation = now.transform.rotation;
  tracker.resetTargetPose();
  target.header.stamp = ros::Time::now();
  targets.publish(target);

  std::thread mover([&tracker] {
    const auto code = tracker.moveToPose(Eigen::Vector3d(0.01, 0.01, 0.01), 0.1, 0.1);
    ROS_INFO_STREAM("Pose tracking: " << moveit_servo::POSE_TRACKING_STATUS_CODE_MAP.at(code));
  });
  ros::Rate rate(50);
  for (int i = 0; ros::ok() && i < 500; ++i)
  {
    target.pose.position.z += 0.0004;
    target.header.stamp = ros::Time::now();
    targets.publish(target);
    rate.sleep();
  }
  tracker.stopMotion();
  mover.join();
  return EXIT_SUCCESS;
}
