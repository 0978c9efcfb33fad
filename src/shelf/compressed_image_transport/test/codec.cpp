// Pictures there and back.
#include <cmath>
#include <stdexcept>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/image_encodings.h>

#include "compressed_image_transport/codec.h"

using namespace compressed_image_transport;

namespace {

// 30 x 20 pixels: slopes that differ in each channel, over the whole range of the type.
sensor_msgs::ImagePtr picture(const std::string& encoding) {
  cv::Mat pixels(20, 30, cv_bridge::getCvType(encoding));
  const int channels = pixels.channels();
  for (int row = 0; row < pixels.rows; ++row)
    for (int column = 0; column < pixels.cols; ++column)
      for (int c = 0; c < channels; ++c) {
        const int value = c == 3 ? 255 : 255 * (row + (c + 1) * column) / (20 + (c + 1) * 30);
        if (pixels.depth() == CV_8U) pixels.ptr<uint8_t>(row)[column * channels + c] = value;
        else pixels.ptr<uint16_t>(row)[column * channels + c] = value * 257;
      }
  std_msgs::Header header;
  header.frame_id = "camera";
  return cv_bridge::CvImage(header, encoding, pixels).toImageMsg();
}

double meanDifference(const sensor_msgs::Image& a, const sensor_msgs::Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.data.size(); ++i) sum += std::abs(int(a.data[i]) - int(b.data[i]));
  return sum / a.data.size();
}

class Encodings : public testing::TestWithParam<const char*> {};

}  // namespace

TEST_P(Encodings, PngComesBackTheSame) {
  const auto sent = picture(GetParam());
  const auto got = decode(encode(*sent, Format::png, {}));
  EXPECT_EQ(got->encoding, sent->encoding);
  EXPECT_EQ(got->header.frame_id, "camera");
  EXPECT_EQ(got->step, sent->step);
  EXPECT_EQ(got->data, sent->data);
}

TEST_P(Encodings, JpegComesBackAlmostTheSame) {
  const auto sent = picture(GetParam());
  if (sensor_msgs::image_encodings::bitDepth(sent->encoding) == 16) return;
  const auto got = decode(encode(*sent, Format::jpeg, {cv::IMWRITE_JPEG_QUALITY, 95}));
  EXPECT_EQ(got->encoding, sent->encoding);
  ASSERT_EQ(got->data.size(), sent->data.size());
  EXPECT_LT(meanDifference(*got, *sent), 3);
}

INSTANTIATE_TEST_SUITE_P(All, Encodings,
                         testing::Values("rgb8", "bgr8", "rgba8", "bgra8", "mono8", "bayer_rggb8", "8UC1", "rgb16", "bgr16",
                                         "mono16", "16UC1"));

TEST(Codec, FormatIsToldAsEverybodyReadsIt) {
  EXPECT_EQ(encode(*picture("rgb8"), Format::jpeg, {}).format, "rgb8; jpeg compressed bgr8");
  EXPECT_EQ(encode(*picture("mono16"), Format::png, {}).format, "mono16; png compressed ");
  EXPECT_EQ(encode(*picture("rgb16"), Format::png, {}).format, "rgb16; png compressed bgr16");
}

TEST(Codec, CamerasThatTellTheFormatAlone) {
  auto message = encode(*picture("rgb8"), Format::jpeg, {});
  message.format = "jpeg";
  EXPECT_EQ(decode(message)->encoding, "bgr8");
  message = encode(*picture("mono8"), Format::jpeg, {});
  message.format = "";
  EXPECT_EQ(decode(message)->encoding, "mono8");
}

TEST(Codec, OldSendersPutRedFirst) {
  auto message = encode(*picture("bgr8"), Format::png, {});
  const auto right = decode(message);
  message.format = "bgr8; png compressed rgb8";
  const auto turned = decode(message);
  EXPECT_EQ(turned->data[0], right->data[2]);
  EXPECT_EQ(turned->data[2], right->data[0]);
}

TEST(Codec, PixelsDecideWhereTheFormatIsWrong) {
  auto message = encode(*picture("mono16"), Format::jpeg, {});  // 8 bits
  EXPECT_EQ(decode(message)->encoding, "mono8");
  message = encode(*picture("rgb8"), Format::jpeg, {});
  EXPECT_EQ(decode(message, Mode::gray)->encoding, "mono8");
  message = encode(*picture("mono8"), Format::png, {});
  EXPECT_EQ(decode(message, Mode::color)->encoding, "bgr8");
  message.format = "rainbow; png compressed ";
  EXPECT_EQ(decode(message)->encoding, "mono8");
}

TEST(Codec, WhatIsNoPictureIsRefusedInOneLine) {
  sensor_msgs::CompressedImage message;
  EXPECT_THROW(decode(message), std::runtime_error);
  message.format = "rgb8; jpeg compressed bgr8";
  message.data.assign(100, 7);
  EXPECT_THROW(decode(message), std::runtime_error);
  auto image = *picture("rgb8");
  image.data.resize(10);
  try {
    encode(image, Format::jpeg, {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  image.encoding = "32FC1";
  EXPECT_THROW(encode(image, Format::png, {}), std::runtime_error);
}
