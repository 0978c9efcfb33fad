// Cameras: where they look, and what becomes of their pictures.
#include <gazebo/rendering/Camera.hh>

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include <gazebo/physics/physics.hh>
#include <gazebo/rendering/Scene.hh>

#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace rendering
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace
{

constexpr unsigned int longest_side = 8192;
constexpr double most_pixels = 64e6;

/// Of the picture whose callbacks run in this thread.
thread_local const Camera* shown = nullptr;
thread_local const Pose3d* shown_at = nullptr;
thread_local int64_t shown_ns = 0;

double number(const sdf::ElementPtr& sdf, const char* tag, double fallback)
{
  return sdf && sdf->HasElement(tag) ? sdf->Get<double>(tag) : fallback;
}

void check_size(double width, double height)
{
  if (!(width >= 1 && width <= longest_side && height >= 1 && height <= longest_side && width * height <= most_pixels))
    throw std::runtime_error("an image of " + std::to_string(std::lround(width)) + "x" + std::to_string(std::lround(height)) +
                             " pixels is not possible: each side has to be 1 to 8192, both together 64 million at most");
}

}  // namespace

// -- the lens -----------------------------------------------------------------------------------------------------------------------

void Distortion::Load(sdf::ElementPtr sdf)
{
  k1_ = number(sdf, "k1", 0), k2_ = number(sdf, "k2", 0), k3_ = number(sdf, "k3", 0);
  p1_ = number(sdf, "p1", 0), p2_ = number(sdf, "p2", 0);
  if (sdf->HasElement("center"))
    center_ = sdf->Get<ignition::math::Vector2d>("center");
}

// -- what is drawn ------------------------------------------------------------------------------------------------------------------

Camera::Camera(const std::string& name, ScenePtr scene, bool) : name_(name), scene_(std::move(scene)) {}
Camera::~Camera() = default;

void Camera::Load(sdf::ElementPtr element)
{
  sdf = element;
  const sdf::ElementPtr image = inside(sdf, "image"), clip = inside(sdf, "clip"), save = inside(sdf, "save");
  const double width = number(image, "width", 320), height = number(image, "height", 240);
  check_size(width, height);
  if (image && image->HasElement("format"))
    format_ = image->Get<std::string>("format");
  if (inside(sdf, "distortion"))
  {
    lens_.reset(new Distortion);
    lens_->Load(sdf->GetElement("distortion"));
  }
  if (save && save->HasElement("path"))
    folder_ = save->Get<std::string>("path");
  save_ = save && save->HasAttribute("enabled") && save->Get<bool>("enabled");
  change([&](View& view) {
    view.width = static_cast<unsigned int>(width), view.height = static_cast<unsigned int>(height);
    view.hfov = number(sdf, "horizontal_fov", 1.047);
    view.near = number(clip, "near", 0.1), view.far = number(clip, "far", 100);
  });
}

std::string Camera::ScopedName() const { return (scene_ ? scene_->Name() + "::" : "") + name_; }

Camera::View Camera::view() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return view_;
}

void Camera::change(const std::function<void(View&)>& f)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  f(view_);
}

unsigned int Camera::bytesOf(const std::string& format)
{
  if (format == "L8" || format == "L_INT8" || format.compare(0, 5, "BAYER") == 0)
    return 1;
  if (format == "L16" || format == "L_INT16")
    return 2;
  return format == "R16G16B16" || format == "RGB_INT16" ? 6 : 3;
}

std::size_t Camera::ImageByteSize(unsigned int width, unsigned int height, const std::string& format)
{
  return static_cast<std::size_t>(width) * height * bytesOf(format);
}

ignition::math::Angle Camera::VFOV() const
{
  const View v = view();
  return ignition::math::Angle(2 * std::atan(std::tan(v.hfov / 2) * v.height / v.width));
}

void Camera::SetHFOV(const ignition::math::Angle& angle)
{
  change([&](View& view) { view.hfov = angle.Radian(); });
}

void Camera::SetClipDist(float near, float far)
{
  change([&](View& view) { view.near = near, view.far = far; });
}

void Camera::SetImageSize(unsigned int width, unsigned int height)
{
  try
  {
    check_size(width, height);
    change([&](View& view) { view.width = width, view.height = height; });
  }
  catch (const std::exception& error)
  {
    physics::refused("camera " + name_ + ": " + error.what());
  }
}

double Camera::RenderRate() const { return rate_ > 0 ? rate_.load() : std::numeric_limits<double>::infinity(); }

// -- where it is --------------------------------------------------------------------------------------------------------------------

Camera::During::During(const Camera& camera, const Pose3d& X_WC, int64_t time_ns)
{
  shown = &camera, shown_at = &X_WC, shown_ns = time_ns;
}

