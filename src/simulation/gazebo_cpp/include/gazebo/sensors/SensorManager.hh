#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/common/SingletonT.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// All sensors of the world's models.
class GAZEBO_VISIBLE SensorManager : public SingletonT<SensorManager>
{
public:
  /// \param name world::model::link::sensor (of a force_torque sensor ...::joint::sensor), or the sensor's own name where only one has it
  SensorPtr GetSensor(const std::string& name) const;
  Sensor_V GetSensors() const;
  bool SensorsInitialized() { return true; }
  void ResetLastUpdateTimes();
  void RemoveSensor(const std::string& name);

  /// For the simulator: from now on it knows of models, steps and resets.
  void Start();

private:
  friend class SingletonT<SensorManager>;
  SensorManager() = default;
  /// Those of a <link> or <joint> ``sdf``, called ``name``; of a kind that is not here: nothing.
  void addOf(const std::string& name, uint32_t id, const physics::LinkPtr& link, const sdf::ElementPtr& sdf);
  void add(const SensorPtr& sensor, const sdf::ElementPtr& sdf);
  void addOf(const std::string& model);
  void removeOf(const std::string& model);
  void step();
  void replace(const std::shared_ptr<Sensor_V>& sensors);
  std::shared_ptr<const Sensor_V> list() const;
  mutable std::mutex mutex_;
  std::shared_ptr<const Sensor_V> sensors_ = std::make_shared<Sensor_V>();
  std::atomic<bool> pictures_{ false };  // there is a camera
  std::vector<event::ConnectionPtr> connections_;
};

/// By name, as SensorManager::GetSensor().
GAZEBO_VISIBLE SensorPtr get_sensor(const std::string& name);

}  // namespace sensors
}  // namespace gazebo
