#include "compressed_image_transport/codec.h"

#include <stdexcept>

#include <boost/make_shared.hpp>
#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/image_encodings.h>

namespace enc = sensor_msgs::image_encodings;

namespace compressed_image_transport {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  std::string line = what.substr(0, 300);
  for (char& c : line)
    if (c == '\n') c = ' ';
  throw std::runtime_error(line);
}

// Bits of a channel; 0 for a name that is not known.
int bits(const std::string& encoding) {
  try {
    return encoding.empty() ? 0 : enc::bitDepth(encoding);
  } catch (const std::runtime_error&) {
    return 0;
  }
}

bool ofDepth(const std::string& encoding, int depth) { return bits(encoding) == (depth == CV_16U ? 16 : 8); }

}  // namespace

sensor_msgs::CompressedImage encode(const sensor_msgs::Image& image, Format format, const std::vector<int>& parameters) {
  const int depth = bits(image.encoding);
  const std::string name = format == Format::jpeg ? "jpeg" : "png";
  if (depth != 8 && depth != 16)
    refuse("'" + image.encoding + "' cannot be sent as " + name + ", which is for 8 or 16 bits a channel; use the raw " +
           "image or, for depth, compressedDepth");
  std::string target;
  if (enc::isColor(image.encoding)) target = format == Format::png && depth == 16 ? enc::BGR16 : enc::BGR8;
  sensor_msgs::CompressedImage message;
  message.header = image.header;
  message.format = image.encoding + "; " + name + " compressed " + target;
  try {
    const auto pixels = cv_bridge::toCvShare(image, boost::shared_ptr<void>(), target);
    if (!cv::imencode(format == Format::jpeg ? ".jpg" : ".png", pixels->image, message.data, parameters))
      refuse("OpenCV makes no " + name + " of '" + image.encoding + "'");
  } catch (const cv_bridge::Exception& error) {
    refuse(error.what());
  } catch (const cv::Exception& error) {
    refuse(error.what());
  }
  return message;
}

sensor_msgs::ImagePtr decode(const sensor_msgs::CompressedImage& message, Mode mode) {
  // Of an encoding and, behind a semicolon, how it was compressed; older senders tell "jpeg" alone.
  const size_t split = message.format.find(';');
  const std::string told = split == std::string::npos ? "" : message.format.substr(0, split);
  const bool redFirst = split != std::string::npos && message.format.find("compressed rgb", split) != std::string::npos;
  const int flags = mode == Mode::gray ? cv::IMREAD_GRAYSCALE : mode == Mode::color ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED;
  try {
    const cv::Mat pixels = message.data.empty() ? cv::Mat() : cv::imdecode(message.data, flags);
    if (pixels.empty())
      refuse(std::to_string(message.data.size()) + " bytes of format '" + message.format + "' are no picture");
    const int depth = pixels.depth(), channels = pixels.channels();
    if ((depth != CV_8U && depth != CV_16U) || channels == 2 || channels > 4) refuse("a picture of this kind is not known");
    const bool wide = depth == CV_16U, fits = ofDepth(told, depth);
    if (channels == 1) {
      const bool kept = fits && enc::numChannels(told) == 1;
      return cv_bridge::CvImage(message.header, kept ? told : wide ? enc::MONO16 : enc::MONO8, pixels).toImageMsg();
    }
    const std::string order = std::string(redFirst ? "rgb" : "bgr") + (channels == 4 ? "a" : "");
    const auto read = boost::make_shared<cv_bridge::CvImage>(message.header, order + (wide ? "16" : "8"), pixels);
    const bool kept = fits && enc::isColor(told);
    return cv_bridge::cvtColor(read, kept ? told : wide ? enc::BGR16 : enc::BGR8)->toImageMsg();
  } catch (const cv_bridge::Exception& error) {
    refuse(error.what());
  } catch (const cv::Exception& error) {
    refuse(error.what());
  }
}

}  // namespace compressed_image_transport
