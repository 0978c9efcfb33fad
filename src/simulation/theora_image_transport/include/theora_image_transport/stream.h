// Pictures as packets of a Theora stream, and back, by libtheora.
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>
#include <theora_image_transport/Packet.h>

namespace theora_image_transport {

struct Settings {
  bool aim_at_bitrate = false;
  int bitrate = 800000;         // bit/s
  int quality = 31;             // 0 (worst) to 63
  int keyframe_frequency = 64;  // pictures from one key frame to the next, at most
};

// One stream of pictures of one size.
class Encoder {
 public:
  // Throws std::runtime_error, in one line, for what libtheora does not make.
  Encoder(cv::Size size, const Settings& settings);
  ~Encoder();

  cv::Size size() const;
  std::vector<Packet> headers();
  // bgr: CV_8UC3 of that size; throws std::runtime_error.
  std::vector<Packet> encode(const cv::Mat& bgr);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Packets in the order in which they were sent; a header that begins a stream ends the one before.
class Decoder {
 public:
  Decoder();
  ~Decoder();

  // CV_8UC3, blue first; empty for headers, and for pictures before the first key frame.
  // Throws std::runtime_error, in one line, for data that is no part of a stream.
  cv::Mat decode(const Packet& packet);
  // 0 is none; more looks better and takes longer. libtheora's most at most.
  void postProcess(int level);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  int level_ = 0;
};

}  // namespace theora_image_transport
