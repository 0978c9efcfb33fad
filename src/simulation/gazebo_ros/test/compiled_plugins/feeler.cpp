// A plugin for sensors of any kind: publishes what they measure, with the stamp first.
#include <gazebo/gazebo.hh>
#include <gazebo/sensors/sensors.hh>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

namespace gazebo
{

class Feeler : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override
  {
    sensor_ = sensor;
    values_ = nh_->advertise<std_msgs::Float64MultiArray>("feel/" + sensor->Name(), 1000, true);
    updated_ = sensor->ConnectUpdated([this] { OnUpdate(); });
    sensor->SetActive(true);
    const auto world = physics::get_world(sensor->WorldName());
    const auto link = boost::dynamic_pointer_cast<physics::Link>(world->EntityByName(sensor->ParentName()));
    const bool named = !link || link->GetSensorName(0) == sensor->ScopedName();
    Publish({ sdf->Get<double>("mark"), sensors::get_sensor(sensor->ScopedName()) == sensor && named ? 1.0 : 0.0 });
  }

private:
  void OnUpdate()
  {
    std::vector<double> values{ sensor_->LastMeasurementTime().Double() };
    const auto add = [&](const ignition::math::Vector3d& v) { values.insert(values.end(), { v.X(), v.Y(), v.Z() }); };
    if (const auto imu = std::dynamic_pointer_cast<sensors::ImuSensor>(sensor_))
      add(imu->AngularVelocity()), add(imu->LinearAcceleration(true)), add(imu->Orientation().Euler());
    else if (const auto contact = std::dynamic_pointer_cast<sensors::ContactSensor>(sensor_))
    {
      const msgs::Contacts now = contact->Contacts();
      values.push_back(contact->GetCollisionContactCount(contact->GetCollisionName(0)));
      double forces[2] = { 0, 0 }, own = 0;  // on the first and on the second of the two; whether the first is the sensor's
      for (const auto& each : now.contact())
      {
        own = each.collision1() == contact->GetCollisionName(0);
        for (const auto& wrench : each.wrench())
          forces[0] += wrench.body_1_wrench().force().z(), forces[1] += wrench.body_2_wrench().force().z();
      }
      values.insert(values.end(), { own, forces[0], forces[1] });
    }
    else if (const auto scale = std::dynamic_pointer_cast<sensors::ForceTorqueSensor>(sensor_))
      add(scale->Force()), add(scale->Torque()), values.push_back(scale->Joint()->GetName() == "j");
    else if (const auto gps = std::dynamic_pointer_cast<sensors::GpsSensor>(sensor_))
      values.insert(values.end(), { gps->Latitude().Degree(), gps->Longitude().Degree(), gps->Altitude() });
    else if (const auto altimeter = std::dynamic_pointer_cast<sensors::AltimeterSensor>(sensor_))
      values.insert(values.end(), { altimeter->Altitude(), altimeter->VerticalVelocity() });
    else if (const auto field = std::dynamic_pointer_cast<sensors::MagnetometerSensor>(sensor_))
      add(field->MagneticField() * 1e6);
    else if (const auto sonar = std::dynamic_pointer_cast<sensors::SonarSensor>(sensor_))
      values.push_back(sonar->Range());
    else if (const auto camera = std::dynamic_pointer_cast<sensors::LogicalCameraSensor>(sensor_))
    {
      const msgs::LogicalCameraImage image = camera->Image();
      for (const auto& model : image.model())
        values.push_back(static_cast<double>(model.name().size())), add(msgs::ConvertIgn(model.pose()).Pos());
    }
    Publish(values);
  }

  void Publish(const std::vector<double>& values)
  {
    std_msgs::Float64MultiArray message;
    message.data = values;
    values_.publish(message);
  }

  boost::scoped_ptr<ros::NodeHandle> nh_{ new ros::NodeHandle };  // known from Gazebo's headers, as to many plugins of others
  ros::Publisher values_;
  sensors::SensorPtr sensor_;
  event::ConnectionPtr updated_;
};

GZ_REGISTER_SENSOR_PLUGIN(Feeler)

}  // namespace gazebo
