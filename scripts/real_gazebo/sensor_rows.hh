// What the sensors of Gazebo's core measure, each in one row; they are measured in threads of their own.
#pragma once

#include <cstdio>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

// Some names begin with the world's.
inline std::string Short(gazebo::physics::WorldPtr world, const std::string& name)
{
  const std::string prefix = world->Name() + "::";
  return name.compare(0, prefix.size(), prefix) ? name : name.substr(prefix.size());
}

class SensorRows
{
public:
  static bool Ready()
  {
    auto* manager = gazebo::sensors::SensorManager::Instance();
    return manager->SensorsInitialized() && !manager->GetSensors().empty();
  }

  void Write(std::FILE* file, double elapsed)
  {
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& entry : heard_)
      std::fprintf(file, "sensor:%s,%.6g%s\n", entry.first.c_str(), elapsed, entry.second.c_str());
    heard_.clear();
  }

  void Connect(gazebo::physics::WorldPtr world)
  {
    world_ = world;
    for (const auto& sensor : gazebo::sensors::SensorManager::Instance()->GetSensors())
    {
      sensor->SetActive(true);
      auto* raw = sensor.get();
      connections_.push_back(sensor->ConnectUpdated([this, raw] { Measure(raw); }));
    }
  }

private:
  std::string Short(const std::string& name) const { return ::Short(world_, name); }

  void Hear(const std::string& name, const gazebo::common::Time& time, const std::vector<double>& values,
            const std::string& words = "")
  {
    std::ostringstream line;
    line.precision(7);
    line << "," << time.Double();
    for (double value : values)
      line << "," << value;
    if (!words.empty())
      line << "," << words;
    std::lock_guard<std::mutex> lock(mutex_);
    heard_[name] = line.str();
  }

  void Measure(gazebo::sensors::Sensor* sensor)
  {
    const std::string name = Short(sensor->ScopedName());
    const auto time = sensor->LastMeasurementTime();
    if (auto* ray = dynamic_cast<gazebo::sensors::RaySensor*>(sensor))
    {
      std::vector<double> ranges;
      ray->Ranges(ranges);
      Hear(name, time, ranges);
    }
    else if (auto* imu = dynamic_cast<gazebo::sensors::ImuSensor*>(sensor))
    {
      const auto q = imu->Orientation();
      const auto w = imu->AngularVelocity(), a = imu->LinearAcceleration();
      Hear(name, time, { q.X(), q.Y(), q.Z(), q.W(), w.X(), w.Y(), w.Z(), a.X(), a.Y(), a.Z() });
    }
    else if (auto* scale = dynamic_cast<gazebo::sensors::ForceTorqueSensor*>(sensor))
    {
      const auto f = scale->Force(), t = scale->Torque();
      Hear(name, time, { f.X(), f.Y(), f.Z(), t.X(), t.Y(), t.Z() });
    }
    else if (auto* altimeter = dynamic_cast<gazebo::sensors::AltimeterSensor*>(sensor))
    {
      Hear(name, time, { altimeter->Altitude(), altimeter->VerticalVelocity(), altimeter->ReferenceAltitude() });
    }
    else if (auto* magnetometer = dynamic_cast<gazebo::sensors::MagnetometerSensor*>(sensor))
    {
      const auto b = magnetometer->MagneticField();
      Hear(name, time, { b.X(), b.Y(), b.Z() });
    }
    else if (auto* gps = dynamic_cast<gazebo::sensors::GpsSensor*>(sensor))
    {
      Hear(name, time,
           { gps->Latitude().Degree(), gps->Longitude().Degree(), gps->Altitude(), gps->VelocityEast(), gps->VelocityNorth(),
             gps->VelocityUp() });
    }
    else if (auto* sonar = dynamic_cast<gazebo::sensors::SonarSensor*>(sensor))
    {
      Hear(name, time, { sonar->Range() });
    }
    else if (auto* contact = dynamic_cast<gazebo::sensors::ContactSensor*>(sensor))
    {
      MeasureContact(name, time, contact);
    }
    else if (auto* logical = dynamic_cast<gazebo::sensors::LogicalCameraSensor*>(sensor))
    {
      const auto image = logical->Image();
      for (int i = 0; i < image.model_size(); ++i)
      {
        const auto pose = gazebo::msgs::ConvertIgn(image.model(i).pose());
        Hear(
            name + "." + Short(image.model(i).name()), time,
            { pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(), pose.Rot().W() });
      }
    }
  }

  void MeasureContact(const std::string& name, const gazebo::common::Time& time, gazebo::sensors::ContactSensor* sensor)
  {
    const auto contacts = sensor->Contacts();
    for (int i = 0; i < contacts.contact_size(); ++i)
    {
      const auto& contact = contacts.contact(i);
      std::vector<double> values;
      for (int k = 0; k < contact.position_size(); ++k)
      {
        const auto p = gazebo::msgs::ConvertIgn(contact.position(k)), n = gazebo::msgs::ConvertIgn(contact.normal(k));
        const auto f = gazebo::msgs::ConvertIgn(contact.wrench(k).body_1_wrench().force());
        values.insert(values.end(), { p.X(), p.Y(), p.Z(), n.X(), n.Y(), n.Z(), contact.depth(k), f.X(), f.Y(), f.Z() });
      }
      Hear(name + "." + Short(contact.collision1()) + "|" + Short(contact.collision2()), time, values);
    }
  }

  gazebo::physics::WorldPtr world_;
  std::mutex mutex_;
  std::map<std::string, std::string> heard_;
  std::vector<gazebo::event::ConnectionPtr> connections_;
};
