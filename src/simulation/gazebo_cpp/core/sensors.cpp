// What all sensors share, and the list of them.
#include <gazebo/sensors/sensors.hh>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace sensors
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

// -- Sensor -------------------------------------------------------------------------------------------------------------------------

namespace
{

std::atomic<uint32_t> ids{ 1 };

std::string with_slashes(std::string name)
{
  for (std::size_t at; (at = name.find("::")) != std::string::npos;)
    name.replace(at, 2, "/");
  return name;
}

}  // namespace

Sensor::Sensor(SensorCategory category) : category_(category), id_(ids++) {}
Sensor::~Sensor() = default;

void Sensor::Load(const std::string& world, sdf::ElementPtr element)
{
  sdf = element;
  name_ = sdf->Get<std::string>("name");
  type_ = sdf->Get<std::string>("type");
  visualize_ = sdf->HasElement("visualize") && sdf->Get<bool>("visualize");
  active = sdf->HasElement("always_on") && sdf->Get<bool>("always_on");
  if (sdf->HasElement("pose"))
    pose = sdf->Get<Pose3d>("pose");
  SetUpdateRate(sdf->HasElement("update_rate") ? sdf->Get<double>("update_rate") : 0);
  node.reset(new transport::Node);
  node->Init(world);
  world_ = world;
  Load(world);
}

void Sensor::Load(const std::string& world) { world_ = world; }
void Sensor::Fini() { active = false; }
std::string Sensor::ScopedName() const { return world_ + "::" + parentName + "::" + name_; }
bool Sensor::listened() const { return publisher_ && publisher_->HasConnections(); }
bool Sensor::IsActive() const { return active || updated_.ConnectionCount() || listened(); }

void Sensor::SetUpdateRate(double hz)
{
  rate_ = hz > 0 ? hz : 0;
  period_ns_ = hz > 0 ? static_cast<int64_t>(std::llround(1e9 / hz)) : 0;
}

NoisePtr Sensor::Noise(SensorNoiseType type) const
{
  const auto found = noises.find(type);
  return found == noises.end() ? NoisePtr() : found->second;
}

NoisePtr Sensor::noiseFrom(const sdf::ElementPtr& parent, SensorNoiseType type)
{
  if (!parent || !parent->HasElement("noise"))
    return NoisePtr();
  const NoisePtr noise = NoiseFactory::NewNoiseModel(parent->GetElement("noise"), type_);
  noise->Seed(ScopedName() + "/" + std::to_string(type));
  return noises[type] = noise;
}

std::string Sensor::topicOf(const std::string& end) const
{
  if (sdf->HasElement("topic") && sdf->Get<std::string>("topic") != "__default__")
    return sdf->Get<std::string>("topic");
  return ownTopic(end);
}

std::string Sensor::ownTopic(const std::string& end) const
{
  return "~/" + with_slashes(parentName) + "/" + with_slashes(name_) + end;
}

Pose3d Sensor::worldPose() const
{
  const physics::LinkPtr on = link();
  return on ? pose + on->WorldPose() : pose;
}

Vector3d Sensor::velocity() const
{
  const physics::LinkPtr on = link();
  return on ? on->WorldLinearVel(pose.Pos()) : Vector3d();
}

void Sensor::FillMsg(msgs::Sensor& message)
{
  message.set_name(name_), message.set_id(id_), message.set_type(type_);
  message.set_parent(parentName), message.set_parent_id(parentId);
  message.set_always_on(active), message.set_update_rate(rate_), message.set_visualize(visualize_), message.set_topic(Topic());
  msgs::Set(message.mutable_pose(), pose);
}

/// Gazebo's rule: what is late is carried over, so that 30 Hz on a 1 ms step gives 30 measurements a second.
bool Sensor::due(int64_t now_ns)
{
  if (now_ns < last_ns_)
    Restart();
  return now_ns > last_ns_ && now_ns - last_ns_ + late_ns_ >= period_ns_;
}

void Sensor::take(int64_t now_ns)
{
  const int64_t late = std::max<int64_t>(0, now_ns - last_ns_ + late_ns_ - period_ns_);
  late_ns_ = late < period_ns_ ? late : 0;
  last_ns_ = now_ns;
}

void Sensor::Restart()
{
  last_ns_ = late_ns_ = 0;
  lastUpdateTime = lastMeasurementTime = common::Time();
}

void Sensor::Step(int64_t now_ns)
{
  if (!due(now_ns))
    return;
  take(now_ns);  // whether anybody wants it or not: when it measures must not depend on who listens since when
  // Of most nobody in C++ knows: Python's plugins measure by themselves.
  if (known_ ? IsActive() : listened())
    Measure();
}

void Sensor::Update(bool force)
{
  const common::Time now = physics::get_world()->SimTime();
  dt_ = lastMeasurementTime == common::Time() ? 0 : (now - lastMeasurementTime).Double();
  if (!force && dt_ <= 0)
    return;
  lastUpdateTime = lastMeasurementTime = now;
  if (UpdateImpl(force))
    updated_();
}

// -- all of them --------------------------------------------------------------------------------------------------------------------

SensorPtr get_sensor(const std::string& name) { return SensorManager::Instance()->GetSensor(name); }

Sensor_V SensorManager::GetSensors() const
{
  const auto all = list();
  for (const SensorPtr& sensor : *all)
    sensor->known_ = true;
  return *all;
}

std::shared_ptr<const Sensor_V> SensorManager::list() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return sensors_;
}

