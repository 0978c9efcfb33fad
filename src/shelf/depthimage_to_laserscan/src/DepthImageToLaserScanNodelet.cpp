#include <memory>

#include <depthimage_to_laserscan/DepthImageToLaserScanROS.h>
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

namespace depthimage_to_laserscan {

class DepthImageToLaserScanNodelet : public nodelet::Nodelet {
  void onInit() override { converter_ = std::make_unique<DepthImageToLaserScanROS>(getNodeHandle(), getPrivateNodeHandle()); }

  std::unique_ptr<DepthImageToLaserScanROS> converter_;
};

}  // namespace depthimage_to_laserscan

PLUGINLIB_EXPORT_CLASS(depthimage_to_laserscan::DepthImageToLaserScanNodelet, nodelet::Nodelet)
