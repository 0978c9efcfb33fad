#pragma once

#include <string>

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>

namespace depthimage_to_laserscan {

/// A laser scan from the middle rows of a depth image (16UC1 in mm, 32FC1 in m).
///
/// Each column of the image is one angle of the scan; of the rows the nearest point counts that is within the range limits.
/// The camera is taken to look along the scan's plane: the rows' height above it is left out.
class DepthImageToLaserScan {
 public:
  /// Throws std::runtime_error with one line if the encoding, the image's size or the camera's matrix does not serve.
  sensor_msgs::LaserScanPtr convert_msg(const sensor_msgs::ImageConstPtr& depth, const sensor_msgs::CameraInfoConstPtr& info);

  void set_scan_time(float seconds) { scan_time_ = seconds; }
  void set_range_limits(float minimum, float maximum) { range_min_ = minimum, range_max_ = maximum; }
  void set_scan_height(int rows) { scan_height_ = rows; }
  void set_output_frame(const std::string& frame_id) { output_frame_id_ = frame_id; }

 private:
  template <typename T>
  void take_rows(const sensor_msgs::Image& depth, float metres, sensor_msgs::LaserScan& scan) const;

  image_geometry::PinholeCameraModel camera_;
  float scan_time_ = 1.0f / 30.0f, range_min_ = 0.45f, range_max_ = 10.0f;
  int scan_height_ = 1;
  std::string output_frame_id_;
};

}  // namespace depthimage_to_laserscan
