#include <depthimage_to_laserscan/DepthImageToLaserScanROS.h>

namespace depthimage_to_laserscan {

DepthImageToLaserScanROS::DepthImageToLaserScanROS(ros::NodeHandle& node, ros::NodeHandle& parameters)
    : parameters_(parameters), images_(node), server_(parameters) {
  server_.setCallback([this](DepthConfig& config, uint32_t level) { configure(config, level); });
  const auto changed = [this](const ros::SingleSubscriberPublisher&) { listen_while_wanted(); };
  std::lock_guard<std::mutex> guard(connecting_);  // a subscriber may come before scans_ is there
  scans_ = node.advertise<sensor_msgs::LaserScan>("scan", 10, changed, changed);
}

void DepthImageToLaserScanROS::listen_while_wanted() {
  std::lock_guard<std::mutex> guard(connecting_);
  if (scans_.getNumSubscribers() == 0) camera_.shutdown();
  else if (!camera_)
    camera_ = images_.subscribeCamera("image", 10, &DepthImageToLaserScanROS::take, this,
                                      image_transport::TransportHints("raw", ros::TransportHints(), parameters_));
}

void DepthImageToLaserScanROS::take(const sensor_msgs::ImageConstPtr& depth, const sensor_msgs::CameraInfoConstPtr& info) {
  try {
    std::lock_guard<std::mutex> guard(converting_);
    scans_.publish(converter_.convert_msg(depth, info));
  } catch (const std::runtime_error& error) {
    ROS_ERROR_THROTTLE(1.0, "Could not convert depth image to laserscan: %s", error.what());
  }
}

void DepthImageToLaserScanROS::configure(DepthConfig& config, uint32_t) {
  std::lock_guard<std::mutex> guard(converting_);
  converter_.set_scan_time(float(config.scan_time));
  converter_.set_range_limits(float(config.range_min), float(config.range_max));
  converter_.set_scan_height(config.scan_height);
  converter_.set_output_frame(config.output_frame_id);
}

}  // namespace depthimage_to_laserscan
