// An interactive marker with six degrees of freedom.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <Eigen/Geometry>
#include <geometry_msgs/PoseStamped.h>
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>
#include <visualization_msgs/InteractiveMarker.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>

namespace rviz_visual_tools {

using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;

typedef std::function<void(const visualization_msgs::InteractiveMarkerFeedbackConstPtr&)> IMarkerCallback;

class IMarkerSimple {
 public:
  /// Serves the marker on `~<name>`; scale in m, the pose in parent_frame.
  explicit IMarkerSimple(const std::string& name = "imarker", double scale = 0.2,
                         const geometry_msgs::Pose& initial_pose = identity(), const std::string& parent_frame = "world");

  /// Where the marker was dragged to last, in its parent frame.
  geometry_msgs::Pose& getPose();
  void setPose(const Eigen::Isometry3d& pose);
  void setPose(const geometry_msgs::Pose& pose);

  void iMarkerCallback(const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback);

  /// Called for each change of the pose by the mouse.
  void setIMarkerCallback(IMarkerCallback callback) { imarker_callback_ = std::move(callback); }

 private:
  static geometry_msgs::Pose identity() {
    geometry_msgs::Pose pose;
    pose.orientation.w = 1;
    return pose;
  }

  ros::NodeHandle nh_;
  geometry_msgs::Pose latest_pose_;
  std::shared_ptr<interactive_markers::InteractiveMarkerServer> imarker_server_;
  visualization_msgs::InteractiveMarker int_marker_;
  IMarkerCallback imarker_callback_;
};

typedef std::shared_ptr<IMarkerSimple> IMarkerSimplePtr;
typedef std::shared_ptr<const IMarkerSimple> IMarkerSimpleConstPtr;

}  // namespace rviz_visual_tools
