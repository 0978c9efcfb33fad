#include <depthimage_to_laserscan/DepthImageToLaserScanROS.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "depthimage_to_laserscan");
  ros::NodeHandle node, parameters("~");
  depthimage_to_laserscan::DepthImageToLaserScanROS converter(node, parameters);
  ros::spin();
}
