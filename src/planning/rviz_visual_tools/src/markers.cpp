// The collected markers and their way to RViz.
#include <rviz_visual_tools/rviz_visual_tools.h>

#include "log_name.hpp"

namespace rviz_visual_tools {
namespace {

const double POLL = 0.005;  // s

void normalize(geometry_msgs::Quaternion& q) {
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (norm < std::numeric_limits<double>::epsilon()) {
    q = geometry_msgs::Quaternion();
    q.w = 1;
    return;
  }
  q.x /= norm;
  q.y /= norm;
  q.z /= norm;
  q.w /= norm;
}

void invert(std_msgs::ColorRGBA& color) {
  color.r = 1 - color.r;
  color.g = 1 - color.g;
  color.b = 1 - color.b;
}

}  // namespace

const std::string RvizVisualTools::NAME = "visual_tools";

RvizVisualTools::RvizVisualTools(std::string base_frame, std::string marker_topic, ros::NodeHandle nh)
    : nh_(nh), marker_topic_(std::move(marker_topic)), base_frame_(std::move(base_frame)) {
  loadRvizMarkers();
}

std::vector<visualization_msgs::Marker*> RvizVisualTools::kinds() {
  return {&arrow_marker_,  &sphere_marker_,     &block_marker_,     &cylinder_marker_, &mesh_marker_,    &text_marker_,
          &cuboid_marker_, &line_strip_marker_, &line_list_marker_, &spheres_marker_,  &triangle_marker_};
}

bool RvizVisualTools::loadRvizMarkers() {
  using visualization_msgs::Marker;
  const auto type = [](Marker& marker, int kind, const char* ns) {
    marker.type = kind;
    marker.ns = ns;
  };
  type(arrow_marker_, Marker::ARROW, "Arrow");
  type(cuboid_marker_, Marker::CUBE, "Cuboid");
  type(line_strip_marker_, Marker::LINE_STRIP, "Line");
  type(line_list_marker_, Marker::LINE_LIST, "Line_List");
  type(spheres_marker_, Marker::SPHERE_LIST, "Spheres");
  type(block_marker_, Marker::CUBE, "Block");
  type(cylinder_marker_, Marker::CYLINDER, "Cylinder");
  type(mesh_marker_, Marker::MESH_RESOURCE, "mesh");
  type(sphere_marker_, Marker::SPHERE, "Sphere");
  type(text_marker_, Marker::TEXT_VIEW_FACING, "Text");
  type(triangle_marker_, Marker::TRIANGLE_LIST, "Triangle");
  for (Marker* marker : kinds()) {
    marker->action = Marker::ADD;
    marker->header.frame_id = base_frame_;
    marker->lifetime = marker_lifetime_;
    marker->pose = getIdentityPose();
  }
  type(reset_marker_, Marker::ARROW, "deleteAllMarkers");
  reset_marker_.action = Marker::DELETEALL;
  reset_marker_.header.frame_id = base_frame_;
  reset_marker_.pose = getIdentityPose();
  return true;
}

bool RvizVisualTools::deleteAllMarkers() { return publishMarker(reset_marker_); }

void RvizVisualTools::resetMarkerCounts() {
  for (visualization_msgs::Marker* marker : kinds()) ++marker->id;
}

void RvizVisualTools::setLifetime(double lifetime) {
  marker_lifetime_ = ros::Duration(lifetime);
  for (visualization_msgs::Marker* marker : kinds()) marker->lifetime = marker_lifetime_;
}

std_msgs::Header RvizVisualTools::header() const {
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = base_frame_;
  return header;
}

void RvizVisualTools::loadMarkerPub(bool wait_for_subscriber, bool latched) {
  if (pub_rviz_markers_) return;
  pub_rviz_markers_ = nh_.advertise<visualization_msgs::MarkerArray>(marker_topic_, 10, latched);
  ROS_DEBUG_STREAM_NAMED(LOGNAME, "Publishing Rviz markers on topic " << pub_rviz_markers_.getTopic());
  if (wait_for_subscriber) waitForSubscriber(pub_rviz_markers_);
}

void RvizVisualTools::waitForMarkerPub() { waitForSubscriber(pub_rviz_markers_, 0, true); }
void RvizVisualTools::waitForMarkerPub(double wait_time) { waitForSubscriber(pub_rviz_markers_, wait_time); }

bool RvizVisualTools::waitForSubscriber(const ros::Publisher& pub, double wait_time, bool blocking) {
  if (!pub) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "loadMarkerPub() has not been called yet, unable to wait for subscriber.");
    return false;
  }
  if (blocking && pub.getNumSubscribers() == 0)
    ROS_INFO_STREAM_NAMED(LOGNAME, "Topic '" << pub.getTopic() << "' waiting for subscriber...");
  // Wall time: a program waits no longer where the simulation is slow, and not for ever where it stands still.
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(wait_time);
  while (pub.getNumSubscribers() == 0) {
    if (!blocking && ros::WallTime::now() > end) {
      ROS_WARN_STREAM_NAMED(LOGNAME, "Topic '" << pub.getTopic() << "' unable to connect to any subscribers within "
                                               << wait_time
                                               << " sec. It is possible initially published visual "
                                                  "messages will be lost.");
      return false;
    }
    ros::spinOnce();
    ros::WallDuration(POLL).sleep();
    if (!ros::ok()) return false;
  }
  pub_rviz_markers_connected_ = true;
  return true;
}

bool RvizVisualTools::publishMarker(visualization_msgs::Marker& marker) {
  marker.frame_locked = frame_locking_enabled_;
  markers_.markers.push_back(marker);
  return batch_publishing_enabled_ || trigger();
}

void RvizVisualTools::enableBatchPublishing(bool enable) { batch_publishing_enabled_ = enable; }
void RvizVisualTools::enableFrameLocking(bool enable) { frame_locking_enabled_ = enable; }

bool RvizVisualTools::triggerEvery(std::size_t queueSize) {
  return (queueSize == 0 || markers_.markers.size() >= queueSize) && trigger();
}

bool RvizVisualTools::trigger() {
  if (markers_.markers.empty()) return false;
  const bool sent = publishMarkers(markers_);
  markers_.markers.clear();
  return sent;
}

bool RvizVisualTools::publishMarkers(visualization_msgs::MarkerArray& markers) {
  loadMarkerPub();
  if (!pub_rviz_markers_waited_ && !pub_rviz_markers_connected_) {
    waitForSubscriber(pub_rviz_markers_);
    pub_rviz_markers_waited_ = true;
  }
  if (markers.markers.empty()) return false;
  for (visualization_msgs::Marker& marker : markers.markers) {
    normalize(marker.pose.orientation);
    if (!psychedelic_mode_) continue;
    invert(marker.color);
    for (std_msgs::ColorRGBA& color : marker.colors) invert(color);
  }
  pub_rviz_markers_.publish(markers);
  return true;
}

void RvizVisualTools::prompt(const std::string& msg) { getRemoteControl()->waitForNextStep(msg); }

RemoteControlPtr& RvizVisualTools::getRemoteControl() {
  loadRemoteControl();
  return remote_control_;
}

void RvizVisualTools::loadRemoteControl() {
  if (remote_control_) return;
  remote_control_ = std::make_shared<RemoteControl>(nh_);
  ros::spinOnce();
}

}  // namespace rviz_visual_tools
