#include "theora_image_transport/stream.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <opencv2/imgproc.hpp>
#include <theora/theoradec.h>
#include <theora/theoraenc.h>

namespace theora_image_transport {
namespace {

constexpr int kBlock = 16;           // a coded frame is made of whole macroblocks
constexpr int kRate = 30;            // pictures per second that a bit rate is meant for; stamps are in the messages
constexpr uint32_t kMost = 1 << 14;  // pixels of a side

int padded(int pixels) { return (pixels + kBlock - 1) / kBlock * kBlock; }

Packet packetOf(const ogg_packet& ogg) {
  Packet packet;
  packet.data.assign(ogg.packet, ogg.packet + ogg.bytes);
  packet.b_o_s = ogg.b_o_s;
  packet.e_o_s = ogg.e_o_s;
  packet.granulepos = ogg.granulepos;
  packet.packetno = ogg.packetno;
  return packet;
}

cv::Mat wrap(const th_img_plane& plane) { return cv::Mat(plane.height, plane.width, CV_8UC1, plane.data, plane.stride); }

th_img_plane plane(cv::Mat& pixels) { return {pixels.cols, pixels.rows, static_cast<int>(pixels.step), pixels.data}; }

}  // namespace

struct Encoder::Parts {
  th_info info;
  th_comment comment;
  th_enc_ctx* context = nullptr;

  Parts() {
    th_info_init(&info);
    th_comment_init(&comment);
  }
  ~Parts() {
    if (context) th_encode_free(context);
    th_comment_clear(&comment);
    th_info_clear(&info);
  }
};

Encoder::Encoder(cv::Size size, const Settings& settings) : parts_(std::make_unique<Parts>()) {
  th_info& info = parts_->info;
  info.pic_width = size.width;
  info.pic_height = size.height;
  info.frame_width = padded(size.width);
  info.frame_height = padded(size.height);
  info.fps_numerator = kRate;
  info.fps_denominator = info.aspect_numerator = info.aspect_denominator = 1;
  info.colorspace = TH_CS_UNSPECIFIED;
  info.pixel_fmt = TH_PF_420;
  info.target_bitrate = settings.aim_at_bitrate ? settings.bitrate : 0;
  info.quality = settings.quality;
  for (info.keyframe_granule_shift = 0; 1 << info.keyframe_granule_shift < settings.keyframe_frequency;)
    ++info.keyframe_granule_shift;
  parts_->context = size.area() ? th_encode_alloc(&info) : nullptr;
  if (!parts_->context)
    throw std::runtime_error("there is no theora stream of " + std::to_string(size.width) + " x " +
                             std::to_string(size.height));
  ogg_uint32_t frequency = settings.keyframe_frequency;
  th_encode_ctl(parts_->context, TH_ENCCTL_SET_KEYFRAME_FREQUENCY_FORCE, &frequency, sizeof frequency);
}

Encoder::~Encoder() = default;

cv::Size Encoder::size() const { return cv::Size(parts_->info.pic_width, parts_->info.pic_height); }

std::vector<Packet> Encoder::headers() {
  std::vector<Packet> packets;
  ogg_packet ogg;
  while (th_encode_flushheader(parts_->context, &parts_->comment, &ogg) > 0) packets.push_back(packetOf(ogg));
  return packets;
}

std::vector<Packet> Encoder::encode(const cv::Mat& bgr) {
  const th_info& info = parts_->info;
  cv::Mat whole, mixed, channels[3], red, blue;
  cv::copyMakeBorder(bgr, whole, 0, info.frame_height - bgr.rows, 0, info.frame_width - bgr.cols, cv::BORDER_REPLICATE);
  cv::cvtColor(whole, mixed, cv::COLOR_BGR2YCrCb);  // 0..255, as theora_image_transport's are; video would be 16..235
  cv::split(mixed, channels);
  cv::resize(channels[1], red, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  cv::resize(channels[2], blue, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  th_ycbcr_buffer planes = {plane(channels[0]), plane(blue), plane(red)};
  if (th_encode_ycbcr_in(parts_->context, planes)) throw std::runtime_error("libtheora refuses a picture");
  std::vector<Packet> packets;
  ogg_packet ogg;
  while (th_encode_packetout(parts_->context, 0, &ogg) > 0) packets.push_back(packetOf(ogg));
  return packets;
}

struct Decoder::Parts {
  th_info info;
  th_comment comment;
  th_setup_info* setup = nullptr;
  th_dec_ctx* context = nullptr;
  bool key_seen = false;
  cv::Mat last;

  Parts() {
    th_info_init(&info);
    th_comment_init(&comment);
  }
  ~Parts() {
    if (context) th_decode_free(context);
    th_setup_free(setup);
    th_comment_clear(&comment);
    th_info_clear(&info);
  }
};

Decoder::Decoder() : parts_(std::make_unique<Parts>()) {}
Decoder::~Decoder() = default;

void Decoder::postProcess(int level) {
  level_ = level;
  if (!parts_->context) return;
  int most = 0;
  th_decode_ctl(parts_->context, TH_DECCTL_GET_PPLEVEL_MAX, &most, sizeof most);
  level = std::clamp(level, 0, most);
  th_decode_ctl(parts_->context, TH_DECCTL_SET_PPLEVEL, &level, sizeof level);
}

cv::Mat Decoder::decode(const Packet& packet) {
  if (packet.b_o_s) parts_ = std::make_unique<Parts>();
  ogg_packet ogg{const_cast<unsigned char*>(packet.data.data()),
                 static_cast<long>(packet.data.size()),
                 packet.b_o_s,
                 packet.e_o_s,
                 packet.granulepos,
                 packet.packetno};
  if (!parts_->context) {
    const int left = th_decode_headerin(&parts_->info, &parts_->comment, &parts_->setup, &ogg);
    if (left > 0) return {};
    if (left < 0 && !packet.b_o_s && !parts_->info.frame_width) return {};  // heard in the middle: waits for the next
    if (left < 0) throw std::runtime_error("what should be the head of a theora stream is none");
    if (parts_->info.frame_width > kMost || parts_->info.frame_height > kMost)
      throw std::runtime_error("a theora stream of that size is not decoded");
    parts_->context = th_decode_alloc(&parts_->info, parts_->setup);
    if (!parts_->context) throw std::runtime_error("a theora stream is not decoded, its head is wrong");
    postProcess(level_);
  }
  parts_->key_seen = parts_->key_seen || th_packet_iskeyframe(&ogg) == 1;
  if (!parts_->key_seen) return {};
  const int result = th_decode_packetin(parts_->context, &ogg, nullptr);
  if (result == TH_DUPFRAME) return parts_->last;
  if (result)
    throw std::runtime_error("a packet of " + std::to_string(packet.data.size()) + " bytes is no picture of this stream");
  th_ycbcr_buffer planes;
  th_decode_ycbcr_out(parts_->context, planes);
  const cv::Mat y = wrap(planes[0]);
  cv::Mat red, blue, mixed, bgr;
  cv::resize(wrap(planes[2]), red, y.size(), 0, 0, cv::INTER_LINEAR);
  cv::resize(wrap(planes[1]), blue, y.size(), 0, 0, cv::INTER_LINEAR);
  cv::merge(std::vector<cv::Mat>{y, red, blue}, mixed);
  cv::cvtColor(mixed, bgr, cv::COLOR_YCrCb2BGR);
  const th_info& info = parts_->info;
  parts_->last = bgr(cv::Rect(info.pic_x, info.pic_y, info.pic_width, info.pic_height)).clone();
  return parts_->last;
}

}  // namespace theora_image_transport
