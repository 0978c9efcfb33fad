#pragma once
#include <memory>
#include <string>

#include <boost/any.hpp>
#include <boost/thread/mutex.hpp>
#include <boost/thread/recursive_mutex.hpp>
#include <ignition/math/Vector3.hh>
#include <sdf/sdf.hh>

#include <gazebo/physics/ContactManager.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/common/common.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace physics
{

/// The settings of the steps. Parameters by Gazebo's names.
class GAZEBO_VISIBLE PhysicsEngine
{
public:
  explicit PhysicsEngine(WorldPtr world);
  virtual ~PhysicsEngine();
  virtual void InitForThread() {}
  virtual std::string GetType() const { return "ode"; }
  virtual void SetSeed(uint32_t seed);
  double GetUpdatePeriod();
  double GetTargetRealTimeFactor() const { return target_factor_; }
  double GetRealTimeUpdateRate() const { return update_rate_; }
  double GetMaxStepSize() const;
  void SetTargetRealTimeFactor(double factor) { target_factor_ = factor; }
  void SetRealTimeUpdateRate(double rate);
  void SetMaxStepSize(double step);
  virtual ShapePtr CreateShape(const std::string& type, CollisionPtr collision);  // "ray", "multiray"; others are null
  /// One that meets nothing by itself, with such a shape.
  virtual CollisionPtr CreateCollision(const std::string& type, LinkPtr link);
  CollisionPtr CreateCollision(const std::string& type, const std::string& link);
  virtual JointPtr CreateJoint(const std::string& type, ModelPtr model = ModelPtr());
  virtual void SetGravity(const ignition::math::Vector3d& gravity);
  virtual void SetAutoDisableFlag(bool) {}
  virtual bool GetAutoDisableFlag() { return false; }
  virtual void SetMaxContacts(unsigned int most);
  virtual bool SetParam(const std::string& key, const boost::any& value);
  virtual boost::any GetParam(const std::string& key) const;
  virtual bool GetParam(const std::string& key, boost::any& value) const;
  WorldPtr World() const;
  ContactManager* GetContactManager() const { return contacts_.get(); }
  boost::recursive_mutex* GetPhysicsUpdateMutex() const { return &mutex_; }  // held during the step
  sdf::ElementPtr GetSDF() const;

private:
  friend class Mirror;
  class World* world_;
  std::unique_ptr<ContactManager> contacts_;
  mutable boost::recursive_mutex mutex_;
  double target_factor_ = 1, update_rate_ = 1000;
};

}  // namespace physics
}  // namespace gazebo
