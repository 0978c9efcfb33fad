#pragma once
#include <string>
#include <vector>

#include <ignition/math/Color.hh>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace common
{

extern GAZEBO_VISIBLE const std::string PixelFormatNames[];

/// Pixels in rows, from the upper left corner.
class GAZEBO_VISIBLE Image
{
public:
  enum PixelFormat
  {
    UNKNOWN_PIXEL_FORMAT = 0,
    L_INT8,
    L_INT16,
    RGB_INT8,
    RGBA_INT8,
    BGRA_INT8,
    RGB_INT16,
    RGB_INT32,
    BGR_INT8,
    BGR_INT16,
    BGR_INT32,
    R_FLOAT16,
    RGB_FLOAT16,
    R_FLOAT32,
    RGB_FLOAT32,
    BAYER_RGGB8,
    BAYER_RGGR8,
    BAYER_GBRG8,
    BAYER_GRBG8,
    PIXEL_FORMAT_COUNT
  };

  /// By its name in this list; others, as R8G8B8, are unknown.
  static PixelFormat ConvertPixelFormat(const std::string& name);

  /// Of a format with one byte for each of its channels.
  void SetFromData(const unsigned char* data, unsigned int width, unsigned int height, PixelFormat format);
  bool Valid() const { return !data_.empty(); }
  unsigned int GetWidth() const { return width_; }
  unsigned int GetHeight() const { return height_; }
  unsigned int GetBPP() const { return 8 * channels_; }
  int GetPitch() const { return static_cast<int>(width_ * channels_); }
  PixelFormat GetPixelFormat() const { return format_; }
  ignition::math::Color GetPixel(unsigned int column, unsigned int row) const;
  ignition::math::Color GetAvgColor() const;
  /// A copy, which the caller deletes[].
  void GetData(unsigned char** data, unsigned int& count) const;

private:
  std::vector<unsigned char> data_;
  unsigned int width_ = 0, height_ = 0, channels_ = 0;
  PixelFormat format_ = UNKNOWN_PIXEL_FORMAT;
};

}  // namespace common
}  // namespace gazebo
