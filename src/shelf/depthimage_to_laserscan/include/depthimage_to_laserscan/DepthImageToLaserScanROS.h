#pragma once

#include <mutex>

#include <depthimage_to_laserscan/DepthConfig.h>
#include <depthimage_to_laserscan/DepthImageToLaserScan.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>

namespace depthimage_to_laserscan {

/// Listens to `image` and its camera_info while somebody listens to `scan`; parameters by dynamic_reconfigure.
class DepthImageToLaserScanROS {
 public:
  DepthImageToLaserScanROS(ros::NodeHandle& node, ros::NodeHandle& parameters);

 private:
  void listen_while_wanted();
  void take(const sensor_msgs::ImageConstPtr& depth, const sensor_msgs::CameraInfoConstPtr& info);
  void configure(DepthConfig& config, uint32_t level);

  std::mutex connecting_, converting_;
  ros::NodeHandle parameters_;
  image_transport::ImageTransport images_;
  image_transport::CameraSubscriber camera_;
  ros::Publisher scans_;
  DepthImageToLaserScan converter_;
  dynamic_reconfigure::Server<DepthConfig> server_;
};

}  // namespace depthimage_to_laserscan
