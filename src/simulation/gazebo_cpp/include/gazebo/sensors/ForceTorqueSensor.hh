#pragma once
#include <array>
#include <functional>
#include <mutex>

#include <boost/weak_ptr.hpp>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// What a joint bears: force (N), and torque (N m) about the joint's origin. By <measure_direction> what the child exerts on the parent
/// (child_to_parent, the default) or the other way, in the axes of the child, the parent or the sensor by <frame>.
class GAZEBO_VISIBLE ForceTorqueSensor : public Sensor
{
public:
  ForceTorqueSensor();
  ~ForceTorqueSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  void Init() override;
  bool IsActive() const override;
  ignition::math::Vector3d Torque() const;
  ignition::math::Vector3d Force() const;
  physics::JointPtr Joint() const { return joint_.lock(); }
  event::ConnectionPtr ConnectUpdate(std::function<void(msgs::WrenchStamped)> subscriber)
  {
    return measured_.Connect(subscriber);
  }

protected:
  bool UpdateImpl(bool force) override;

private:
  mutable std::mutex mutex_;
  msgs::WrenchStamped message_;
  boost::weak_ptr<physics::Joint> joint_;
  std::string frame_;
  bool parent_to_child_ = false;
  ignition::math::Quaterniond q_CS_;     // of the sensor in the child
  std::array<NoisePtr, 6> axis_noises_;  // force x, y, z, torque x, y, z
  event::EventT<void(msgs::WrenchStamped)> measured_;
};

}  // namespace sensors
}  // namespace gazebo
