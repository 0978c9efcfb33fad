// libBreakableJointPlugin.so: a joint that lets go, for good, once its force_torque sensor measures more than <breaking_force_N> (1 N).
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

namespace gazebo
{

class BreakableJointPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override
  {
    sensor_ = std::dynamic_pointer_cast<sensors::ForceTorqueSensor>(sensor);
    if (!sensor_)
      throw std::runtime_error("it belongs into a sensor of type force_torque; " + sensor->Name() + " is of type " +
                               sensor->Type());
    if (sdf->HasElement("breaking_force_N"))
      strength_ = sdf->Get<double>("breaking_force_N");
    measured_ = sensor_->ConnectUpdate([this](const msgs::WrenchStamped& message) {
      breaks_ = breaks_ || msgs::ConvertIgn(message.wrench().force()).Length() > strength_;
    });
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) {
      if (breaks_)
        letGo();
    });
  }

private:
  // Between two measurements: in one, the sensor's own list of listeners is under way.
  void letGo()
  {
    breaks_ = false;
    measured_.reset();
    sensor_->SetActive(false);
    if (const physics::JointPtr joint = sensor_->Joint())
      joint->Detach();
  }

  sensors::ForceTorqueSensorPtr sensor_;
  double strength_ = 1;  // N
  bool breaks_ = false;
  event::ConnectionPtr measured_, update_;
};
GZ_REGISTER_SENSOR_PLUGIN(BreakableJointPlugin)

}  // namespace gazebo