SensorPtr SensorManager::GetSensor(const std::string& name) const
{
  SensorPtr found;
  unsigned int several = 0;
  const auto all = list();
  for (const SensorPtr& sensor : *all)
  {
    if (sensor->ScopedName() == name)
    {
      found = sensor, several = 1;
      break;
    }
    if (sensor->Name() == name)
      found = sensor, ++several;
  }
  if (several < 2)
  {
    if (found)
      found->known_ = true;
    return found;
  }
  gzerr << several << " sensors are named '" << name << "'; say which: " << found->ScopedName() << ", ..." << std::endl;
  return SensorPtr();
}

void SensorManager::ResetLastUpdateTimes()
{
  const auto all = list();
  for (const SensorPtr& sensor : *all)
    sensor->Restart();
}

void SensorManager::RemoveSensor(const std::string& name)
{
  if (const SensorPtr sensor = GetSensor(name))
    sensor->Fini();
}

void SensorManager::removeOf(const std::string& model)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  auto left = std::make_shared<Sensor_V>();
  for (const SensorPtr& sensor : *sensors_)
    if (sensor->ParentName().compare(0, model.size() + 2, model + "::") != 0)
      left->push_back(sensor);
    else
      sensor->Fini();
  replace(left);
}

void SensorManager::replace(const std::shared_ptr<Sensor_V>& sensors)
{
  sensors_ = sensors;
  pictures_ = std::any_of(sensors->begin(), sensors->end(), [](const SensorPtr& each) { return each->Category() == IMAGE; });
}

namespace
{

SensorPtr made(const std::string& type)
{
  if (type == "ray" || type == "lidar")
    return std::make_shared<RaySensor>();
  if (type == "gpu_ray" || type == "gpu_lidar")
    return std::make_shared<GpuRaySensor>();
  if (type == "contact")
    return std::make_shared<ContactSensor>();
  if (type == "imu")
    return std::make_shared<ImuSensor>();
  if (type == "force_torque")
    return std::make_shared<ForceTorqueSensor>();
  if (type == "gps" || type == "navsat")
    return std::make_shared<GpsSensor>();
  if (type == "altimeter")
    return std::make_shared<AltimeterSensor>();
  if (type == "magnetometer")
    return std::make_shared<MagnetometerSensor>();
  if (type == "sonar")
    return std::make_shared<SonarSensor>();
  if (type == "logical_camera")
    return std::make_shared<LogicalCameraSensor>();
  if (type == "camera")
    return std::make_shared<CameraSensor>();
  if (type == "depth" || type == "depth_camera" || type == "rgbd_camera")
    return std::make_shared<DepthCameraSensor>();
  if (type == "multicamera")
    return std::make_shared<MultiCameraSensor>();
  if (type == "wideanglecamera")
    return std::make_shared<WideAngleCameraSensor>();
  return SensorPtr();
}

}  // namespace

void SensorManager::add(const SensorPtr& sensor, const sdf::ElementPtr& sdf)
{
  try
  {
    sensor->Load(physics::get_world()->Name(), sdf);
  }
  catch (const std::exception& error)
  {
    internal::Report(true, "sensor " + sdf->Get<std::string>("name") + " of " + sensor->ParentName() + ": " + error.what() +
                               "; compiled plugins do not see it");
    return;
  }
  sensor->Init();
  const std::lock_guard<std::mutex> lock(mutex_);
  auto more = std::make_shared<Sensor_V>(*sensors_);
  more->push_back(sensor);
  replace(more);
}

void SensorManager::addOf(const std::string& name, uint32_t id, const physics::LinkPtr& link, const sdf::ElementPtr& sdf)
{
  if (!sdf->HasElement("sensor"))
    return;
  for (auto each = sdf->GetElement("sensor"); each; each = each->GetNextElement("sensor"))
    if (const SensorPtr sensor = made(each->Get<std::string>("type")))
    {
      sensor->SetParent(name, id);
      sensor->SetLink(link);
      add(sensor, each);
    }
}

void SensorManager::addOf(const std::string& model)
{
  const physics::ModelPtr found = physics::get_world()->ModelByName(model);
  if (!found || !physics::Mirror::Mentions(*found, "sensor"))
    return;
  const sdf::ElementPtr sdf = found->GetSDF();
  for (auto element = inside(sdf, "link"); element; element = element->GetNextElement("link"))
    if (const physics::LinkPtr link = found->GetLink(element->Get<std::string>("name")))
      addOf(link->GetScopedName(), link->GetId(), link, element);
  for (auto element = inside(sdf, "joint"); element; element = element->GetNextElement("joint"))
    if (const physics::JointPtr joint = found->GetJoint(element->Get<std::string>("name")))
      addOf(joint->GetScopedName(), joint->GetId(), joint->GetChild(), element);
}

void SensorManager::Start()
{
  using event::Events;
  connections_ = { Events::ConnectAddEntity([this](const std::string& model) { addOf(model); }),
                   Events::ConnectDeleteEntity([this](const std::string& model) { removeOf(model); }),
                   Events::ConnectTimeReset([this] { ResetLastUpdateTimes(); }),
                   Events::ConnectWorldUpdateEnd([this] { step(); }) };
}

void SensorManager::step()
{
  const common::Time now = physics::get_world()->SimTime();
  const int64_t now_ns = now.sec * INT64_C(1000000000) + now.nsec;
  const auto all = list();
  if (pictures_)
    event::Events::preRender();
  for (const SensorPtr& sensor : *all)
    sensor->Step(now_ns);
  if (pictures_)
    event::Events::render(), event::Events::postRender();
}

}  // namespace sensors
}  // namespace gazebo
