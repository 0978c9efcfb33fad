#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "compressed_depth_image_transport/codec.h"

namespace compressed_depth_image_transport {
namespace {

// Groups of three bits, low ones first, each with a bit that says whether more follow; eight of them in a word of 32
// bits, the first one on top.
class Writer {
 public:
  void number(uint32_t value) {
    do {
      const uint32_t rest = value >> 3;
      group((value & 7) | (rest ? 8 : 0));
      value = rest;
    } while (value);
  }

  std::vector<uint8_t> finish() {
    while (groups_) group(0);
    return std::move(bytes_);
  }

 private:
  void group(uint32_t bits) {
    word_ = word_ << 4 | bits;
    if (++groups_ < 8) return;
    uint8_t raw[4];
    std::memcpy(raw, &word_, 4);
    bytes_.insert(bytes_.end(), raw, raw + 4);
    groups_ = 0;
  }

  std::vector<uint8_t> bytes_;
  uint32_t word_ = 0;
  int groups_ = 0;
};

class Reader {
 public:
  Reader(const uint8_t* bytes, size_t size) : at_(bytes), end_(bytes + size) {}

  uint32_t number() {
    uint32_t value = 0, bits;
    int shift = 0;
    do {
      if (shift > 30) throw std::runtime_error("depth in RVL holds a number that is too large");
      bits = group();
      value |= (bits & 7) << shift;
      shift += 3;
    } while (bits & 8);
    return value;
  }

 private:
  uint32_t group() {
    if (!groups_) {
      if (end_ - at_ < 4) throw std::runtime_error("depth in RVL ends before its last pixel");
      std::memcpy(&word_, at_, 4);
      at_ += 4;
      groups_ = 8;
    }
    return word_ >> 4 * --groups_ & 15;
  }

  const uint8_t *at_, *end_;
  uint32_t word_ = 0;
  int groups_ = 0;
};

}  // namespace

std::vector<uint8_t> rvlEncode(const uint16_t* pixels, size_t count) {
  Writer writer;
  const uint16_t* const end = pixels + count;
  int previous = 0;
  while (pixels != end) {
    const uint16_t* start = pixels;
    while (pixels != end && !*pixels) ++pixels;
    writer.number(pixels - start);
    start = pixels;
    while (pixels != end && *pixels) ++pixels;
    writer.number(pixels - start);
    for (const uint16_t* pixel = start; pixel != pixels; ++pixel) {
      const int change = *pixel - previous;
      writer.number(change >= 0 ? 2 * change : -2 * change - 1);
      previous = *pixel;
    }
  }
  return writer.finish();
}

std::vector<uint16_t> rvlDecode(const uint8_t* bytes, size_t size, size_t count) {
  std::vector<uint16_t> pixels;
  // A pixel takes at least a group of four bits, zeros less: no room is made for a size that the bytes cannot hold.
  pixels.reserve(std::min(count, 2 * size + 4096));
  Reader reader(bytes, size);
  uint16_t previous = 0;
  const auto run = [&] {
    const uint32_t length = reader.number();
    if (length > count - pixels.size()) throw std::runtime_error("depth in RVL holds more pixels than it tells");
    return length;
  };
  while (pixels.size() < count) {
    const uint32_t zeros = run();
    pixels.insert(pixels.end(), zeros, 0);
    for (uint32_t left = run(); left; --left) {
      const uint32_t folded = reader.number();
      previous += folded & 1 ? -int(folded >> 1) - 1 : int(folded >> 1);
      pixels.push_back(previous);
    }
  }
  return pixels;
}

}  // namespace compressed_depth_image_transport
