// Pictures there and back through packets.
#include <stdexcept>

#include <gtest/gtest.h>

#include "theora_image_transport/stream.h"

using namespace theora_image_transport;

namespace {

// A slope with a box that moves; neither side is whole blocks, one is odd.
cv::Mat scene(int step) {
  cv::Mat picture(123, 162, CV_8UC3);
  for (int row = 0; row < picture.rows; ++row)
    for (int column = 0; column < picture.cols; ++column)
      picture.at<cv::Vec3b>(row, column) = {uint8_t(255 - column), uint8_t(row), uint8_t(column)};
  picture(cv::Rect(20 + 4 * step, 40, 40, 40)) = cv::Scalar(30, 30, 250);
  return picture;
}

double meanDifference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_L1) / (a.total() * 3); }

Settings best() {
  Settings settings;
  settings.quality = 60;
  return settings;
}

}  // namespace

TEST(Stream, PicturesComeBack) {
  Encoder encoder(scene(0).size(), best());
  Decoder decoder;
  const auto headers = encoder.headers();
  ASSERT_EQ(headers.size(), 3u);
  EXPECT_EQ(headers[0].b_o_s, 1);
  for (const auto& header : headers) EXPECT_TRUE(decoder.decode(header).empty());
  for (int i = 0; i < 6; ++i) {
    const auto packets = encoder.encode(scene(i));
    ASSERT_EQ(packets.size(), 1u);
    const cv::Mat got = decoder.decode(packets[0]);
    ASSERT_EQ(got.size(), scene(i).size());
    EXPECT_LT(meanDifference(got, scene(i)), 4) << i;
    const cv::Rect inside(30 + 4 * i, 50, 20, 20);
    EXPECT_LT(cv::norm(got(inside), scene(i)(inside), cv::NORM_INF), 16) << i;  // the whole range is kept
  }
}

TEST(Stream, WhoComesLaterWaitsForTheNextStream) {
  Encoder encoder(scene(0).size(), best());
  Decoder decoder;
  encoder.headers();
  for (int i = 0; i < 3; ++i)
    for (const auto& packet : encoder.encode(scene(i))) EXPECT_TRUE(decoder.decode(packet).empty());
  Encoder next(cv::Size(64, 48), best());
  for (const auto& header : next.headers()) decoder.decode(header);
  const cv::Mat black(48, 64, CV_8UC3, cv::Scalar::all(0));
  EXPECT_EQ(decoder.decode(next.encode(black)[0]).size(), black.size());
}

TEST(Stream, APictureThatIsTheSameIsToldAgain) {
  Encoder encoder(scene(0).size(), best());
  Decoder decoder;
  for (const auto& header : encoder.headers()) decoder.decode(header);
  const cv::Mat first = decoder.decode(encoder.encode(scene(0))[0]);
  Packet empty;
  EXPECT_EQ(cv::norm(decoder.decode(empty), first), 0);
}

TEST(Stream, QualityMakesItLarger) {
  size_t last = 0;
  for (const int quality : {0, 31, 63}) {
    Settings settings;
    settings.quality = quality;
    Encoder encoder(scene(0).size(), settings);
    encoder.headers();
    const size_t size = encoder.encode(scene(0))[0].data.size();
    EXPECT_GT(size, last);
    last = size;
  }
}

TEST(Stream, BrokenPacketsAreRefused) {
  Packet head;
  head.b_o_s = 1;
  head.data.assign(50, 7);
  Decoder decoder;
  EXPECT_THROW(decoder.decode(head), std::runtime_error);
  Encoder encoder(scene(0).size(), best());
  for (const auto& header : encoder.headers()) decoder.decode(header);
  Packet picture = encoder.encode(scene(0))[0];
  picture.data[0] |= 0x80;  // the mark of a header
  EXPECT_THROW(decoder.decode(picture), std::runtime_error);
  EXPECT_THROW(Encoder(cv::Size(0, 0), best()), std::runtime_error);
}