const int64_t* Camera::During::Time() { return shown ? &shown_ns : nullptr; }
Camera::During::~During() { shown = nullptr, shown_at = nullptr; }

void Camera::Mount(const physics::LinkPtr& link, const Pose3d& X_LS)
{
  link_ = link;
  const Pose3d X_SC = sdf && sdf->HasElement("pose") ? sdf->Get<Pose3d>("pose") : Pose3d();
  change([&](View& view) { view.X_LC = X_SC + X_LS; });
}

Pose3d Camera::MountedPose() const
{
  const physics::LinkPtr link = link_.lock();
  const Pose3d X_LC = view().X_LC;
  return link ? X_LC + link->WorldPose() : X_LC;
}

Pose3d Camera::WorldPose() const { return shown == this ? *shown_at : MountedPose(); }

void Camera::SetWorldPose(const Pose3d& X_WC)
{
  if (!X_WC.IsFinite())
    return physics::refused("camera " + name_ + ": SetWorldPose() got what is no pose; it stays where it is");
  const physics::LinkPtr link = link_.lock();
  change([&](View& view) { view.X_LC = link ? X_WC - link->WorldPose() : X_WC; });
}

ignition::math::Vector2i Camera::Project(const Vector3d& p_W) const
{
  const View v = view();
  const Pose3d X_WC = WorldPose();
  const Vector3d p_C = X_WC.Rot().RotateVectorReverse(p_W - X_WC.Pos());
  const double f = v.width / (2 * std::tan(v.hfov / 2));
  return { static_cast<int>(std::lround((v.width - 1) / 2.0 - f * p_C.Y() / p_C.X())),
           static_cast<int>(std::lround((v.height - 1) / 2.0 - f * p_C.Z() / p_C.X())) };
}

void Camera::CameraToViewportRay(int column, int row, Vector3d& origin, Vector3d& direction) const
{
  const View v = view();
  const Pose3d X_WC = WorldPose();
  const double f = v.width / (2 * std::tan(v.hfov / 2));
  origin = X_WC.Pos();
  direction = X_WC.Rot().RotateVector(Vector3d(f, (v.width - 1) / 2.0 - column, (v.height - 1) / 2.0 - row).Normalized());
}

// -- pictures -----------------------------------------------------------------------------------------------------------------------

event::ConnectionPtr Camera::ConnectNewImageFrame(std::function<NewFrame> subscriber)
{
  capture_ = true;
  return frames_.Connect(subscriber);
}

const unsigned char* Camera::ImageData(unsigned int) const
{
  polled_ = true;
  return newest_;
}

void Camera::Render(bool) { asked_ = true; }

std::vector<std::string> Camera::Wanted(bool awaited) const
{
  if (!capturing() || !(awaited || polled_ || save_ || once_ || frames_.ConnectionCount()))
    return {};
  return { "image" };
}

void Camera::Develop(const Picture& picture)
{
  if (!picture.image || picture.image_bytes != ImageByteSize())  // none, or its size was changed since
    return;
  const View v = view();
  std::vector<unsigned char>& buffer = buffers_[second_];
  second_ = !second_;
  buffer.assign(picture.image, picture.image + picture.image_bytes);
  newest_ = buffer.data();
  if (save_ || once_.exchange(false))
    SaveFrame(fileName());
  frames_(newest_.load(), v.width, v.height, ImageDepth(), format_);
}

// -- files --------------------------------------------------------------------------------------------------------------------------

void Camera::SetSaveFramePathname(const std::string& folder)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  folder_ = folder;
}

std::string Camera::fileName()
{
  std::string name = ScopedName();
  for (std::size_t at; (at = name.find("::")) != std::string::npos;)
    name.replace(at, 2, "_");
  char number[16];
  std::snprintf(number, sizeof number, "-%04u.jpg", saved_++);
  const std::lock_guard<std::mutex> lock(mutex_);
  return folder_ + "/" + name + number;
}

bool Camera::SaveFrame(const std::string& file)
{
  const unsigned char* const image = newest_;
  const View v = view();
  return image && SaveFrame(image, v.width, v.height, static_cast<int>(ImageDepth()), format_, file);
}

bool Camera::SaveFrame(const unsigned char* image, unsigned int width, unsigned int height, int, const std::string& format,
                       const std::string& file)
{
  const auto& save = physics::Mirror::Get().host.save;
  if (!save || !image)
    return false;
  const std::string pixels(reinterpret_cast<const char*>(image), ImageByteSize(width, height, format));
  return save(file, pixels, width, height, format);
}

}  // namespace rendering
}  // namespace gazebo
