#include <gazebo/common/Image.hh>

#include <cstring>

namespace gazebo
{
namespace common
{

const std::string PixelFormatNames[] = { "UNKNOWN_PIXEL_FORMAT",
                                         "L_INT8",
                                         "L_INT16",
                                         "RGB_INT8",
                                         "RGBA_INT8",
                                         "BGRA_INT8",
                                         "RGB_INT16",
                                         "RGB_INT32",
                                         "BGR_INT8",
                                         "BGR_INT16",
                                         "BGR_INT32",
                                         "R_FLOAT16",
                                         "RGB_FLOAT16",
                                         "R_FLOAT32",
                                         "RGB_FLOAT32",
                                         "BAYER_RGGB8",
                                         "BAYER_RGGR8",
                                         "BAYER_GBRG8",
                                         "BAYER_GRBG8" };

Image::PixelFormat Image::ConvertPixelFormat(const std::string& name)
{
  for (int format = 0; format < PIXEL_FORMAT_COUNT; ++format)
    if (PixelFormatNames[format] == name)
      return static_cast<PixelFormat>(format);
  return UNKNOWN_PIXEL_FORMAT;
}

void Image::SetFromData(const unsigned char* data, unsigned int width, unsigned int height, PixelFormat format)
{
  switch (format)
  {
    case RGBA_INT8:
    case BGRA_INT8:
      channels_ = 4;
      break;
    case RGB_INT8:
    case BGR_INT8:
      channels_ = 3;
      break;
    default:
      channels_ = 1;
  }
  width_ = width, height_ = height, format_ = format;
  data_.assign(data, data + static_cast<std::size_t>(width) * height * channels_);
}

ignition::math::Color Image::GetPixel(unsigned int column, unsigned int row) const
{
  if (column >= width_ || row >= height_)
    return ignition::math::Color();
  const unsigned char* const pixel = &data_[(static_cast<std::size_t>(row) * width_ + column) * channels_];
  if (channels_ == 1)
    return ignition::math::Color(pixel[0] / 255.0f, pixel[0] / 255.0f, pixel[0] / 255.0f);
  const bool blue_first = format_ == BGR_INT8 || format_ == BGRA_INT8;
  return ignition::math::Color(pixel[blue_first ? 2 : 0] / 255.0f, pixel[1] / 255.0f, pixel[blue_first ? 0 : 2] / 255.0f,
                               channels_ == 4 ? pixel[3] / 255.0f : 1.0f);
}

ignition::math::Color Image::GetAvgColor() const
{
  double r = 0, g = 0, b = 0;
  for (unsigned int row = 0; row < height_; ++row)
    for (unsigned int column = 0; column < width_; ++column)
    {
      const auto pixel = GetPixel(column, row);
      r += pixel.R(), g += pixel.G(), b += pixel.B();
    }
  const double n = data_.empty() ? 1 : static_cast<double>(width_) * height_;
  return ignition::math::Color(static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n));
}

void Image::GetData(unsigned char** data, unsigned int& count) const
{
  count = static_cast<unsigned int>(data_.size());
  *data = new unsigned char[data_.size()];
  std::memcpy(*data, data_.data(), data_.size());
}

}  // namespace common
}  // namespace gazebo
