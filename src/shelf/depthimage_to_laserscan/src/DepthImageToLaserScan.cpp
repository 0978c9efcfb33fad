#include <depthimage_to_laserscan/DepthImageToLaserScan.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <boost/make_shared.hpp>
#include <sensor_msgs/image_encodings.h>

namespace depthimage_to_laserscan {

namespace encodings = sensor_msgs::image_encodings;

sensor_msgs::LaserScanPtr DepthImageToLaserScan::convert_msg(const sensor_msgs::ImageConstPtr& depth,
                                                             const sensor_msgs::CameraInfoConstPtr& info) {
  const bool millimetres = depth->encoding == encodings::TYPE_16UC1 || depth->encoding == encodings::MONO16;
  if (!millimetres && depth->encoding != encodings::TYPE_32FC1)
    throw std::runtime_error("Depth image has unsupported encoding: " + depth->encoding);
  const size_t pixel = millimetres ? sizeof(uint16_t) : sizeof(float);
  if (depth->width < 2 || depth->step < depth->width * pixel || depth->data.size() < size_t(depth->step) * depth->height)
    throw std::runtime_error("Depth image holds fewer bytes than its width, height and step say");
  camera_.fromCameraInfo(info);
  if (!(camera_.fx() > 0) || !std::isfinite(camera_.fx()) || !std::isfinite(camera_.cx()) || !std::isfinite(camera_.cy()))
    throw std::runtime_error("camera_info has no focal length (K is zero): is the camera calibrated?");
  if (scan_height_ / 2 > camera_.cy() || scan_height_ / 2 > depth->height - camera_.cy())
    throw std::runtime_error("scan_height ( " + std::to_string(scan_height_) + " pixels) is too large for the image height.");

  auto scan = boost::make_shared<sensor_msgs::LaserScan>();
  scan->header = depth->header;
  if (!output_frame_id_.empty()) scan->header.frame_id = output_frame_id_;
  // The scan turns to the left, the image's columns run to the right.
  scan->angle_min = -std::atan((depth->width - 1 - camera_.cx()) / camera_.fx());
  scan->angle_max = std::atan(camera_.cx() / camera_.fx());
  scan->angle_increment = (scan->angle_max - scan->angle_min) / (depth->width - 1);
  scan->scan_time = scan_time_;
  scan->range_min = range_min_;
  scan->range_max = range_max_;
  scan->ranges.assign(depth->width, std::numeric_limits<float>::quiet_NaN());
  if (millimetres) take_rows<uint16_t>(*depth, 0.001f, *scan);
  else take_rows<float>(*depth, 1.0f, *scan);
  return scan;
}

template <typename T>
void DepthImageToLaserScan::take_rows(const sensor_msgs::Image& depth, float metres, sensor_msgs::LaserScan& scan) const {
  const int first = std::max(0, int(camera_.cy() - scan_height_ / 2));
  const int last = std::min(int(depth.height), first + scan_height_);
  for (uint32_t column = 0; column < depth.width; ++column) {
    const double sideways = (column - camera_.cx()) / camera_.fx();  // m for each m of depth
    const double index = (-std::atan(sideways) - scan.angle_min) / scan.angle_increment;
    // Rounding may put the outermost columns a hair outside; the image has them, so the scan has them.
    float& range = scan.ranges[std::clamp(int(index + 1e-6), 0, int(depth.width) - 1)];
    const double stretch = std::sqrt(1.0 + sideways * sideways);
    for (int row = first; row < last; ++row) {
      T value;
      std::memcpy(&value, &depth.data[size_t(row) * depth.step + column * sizeof(T)], sizeof(T));
      const double seen = std::is_floating_point<T>::value || value != 0 ? value * double(metres) * stretch
                                                                         : std::numeric_limits<double>::quiet_NaN();
      if (!std::isfinite(seen)) {
        if (std::isnan(range) && !std::isnan(seen)) range = float(seen);  // "nothing there" says more than "not known"
      } else if (scan.range_min <= seen && seen <= scan.range_max && !(std::isfinite(range) && range <= seen)) {
        range = float(seen);
      }
    }
  }
}

}  // namespace depthimage_to_laserscan
