// Sensors with cameras: when their pictures are taken, and how they come back from the process that draws.
#include <gazebo/sensors/sensors.hh>

#include <chrono>
#include <map>
#include <stdexcept>
#include <utility>

#include <gazebo/common/Image.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/rendering/RenderingIface.hh>
#include <gazebo/rendering/Scene.hh>
#include <gazebo/transport/transport.hh>

#include "mirror.hpp"

namespace gazebo
{
namespace sensors
{

using Lock = std::lock_guard<std::mutex>;

namespace
{

constexpr auto patience = std::chrono::seconds(5);

common::Time time_of(int64_t ns) { return { static_cast<int32_t>(ns / 1000000000), static_cast<int32_t>(ns % 1000000000) }; }

/// Held while callbacks of a picture run.
std::recursive_timed_mutex& pictures_mutex()
{
  static auto* one = new std::recursive_timed_mutex;
  return *one;
}

/// All cameras, by the numbers that their pictures come with.
struct Book
{
  std::mutex mutex;
  std::map<int, std::pair<std::weak_ptr<Sensor>, std::size_t>> entries;
  int next = 0;
};

Book& book()
{
  static Book* one = new Book;
  return *one;
}

}  // namespace

// -- the hand-over ------------------------------------------------------------------------------------------------------------------

PictureSensor::Still::Still() : held_(pictures_mutex().try_lock_for(patience)) {}

PictureSensor::Still::~Still()
{
  if (held_)
    pictures_mutex().unlock();
}

void PictureSensor::Arrived(int number, int64_t time_ns, rendering::Picture picture)
{
  const std::lock_guard<std::recursive_timed_mutex> callbacks(pictures_mutex());
  std::shared_ptr<Sensor> sensor;
  std::size_t index = 0;
  {
    const Lock lock(book().mutex);
    const auto found = book().entries.find(number);
    if (found != book().entries.end())
      sensor = found->second.first.lock(), index = found->second.second;
  }
  if (sensor)
    static_cast<PictureSensor&>(*sensor).arrived(index, time_ns, picture);
}

PictureSensor::PictureSensor() : Sensor(IMAGE) {}

PictureSensor::~PictureSensor()
{
  const Lock lock(book().mutex);
  for (const int number : numbers_)
    book().entries.erase(number);
}

void PictureSensor::addCamera(const rendering::CameraPtr& camera, const sdf::ElementPtr& element)
{
  camera->Load(element);
  camera->Init();
  camera->Mount(link(), pose);
  camera->SetRenderRate(UpdateRate());
  cameras_.push_back(camera);
  rendering::get_scene()->Add(camera);
  const Lock lock(book().mutex);
  numbers_.push_back(++book().next);
  book().entries[numbers_.back()] = { weak_from_this(), cameras_.size() - 1 };
}

rendering::CameraPtr PictureSensor::camera(std::size_t index) const
{
  return index < cameras_.size() ? cameras_[index] : rendering::CameraPtr();
}

// -- when -----------------------------------------------------------------------------------------------------------------------------

bool PictureSensor::IsActive() const { return active || listened(); }
void PictureSensor::Update(bool) { asked_ = true; }
common::Time PictureSensor::LastMeasurementTime() const { return time_of(measured_ns_); }

void PictureSensor::SetUpdateRate(double hz)
{
  Sensor::SetUpdateRate(hz);
  for (const auto& camera : cameras_)
    camera->SetRenderRate(UpdateRate());
}

void PictureSensor::Fini()
{
  Sensor::Fini();
  ended_ = true;
  const Lock lock(mutex_);
  taken_.clear();
}

void PictureSensor::Restart()
{
  Sensor::Restart();
  const Lock lock(mutex_);
  taken_.clear();  // what is on its way is of a time that was taken back
  measured_ns_ = 0, told_ns_ = -1;
}

void PictureSensor::Step(int64_t now_ns)
{
  bool asked = asked_.exchange(false);
  for (const auto& camera : cameras_)
    asked = camera->TakeAsked() || asked;
  if (asked)
    take(true);
  else
    Sensor::Step(now_ns);
}

void PictureSensor::Measure() { take(awaited() || listened()); }

void PictureSensor::take(bool awaited)
{
  if (ended_)
    return;
  const int64_t now_ns = physics::Mirror::Get().Now();
  std::vector<std::vector<std::string>> wanted;
  {
    const Lock lock(mutex_);
    for (std::size_t i = 0; i < cameras_.size(); ++i)
    {
      wanted.push_back(cameras_[i]->Wanted(awaited));
      if (!wanted.back().empty())
        taken_.push_back({ i, now_ns, cameras_[i]->MountedPose() });
    }
  }
  for (std::size_t i = 0; i < cameras_.size(); ++i)
    if (!wanted[i].empty() && !ask(i, wanted[i]))
    {
      forget(i, now_ns);
      finish(now_ns);  // the others may have come
    }
}

bool PictureSensor::ask(std::size_t index, const std::vector<std::string>& outputs)
{
  const auto& shoot = physics::Mirror::Get().host.shoot;
  if (!shoot)
    return false;
  const rendering::Camera::View v = cameras_[index]->view();
  const auto& p = v.X_LC.Pos();
  const auto& q = v.X_LC.Rot();
  const rendering::DistortionPtr lens = cameras_[index]->LensDistortion();
  const std::vector<double> view{ p.X(),
                                  p.Y(),
                                  p.Z(),
                                  q.X(),
                                  q.Y(),
                                  q.Z(),
                                  q.W(),
                                  v.hfov,
                                  v.near,
                                  v.far,
                                  1.0 * v.width,
                                  1.0 * v.height,
                                  lens && !lens->Crop() ? 0. : 1. };
  return shoot(numbers_[index], ParentName() + "::" + Name(), static_cast<int>(index), view, outputs);
}

// -- pictures that come ---------------------------------------------------------------------------------------------------------------

/// Takes what was noted of a picture off the list; false where nothing was: it is of before a reset, or the sensor has gone.
bool PictureSensor::forget(std::size_t index, int64_t time_ns, ignition::math::Pose3d* X_WC)
{
  const Lock lock(mutex_);
  bool found = false;
  for (auto each = taken_.begin(); each != taken_.end();)
  {
    if (each->camera != index || each->time_ns > time_ns)
    {
      ++each;
      continue;
    }
    if (each->time_ns == time_ns)
    {
      found = true;
      if (X_WC)
        *X_WC = each->X_WC;
    }
    each = taken_.erase(each);  // pictures come in order: older ones come no more
  }
  return found;
}

void PictureSensor::arrived(std::size_t index, int64_t time_ns, rendering::Picture& picture)
{
  if (!forget(index, time_ns, &picture.X_WC))
    return;
  measured_ns_ = time_ns;
  const rendering::Camera::During during(*cameras_[index], picture.X_WC, time_ns);
  cameras_[index]->Develop(picture);
  finish(time_ns);
}

void PictureSensor::finish(int64_t time_ns)
{
  {
    const Lock lock(mutex_);
    for (const Taken& each : taken_)
      if (each.time_ns == time_ns)
        return;
    if (measured_ns_ != time_ns || told_ns_ == time_ns)
      return;
    told_ns_ = time_ns;
  }
  if (listened())
    publish(time_ns);
  tell();
}

void fill(const rendering::Camera& camera, msgs::Image& message)
{
  const unsigned char* const pixels = camera.ImageData();
  message.set_width(camera.ImageWidth()), message.set_height(camera.ImageHeight());
  message.set_pixel_format(common::Image::ConvertPixelFormat(camera.ImageFormat()));
  message.set_step(camera.ImageWidth() * camera.ImageDepth());
  message.set_data(pixels, pixels ? camera.ImageByteSize() : 0);
}

// -- the kinds ------------------------------------------------------------------------------------------------------------------------

CameraSensor::CameraSensor() = default;
CameraSensor::~CameraSensor() = default;
DepthCameraSensor::~DepthCameraSensor() = default;
WideAngleCameraSensor::~WideAngleCameraSensor() = default;
MultiCameraSensor::MultiCameraSensor() = default;
MultiCameraSensor::~MultiCameraSensor() = default;

rendering::CameraPtr CameraSensor::made()
{
  return rendering::CameraPtr(new rendering::Camera(Name(), rendering::get_scene()));
}

rendering::CameraPtr DepthCameraSensor::made()
{
  return rendering::CameraPtr(new rendering::DepthCamera(Name(), rendering::get_scene()));
}

rendering::CameraPtr WideAngleCameraSensor::made()
{
  return rendering::CameraPtr(new rendering::WideAngleCamera(Name(), rendering::get_scene()));
}

void WideAngleCameraSensor::Measure()
{
  physics::refused("sensor " + Name() + " of " + ParentName() +
                   ": the lens of a wideanglecamera is not drawn; its pictures are those of a camera with its horizontal_fov");
  CameraSensor::Measure();
}

void CameraSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  if (!sdf->HasElement("camera"))
    throw std::runtime_error("it has no <camera> block");
  addCamera(made(), sdf->GetElement("camera"));
  topic_ = topicOf("/image");
  publisher_ = node->Advertise<msgs::ImageStamped>(topic_, 50);
}

void CameraSensor::publish(int64_t time_ns)
{
  msgs::ImageStamped message;
  msgs::Set(message.mutable_time(), time_of(time_ns));
  fill(*Camera(), *message.mutable_image());
  publisher_->Publish(message);
}

void MultiCameraSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  if (!sdf->HasElement("camera"))
    throw std::runtime_error("it has no <camera> block");
  for (auto element = sdf->GetElement("camera"); element; element = element->GetNextElement("camera"))
  {
    const std::string name = Name() + "::" + element->Get<std::string>("name");
    addCamera(rendering::CameraPtr(new rendering::Camera(name, rendering::get_scene())), element);
  }
  topic_ = topicOf("/images");
  publisher_ = node->Advertise<msgs::ImagesStamped>(topic_, 50);
}

void MultiCameraSensor::publish(int64_t time_ns)
{
  msgs::ImagesStamped message;
  msgs::Set(message.mutable_time(), time_of(time_ns));
  for (unsigned int i = 0; i < CameraCount(); ++i)
    fill(*Camera(i), *message.add_image());
  publisher_->Publish(message);
}

unsigned int MultiCameraSensor::ImageWidth(unsigned int index) const
{
  const rendering::CameraPtr one = camera(index);
  return one ? one->ImageWidth() : 0;
}

unsigned int MultiCameraSensor::ImageHeight(unsigned int index) const
{
  const rendering::CameraPtr one = camera(index);
  return one ? one->ImageHeight() : 0;
}

const unsigned char* MultiCameraSensor::ImageData(unsigned int index)
{
  const rendering::CameraPtr one = camera(index);
  return one ? one->ImageData() : nullptr;
}

bool MultiCameraSensor::SaveFrame(const std::vector<std::string>& files)
{
  bool all = files.size() == cameraCount();
  for (std::size_t i = 0; i < files.size() && i < cameraCount(); ++i)
    all = camera(i)->SaveFrame(files[i]) && all;
  return all;
}

}  // namespace sensors
}  // namespace gazebo
