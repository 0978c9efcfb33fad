#include <rviz_visual_tools/imarker_simple.h>

#include <tf2_eigen/tf2_eigen.h>

namespace rviz_visual_tools {
namespace {

const char NAME[] = "imarker_simple";

// A ring to turn about and an arrow to move along the axis that the orientation turns x to.
void addAxis(visualization_msgs::InteractiveMarker& marker, const std::string& axis, double x, double y, double z) {
  InteractiveMarkerControl control;
  control.orientation.w = std::sqrt(0.5);
  control.orientation.x = x * std::sqrt(0.5);
  control.orientation.y = y * std::sqrt(0.5);
  control.orientation.z = z * std::sqrt(0.5);
  control.name = "rotate_" + axis;
  control.interaction_mode = InteractiveMarkerControl::ROTATE_AXIS;
  marker.controls.push_back(control);
  control.name = "move_" + axis;
  control.interaction_mode = InteractiveMarkerControl::MOVE_AXIS;
  marker.controls.push_back(control);
}

}  // namespace

IMarkerSimple::IMarkerSimple(const std::string& name, double scale, const geometry_msgs::Pose& initial_pose,
                             const std::string& parent_frame)
    : nh_("~"), latest_pose_(initial_pose) {
  imarker_server_ = std::make_shared<interactive_markers::InteractiveMarkerServer>(nh_.getNamespace() + "/" + name, "", false);
  int_marker_.header.frame_id = parent_frame;
  int_marker_.pose = initial_pose;
  int_marker_.scale = scale;
  int_marker_.name = NAME;
  addAxis(int_marker_, "x", 1, 0, 0);
  addAxis(int_marker_, "z", 0, 1, 0);
  addAxis(int_marker_, "y", 0, 0, 1);
  imarker_server_->insert(int_marker_, [this](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
    iMarkerCallback(feedback);
  });
  imarker_server_->applyChanges();
}

geometry_msgs::Pose& IMarkerSimple::getPose() { return latest_pose_; }

void IMarkerSimple::setPose(const Eigen::Isometry3d& pose) { setPose(tf2::toMsg(pose)); }

void IMarkerSimple::setPose(const geometry_msgs::Pose& pose) {
  latest_pose_ = pose;
  imarker_server_->setPose(int_marker_.name, latest_pose_);
  imarker_server_->applyChanges();
}

void IMarkerSimple::iMarkerCallback(const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
  if (feedback->event_type != visualization_msgs::InteractiveMarkerFeedback::POSE_UPDATE) return;
  latest_pose_ = feedback->pose;
  if (imarker_callback_) imarker_callback_(feedback);
}

}  // namespace rviz_visual_tools
