// Depth there and back.
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include "compressed_depth_image_transport/codec.h"

using namespace compressed_depth_image_transport;

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

sensor_msgs::ImagePtr depth(const cv::Mat& pixels) {
  return cv_bridge::CvImage(std_msgs::Header(), pixels.type() == CV_32FC1 ? "32FC1" : "16UC1", pixels).toImageMsg();
}

class Formats : public testing::TestWithParam<const char*> {
 protected:
  Settings settings() const {
    Settings made;
    made.format = GetParam();
    return made;
  }
};

}  // namespace

TEST_P(Formats, FloatsComeBackAsExactAsTheirStep) {
  const float infinity = std::numeric_limits<float>::infinity();
  const cv::Mat sent = (cv::Mat_<float>(2, 4) << 0.5f, 1.0f, 2.5f, 9.9f, kUnknown, 10.5f, infinity, 5.0f);
  const auto message = encode(*depth(sent), settings());
  EXPECT_EQ(message.format, std::string("32FC1; compressedDepth ") + GetParam());
  const auto got = cv_bridge::toCvCopy(decode(message))->image;
  ASSERT_EQ(got.type(), CV_32FC1);
  for (int i = 0; i < 8; ++i) {
    const float z = sent.at<float>(i / 4, i % 4), back = got.at<float>(i / 4, i % 4);
    if (z < 10) EXPECT_NEAR(back, z, 1.01f * z * z / 10100) << z;  // one step of inverse depth
    else EXPECT_TRUE(std::isnan(back)) << z;
  }
}

TEST_P(Formats, MillimetresComeBackTheSame) {
  const cv::Mat sent = (cv::Mat_<uint16_t>(2, 3) << 0, 1, 700, 10000, 10001, 65535);
  const auto message = encode(*depth(sent), settings());
  const auto got = cv_bridge::toCvCopy(decode(message))->image;
  const uint16_t expected[] = {0, 1, 700, 10000, 0, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(got.at<uint16_t>(i / 3, i % 3), expected[i]);
}

INSTANTIATE_TEST_SUITE_P(All, Formats, testing::Values("png", "rvl"));

TEST(Rvl, AnyPixelsComeBack) {
  std::mt19937 random(1);
  for (const int zeros : {0, 30, 90, 100})
    for (const size_t count : {1u, 7u, 8u, 9u, 1000u}) {
      std::vector<uint16_t> pixels(count);
      for (auto& pixel : pixels) pixel = int(random() % 100) < zeros ? 0 : random();
      const auto bytes = rvlEncode(pixels.data(), count);
      EXPECT_EQ(bytes.size() % 4, 0u);
      EXPECT_EQ(rvlDecode(bytes.data(), bytes.size(), count), pixels);
    }
}

TEST(Rvl, BytesAreThoseOfThePaper) {
  // One zero, two others: 5, then 4 (one less). Groups: 1, 2, 10 = 2 + more and 1, 1 = -1 folded, then padding.
  const uint16_t pixels[] = {0, 5, 4};
  EXPECT_EQ(rvlEncode(pixels, 3), (std::vector<uint8_t>{0x00, 0x10, 0xa1, 0x12}));
}

TEST(Rvl, BrokenBytesAreRefused) {
  const std::vector<uint16_t> pixels(1000, 300);
  const auto bytes = rvlEncode(pixels.data(), pixels.size());
  EXPECT_THROW(rvlDecode(bytes.data(), bytes.size() / 2, 1000), std::runtime_error);
  EXPECT_THROW(rvlDecode(bytes.data(), bytes.size(), 100), std::runtime_error);
  const std::vector<uint8_t> endless(100, 0xff);
  EXPECT_THROW(rvlDecode(endless.data(), endless.size(), 1000), std::runtime_error);
  const std::vector<uint8_t> nothing(100, 0);  // runs of no length
  EXPECT_THROW(rvlDecode(nothing.data(), nothing.size(), 1000), std::runtime_error);
}

TEST(Codec, WhatIsNoDepthIsRefused) {
  sensor_msgs::Image colour;
  colour.encoding = "rgb8";
  EXPECT_THROW(encode(colour, Settings()), std::runtime_error);
  sensor_msgs::CompressedImage message;
  EXPECT_THROW(decode(message), std::runtime_error);
  message.format = "16UC1; compressedDepth png";
  message.data.assign(40, 1);
  EXPECT_THROW(decode(message), std::runtime_error);
  message.format = "16UC1; compressedDepth rvl";
  EXPECT_THROW(decode(message), std::runtime_error);
  message.data.assign(20, 0xff);
  EXPECT_THROW(decode(message), std::runtime_error);
}
