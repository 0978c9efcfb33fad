#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <boost/enable_shared_from_this.hpp>
#include <ignition/math/Vector3.hh>
#include <sdf/sdf.hh>

#include <gazebo/common/SphericalCoordinates.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/common/UpdateInfo.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/Atmosphere.hh>
#include <gazebo/physics/Base.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/physics/Wind.hh>

namespace gazebo
{
namespace physics
{

/// What plugins of the simulator see of its world. What changes what there is (models inserted or removed, reset) comes after the step.
class GAZEBO_VISIBLE World : public boost::enable_shared_from_this<World>
{
public:
  explicit World(const std::string& name = "");
  ~World();
  const sdf::ElementPtr SDF();
  std::string Name() const { return name_; }
  std::string GetName() const { return name_; }
  bool Running() const { return true; }
  bool IsLoaded() const { return true; }
  PhysicsEnginePtr Physics() const { return physics_; }
  common::SphericalCoordinatesPtr SphericalCoords() const { return place_; }
  ignition::math::Vector3d Gravity() const;
  void SetGravity(const ignition::math::Vector3d& gravity);
  void SetGravitySDF(const ignition::math::Vector3d& gravity) { SetGravity(gravity); }
  ignition::math::Vector3d MagneticField() const { return magnetic_; }
  void SetMagneticField(const ignition::math::Vector3d& field) { magnetic_ = field; }
  unsigned int ModelCount() const;
  ModelPtr ModelByIndex(unsigned int index) const;
  Model_V Models() const;
  unsigned int LightCount() const { return 0; }
  Light_V Lights() const { return {}; }
  LightPtr LightByName(const std::string&) const { return LightPtr(); }
  void ResetEntities(Base::EntityType type = Base::BASE);  // of whatever type: poses back to the first ones
  void ResetTime();
  void Reset();
  void ResetPhysicsStates();
  common::Time SimTime() const;
  void SetSimTime(const common::Time& time);  // the world goes on from there
  common::Time PauseTime() const;
  common::Time StartTime() const { return start_; }
  common::Time RealTime() const;
  bool IsPaused() const { return paused_; }
  void SetPaused(bool paused);
  BasePtr BaseByName(const std::string& name) const;
  ModelPtr ModelByName(const std::string& name) const;
  EntityPtr EntityByName(const std::string& name) const;
  ModelPtr ModelBelowPoint(const ignition::math::Vector3d& point) const;
  EntityPtr EntityBelowPoint(const ignition::math::Vector3d& point) const;
  void InsertModelFile(const std::string& file);
  void InsertModelString(const std::string& text);
  void InsertModelSDF(const sdf::SDF& sdf);
  void RemoveModel(ModelPtr model);
  void RemoveModel(const std::string& name);
  void ClearModels();
  void LoadPlugin(const std::string& filename, const std::string& name, sdf::ElementPtr sdf);
  std::string StripWorldName(const std::string& name) const;
  std::string UniqueModelName(const std::string& name);
  void EnableAllModels();
  void DisableAllModels();
  void Step(unsigned int steps);
  std::mutex& WorldPoseMutex() const { return pose_mutex_; }
  bool PhysicsEnabled() const { return true; }
  void SetPhysicsEnabled(bool enable);
  bool WindEnabled() const { return windy_; }
  void SetWindEnabled(bool enable) { windy_ = enable; }
  class Wind& Wind() const;
  bool AtmosphereEnabled() const { return airy_; }
  void SetAtmosphereEnabled(bool enable) { airy_ = enable; }
  class Atmosphere& Atmosphere() const;
  void PublishModelPose(ModelPtr) {}
  void PublishModelScale(ModelPtr) {}
  uint32_t Iterations() const;
  void PrintEntityTree();
  ode_sim::World* Core() const { return core_; }

private:
  friend class Mirror;
  friend class PhysicsEngine;
  ode_sim::World* core_ = nullptr;
  std::string name_, text_;
  PhysicsEnginePtr physics_;
  common::SphericalCoordinatesPtr place_;
  ignition::math::Vector3d magnetic_{ 5.5645e-6, 22.8758e-6, -42.3884e-6 };
  common::Time start_, paused_since_;
  mutable std::mutex pose_mutex_, models_mutex_;
  Model_V models_;
  bool paused_ = false, windy_ = true, airy_ = true;
  mutable std::unique_ptr<class Wind> wind_;              // made when it is first asked for
  mutable std::unique_ptr<class Atmosphere> atmosphere_;  // likewise
  sdf::ElementPtr sdf_;
};

}  // namespace physics
}  // namespace gazebo
