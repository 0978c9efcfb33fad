// Depth images as PNG or RVL in sensor_msgs/CompressedImage, and back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

namespace compressed_depth_image_transport {

struct Settings {
  std::string format = "png";         // or "rvl"
  double depth_max = 10.0;            // m; farther is unknown
  double depth_quantization = 100.0;  // m, where one step of a float image is 1 m
  int png_level = 1;                  // 1 to 9
};

// 16UC1 (mm) as it is; 32FC1 (m) as 16 bits of inverse depth.
// Throws std::runtime_error, in one line, for other images.
sensor_msgs::CompressedImage encode(const sensor_msgs::Image& image, const Settings& settings);

// What was unknown is 0 in 16UC1, NaN in 32FC1.
// Throws std::runtime_error, in one line, for what is no compressed depth.
sensor_msgs::ImagePtr decode(const sensor_msgs::CompressedImage& message);

// RVL (A. Wilson: Fast lossless depth image compression, 2017): runs of zeros and of others, numbers and differences in
// groups of three bits.
std::vector<uint8_t> rvlEncode(const uint16_t* pixels, size_t count);
// Throws std::runtime_error when the bytes are not those of so many pixels.
std::vector<uint16_t> rvlDecode(const uint8_t* bytes, size_t size, size_t count);

}  // namespace compressed_depth_image_transport
