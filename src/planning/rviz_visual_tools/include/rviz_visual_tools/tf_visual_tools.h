// Frames that a program publishes again and again, to see them in RViz.
#pragma once

#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>

#include <Eigen/Geometry>
#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

namespace rviz_visual_tools {

class TFVisualTools {
 public:
  /// @param loop_hz how often the frames are published, in Hz
  explicit TFVisualTools(double loop_hz = 2);

  /// Publish to_frame in from_frame from now on, in place of what was given for this pair before.
  bool publishTransform(const Eigen::Isometry3d& transform, const std::string& from_frame, const std::string& to_frame);
  void clearAllTransforms();
  void publishAllTransforms(const ros::TimerEvent& e);

 private:
  ros::NodeHandle nh_;
  tf2_ros::TransformBroadcaster tf_pub_;
  ros::Timer non_realtime_loop_;
  std::vector<geometry_msgs::TransformStamped> transforms_;
};

typedef boost::shared_ptr<TFVisualTools> TFVisualToolsPtr;
typedef boost::shared_ptr<const TFVisualTools> TFVisualToolsConstPtr;

}  // namespace rviz_visual_tools
