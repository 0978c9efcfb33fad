// The force-torque sensor of a joint.
#include <gazebo/sensors/ForceTorqueSensor.hh>

#include <stdexcept>

#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "sdf_text.hpp"

namespace gazebo
{
namespace sensors
{

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

ForceTorqueSensor::ForceTorqueSensor() : Sensor(OTHER) {}
ForceTorqueSensor::~ForceTorqueSensor() = default;

void ForceTorqueSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const auto joint = boost::dynamic_pointer_cast<physics::Joint>(physics::get_world()->BaseByName(ParentName()));
  if (!joint)
    throw std::runtime_error("a force_torque sensor belongs into a <joint>");
  joint_ = joint;
  q_CS_ = joint->InitialAnchorPose().Rot() * pose.Rot();
  const sdf::ElementPtr block = inside(sdf, "force_torque");
  const auto said = [&](const char* tag) {
    return block && block->HasElement(tag) ? block->Get<std::string>(tag) : std::string();
  };
  frame_ = said("frame");
  parent_to_child_ = said("measure_direction") == "parent_to_child";
  static const char* const vectors[] = { "force", "torque" };
  static const char* const axes[] = { "x", "y", "z" };
  for (std::size_t k = 0; k < axis_noises_.size(); ++k)
  {
    const sdf::ElementPtr axis = inside(inside(block, vectors[k / 3]), axes[k % 3]);
    if (!inside(axis, "noise"))
      continue;
    axis_noises_[k] = NoiseFactory::NewNoiseModel(axis->GetElement("noise"), Type());
    axis_noises_[k]->Seed(ScopedName() + "/" + vectors[k / 3] + "/" + axes[k % 3]);
  }
  topic_ = ownTopic("/wrench");  // Gazebo does not look at <topic> here
  publisher_ = node->Advertise<msgs::WrenchStamped>(topic_, 50);
  msgs::Set(message_.mutable_time(), common::Time());
  for (auto* vector : { message_.mutable_wrench()->mutable_force(), message_.mutable_wrench()->mutable_torque() })
    msgs::Set(vector, Vector3d());
}

void ForceTorqueSensor::Init()
{
  if (const physics::JointPtr joint = Joint())
    joint->SetProvideFeedback(true);
}

bool ForceTorqueSensor::IsActive() const { return Sensor::IsActive() || measured_.ConnectionCount(); }

bool ForceTorqueSensor::UpdateImpl(bool)
{
  const physics::JointPtr joint = Joint();
  if (!joint)
    return false;
  const physics::JointWrench wrench = joint->GetForceTorque(0);
  const bool of_parent = frame_ == "parent";
  // Of the two bodies' wrenches, each in its own axes, the first is what the parent exerts.
  const double sign = of_parent == parent_to_child_ ? 1 : -1;
  Vector3d values[] = { sign * (of_parent ? wrench.body1Force : wrench.body2Force),
                        sign * (of_parent ? wrench.body1Torque : wrench.body2Torque) };
  const double dt = sinceLast();
  msgs::WrenchStamped now;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t k = 0; k < 2; ++k)
    {
      if (frame_ == "sensor")
        values[k] = q_CS_.RotateVectorReverse(values[k]);
      for (std::size_t i = 0; i < 3; ++i)
        if (const NoisePtr& noise = axis_noises_[3 * k + i])
          values[k][i] = noise->Apply(values[k][i], dt);
    }
    msgs::Set(message_.mutable_time(), lastMeasurementTime);
    msgs::Set(message_.mutable_wrench()->mutable_force(), values[0]);
    msgs::Set(message_.mutable_wrench()->mutable_torque(), values[1]);
    now = message_;
  }
  measured_(now);
  if (listened())
    publisher_->Publish(now);
  return true;
}

Vector3d ForceTorqueSensor::Force() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return msgs::ConvertIgn(message_.wrench().force());
}

Vector3d ForceTorqueSensor::Torque() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return msgs::ConvertIgn(message_.wrench().torque());
}

}  // namespace sensors
}  // namespace gazebo
