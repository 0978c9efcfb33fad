#include "compressed_depth_image_transport/codec.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/image_encodings.h>

namespace enc = sensor_msgs::image_encodings;

namespace compressed_depth_image_transport {
namespace {

// What stands in front of the compressed pixels. depth = quantum / (step - offset), in m; both 0 for whole millimetres.
struct Head {
  int32_t format = 0;  // inverse depth; there is no other
  float quantum = 0, offset = 0;
};
static_assert(sizeof(Head) == 12, "as it is sent");

constexpr uint64_t kMostPixels = 1u << 28;

[[noreturn]] void refuse(std::string what) {
  for (char& c : what)
    if (c == '\n') c = ' ';
  throw std::runtime_error(what.substr(0, 300));
}

cv::Mat inverse(const cv::Mat& depth, const Head& head, float depth_max) {
  cv::Mat steps(depth.size(), CV_16UC1);
  for (int row = 0; row < depth.rows; ++row) {
    const float* from = depth.ptr<float>(row);
    uint16_t* to = steps.ptr<uint16_t>(row);
    for (int column = 0; column < depth.cols; ++column) {
      // NaN is not less
      const float step = from[column] < depth_max ? head.quantum / from[column] + head.offset : 0.0f;
      to[column] = step > 0 && step <= 65535 ? static_cast<uint16_t>(step) : 0;
    }
  }
  return steps;
}

cv::Mat metres(const cv::Mat& steps, const Head& head) {
  cv::Mat depth(steps.size(), CV_32FC1);
  for (int row = 0; row < steps.rows; ++row) {
    const uint16_t* from = steps.ptr<uint16_t>(row);
    float* to = depth.ptr<float>(row);
    for (int column = 0; column < steps.cols; ++column)
      to[column] = from[column] ? head.quantum / (from[column] - head.offset) : std::numeric_limits<float>::quiet_NaN();
  }
  return depth;
}

cv::Mat unpackRvl(const uint8_t* bytes, size_t size) {
  uint32_t columns, rows;
  if (size < 8) refuse("depth in RVL has no size");
  std::memcpy(&columns, bytes, 4);
  std::memcpy(&rows, bytes + 4, 4);
  const uint64_t count = uint64_t(columns) * rows;
  if (!count || columns > 65535 || rows > 65535 || count > kMostPixels)
    refuse("depth in RVL cannot have " + std::to_string(columns) + " x " + std::to_string(rows) + " pixels");
  const auto pixels = rvlDecode(bytes + 8, size - 8, count);
  return cv::Mat(rows, columns, CV_16UC1, const_cast<uint16_t*>(pixels.data())).clone();
}

std::vector<uint8_t> packRvl(const cv::Mat& pixels) {
  const auto packed = rvlEncode(pixels.ptr<uint16_t>(), pixels.total());
  const uint32_t size[2] = {uint32_t(pixels.cols), uint32_t(pixels.rows)};
  std::vector<uint8_t> bytes(8 + packed.size());
  std::memcpy(bytes.data(), size, 8);
  std::memcpy(bytes.data() + 8, packed.data(), packed.size());
  return bytes;
}

}  // namespace

sensor_msgs::CompressedImage encode(const sensor_msgs::Image& image, const Settings& settings) {
  const bool floats = image.encoding == enc::TYPE_32FC1;
  if (!floats && image.encoding != enc::TYPE_16UC1 && image.encoding != enc::MONO16)
    refuse("'" + image.encoding + "' is no depth, which is 16UC1 or 32FC1; use compressed");
  sensor_msgs::CompressedImage message;
  message.header = image.header;
  message.format = image.encoding + "; compressedDepth " + settings.format;
  try {
    cv::Mat pixels = cv_bridge::toCvCopy(image)->image;
    Head head;
    if (floats) {
      head.quantum = settings.depth_quantization * (settings.depth_quantization + 1);
      head.offset = 1 - head.quantum / settings.depth_max;
      pixels = inverse(pixels, head, settings.depth_max);
    } else {
      pixels.setTo(0, pixels > std::min(settings.depth_max * 1000, 65535.0));
    }
    std::vector<uint8_t> packed;
    if (settings.format == "rvl") packed = packRvl(pixels);
    else if (!cv::imencode(".png", pixels, packed, {cv::IMWRITE_PNG_COMPRESSION, settings.png_level}))
      refuse("OpenCV makes no PNG of this depth image");
    message.data.resize(sizeof(Head));
    std::memcpy(message.data.data(), &head, sizeof(Head));
    message.data.insert(message.data.end(), packed.begin(), packed.end());
  } catch (const cv_bridge::Exception& error) {
    refuse(error.what());
  } catch (const cv::Exception& error) {
    refuse(error.what());
  }
  return message;
}

sensor_msgs::ImagePtr decode(const sensor_msgs::CompressedImage& message) {
  const size_t split = message.format.find(';');
  const std::string encoding = message.format.substr(0, split);
  const std::string how = split == std::string::npos ? "" : message.format.substr(split);
  if (encoding != enc::TYPE_32FC1 && encoding != enc::TYPE_16UC1 && encoding != enc::MONO16)
    refuse("format '" + message.format + "' is no compressed depth");
  if (message.data.size() <= sizeof(Head)) refuse(std::to_string(message.data.size()) + " bytes are no compressed depth");
  Head head;
  std::memcpy(&head, message.data.data(), sizeof(Head));
  try {
    const uint8_t* packed = message.data.data() + sizeof(Head);
    const size_t size = message.data.size() - sizeof(Head);
    cv::Mat pixels;
    if (how.find("compressedDepth rvl") != std::string::npos) pixels = unpackRvl(packed, size);
    else pixels = cv::imdecode(cv::Mat(1, size, CV_8UC1, const_cast<uint8_t*>(packed)), cv::IMREAD_UNCHANGED);
    if (pixels.empty()) refuse("what should be PNG is no picture");
    if (pixels.type() != CV_16UC1) refuse("the depth does not have 16 bits");
    if (encoding == enc::TYPE_32FC1) pixels = metres(pixels, head);
    return cv_bridge::CvImage(message.header, encoding, pixels).toImageMsg();
  } catch (const cv::Exception& error) {
    refuse(error.what());
  }
}

}  // namespace compressed_depth_image_transport
