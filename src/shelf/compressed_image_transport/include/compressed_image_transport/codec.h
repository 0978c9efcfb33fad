// Images as JPEG or PNG in sensor_msgs/CompressedImage, and back.
#pragma once

#include <string>
#include <vector>

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

namespace compressed_image_transport {

enum class Format { jpeg, png };
enum class Mode { unchanged, gray, color };  // of the pixels that come out

// Colours go in as blue, green, red; grey and Bayer pixels as they are. JPEG has 8 bits: those of 16 are cut at 255.
// parameters: pairs of cv::IMWRITE_...
// Throws std::runtime_error, in one line, for pixels that are no image of 8 or 16 bits.
sensor_msgs::CompressedImage encode(const sensor_msgs::Image& image, Format format, const std::vector<int>& parameters);

// In the encoding that message.format tells, as far as the pixels have it; mono8, bgr8 and so on otherwise.
// Throws std::runtime_error, in one line, for data that is no picture.
sensor_msgs::ImagePtr decode(const sensor_msgs::CompressedImage& message, Mode mode = Mode::unchanged);

}  // namespace compressed_image_transport
