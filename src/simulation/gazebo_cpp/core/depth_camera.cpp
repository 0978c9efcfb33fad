#include <gazebo/rendering/DepthCamera.hh>

#include <cmath>
#include <cstring>

namespace gazebo
{
namespace rendering
{

DepthCamera::DepthCamera(const std::string& name, ScenePtr scene, bool auto_render) : Camera(name, scene, auto_render) {}
DepthCamera::~DepthCamera() = default;

void DepthCamera::Load(sdf::ElementPtr element)
{
  Camera::Load(element);
  if (element->HasElement("depth_camera") && element->GetElement("depth_camera")->HasElement("output"))
    points_ = element->GetElement("depth_camera")->Get<std::string>("output") == "points";
}

const float* DepthCamera::DepthData() const
{
  polled_depths_ = true;
  return newest_depths_;
}

event::ConnectionPtr DepthCamera::ConnectNewDepthFrame(std::function<NewDepths> subscriber)
{
  return depth_frames_.Connect(subscriber);
}

event::ConnectionPtr DepthCamera::ConnectNewRGBPointCloud(std::function<NewDepths> subscriber)
{
  return clouds_.Connect(subscriber);
}

event::ConnectionPtr DepthCamera::ConnectNewReflectanceFrame(std::function<NewDepths> subscriber)
{
  return reflectances_.Connect(subscriber);
}

event::ConnectionPtr DepthCamera::ConnectNewNormalsPointCloud(std::function<NewDepths> subscriber)
{
  return normals_.Connect(subscriber);
}

std::vector<std::string> DepthCamera::Wanted(bool awaited) const
{
  std::vector<std::string> wanted = Camera::Wanted(awaited);
  if (!capturing())
    return wanted;
  const bool cloud = points_ && clouds_.ConnectionCount();
  if (cloud && wanted.empty())
    wanted.push_back("image");  // its colours
  if (cloud || awaited || polled_depths_ || (!points_ && depth_frames_.ConnectionCount()))
    wanted.push_back("depth");
  return wanted;
}

/// Depths first, as Gazebo: plugins keep them for the picture that follows.
void DepthCamera::Develop(const Picture& picture)
{
  const unsigned int width = ImageWidth(), height = ImageHeight();
  if (picture.depth && picture.depth_count == static_cast<std::size_t>(width) * height)
  {
    std::vector<float>& depths = depths_[second_depths_];
    second_depths_ = !second_depths_;
    depths.assign(picture.depth, picture.depth + picture.depth_count);
    newest_depths_ = depths.data();
    if (points_)
      developPoints(picture);
    else
      depth_frames_(newest_depths_.load(), width, height, 1u, std::string("FLOAT32"));
  }
  Camera::Develop(picture);
}

void DepthCamera::developPoints(const Picture& picture)
{
  if (!clouds_.ConnectionCount() || picture.image_bytes != ImageByteSize())
    return;
  const View v = view();
  const double f = v.width / (2 * std::tan(v.hfov / 2));
  const unsigned int bytes = ImageDepth();
  const bool blue_first = ImageFormat() == "B8G8R8" || ImageFormat() == "BGR_INT8";
  cloud_.resize(4 * picture.depth_count);
  for (std::size_t i = 0; i < picture.depth_count; ++i)
  {
    const unsigned char* const pixel = picture.image + i * bytes;
    const double z = picture.depth[i], column = static_cast<double>(i % v.width), row = static_cast<double>(i / v.width);
    float* const point = &cloud_[4 * i];
    point[0] = static_cast<float>(z * (column - (v.width - 1) / 2.0) / f);
    point[1] = static_cast<float>(z * (row - (v.height - 1) / 2.0) / f);
    point[2] = static_cast<float>(z);
    unsigned char colour[4] = { pixel[0], pixel[0], pixel[0], 0 };  // grey, or of a mosaic its one
    if (bytes >= 3)
    {
      const unsigned int step = bytes / 3, high = step - 1;  // of 16 bits the upper eight
      colour[0] = pixel[blue_first ? high : 2 * step + high], colour[1] = pixel[step + high];
      colour[2] = pixel[blue_first ? 2 * step + high : high];
    }
    std::memcpy(&point[3], colour, sizeof colour);
  }
  clouds_(cloud_.data(), v.width, v.height, 1u, std::string("RGBPOINTS"));
}

}  // namespace rendering
}  // namespace gazebo
