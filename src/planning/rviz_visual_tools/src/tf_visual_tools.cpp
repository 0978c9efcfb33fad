#include <rviz_visual_tools/tf_visual_tools.h>

#include <tf2_eigen/tf2_eigen.h>

namespace rviz_visual_tools {

TFVisualTools::TFVisualTools(double loop_hz) {
  non_realtime_loop_ = nh_.createTimer(ros::Duration(1 / loop_hz), &TFVisualTools::publishAllTransforms, this);
  ROS_INFO_STREAM_NAMED("tf_visual_tools", "TFVisualTools Ready.");
}

bool TFVisualTools::publishTransform(const Eigen::Isometry3d& transform, const std::string& from_frame,
                                     const std::string& to_frame) {
  geometry_msgs::TransformStamped stamped = tf2::eigenToTransform(transform);
  stamped.header.stamp = ros::Time::now();
  stamped.header.frame_id = from_frame;
  stamped.child_frame_id = to_frame;
  for (geometry_msgs::TransformStamped& known : transforms_)
    if (known.child_frame_id == to_frame && known.header.frame_id == from_frame) {
      known = stamped;
      return true;
    }
  transforms_.push_back(stamped);
  return true;
}

void TFVisualTools::clearAllTransforms() { transforms_.clear(); }

void TFVisualTools::publishAllTransforms(const ros::TimerEvent&) {
  for (geometry_msgs::TransformStamped& transform : transforms_) transform.header.stamp = ros::Time::now();
  tf_pub_.sendTransform(transforms_);
}

}  // namespace rviz_visual_tools
