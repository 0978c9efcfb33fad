#pragma once
#include <functional>
#include <memory>
#include <string>

#include <ignition/math/Matrix3.hh>
#include <ignition/math/Quaternion.hh>

#include <gazebo/common/Battery.hh>
#include <gazebo/common/Event.hh>
#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/Inertial.hh>
#include <gazebo/physics/Joint.hh>

namespace gazebo
{
namespace physics
{

/// Forces (N) and torques (N m) act in the next step. A force that is not a number is left out, with one line.
class GAZEBO_VISIBLE Link : public Entity
{
  using Vector3d = ignition::math::Vector3d;

public:
  explicit Link(EntityPtr parent);
  ~Link() override;
  void Init() override;  // of an actor: its collisions touch others from then on
  bool IsStatic() const override;
  const ignition::math::Pose3d& WorldPose() const override;
  virtual void SetEnabled(bool enable) const;
  virtual bool GetEnabled() const;
  virtual void SetGravityMode(bool on);
  virtual bool GetGravityMode() const;
  virtual void SetWindMode(bool enable) { windy_ = enable; }  // <enable_wind> of the link or of its model
  virtual bool WindMode() const { return windy_; }
  virtual void SetSelfCollide(bool collide);
  bool GetSelfCollide() const;
  void SetCollideMode(const std::string& mode);
  void SetLaserRetro(float retro);
  virtual void SetKinematic(const bool& kinematic);
  virtual bool GetKinematic() const;
  virtual void SetAutoDisable(bool) {}
  virtual void SetLinkStatic(bool) {}
  virtual void SetStatic(const bool&) {}
  virtual void SetLinearDamping(double damping);
  virtual void SetAngularDamping(double damping);
  double GetLinearDamping() const;
  double GetAngularDamping() const;
  void ResetPhysicsStates();

  virtual void SetLinearVel(const Vector3d& velocity);  // of the centre of mass
  virtual void SetAngularVel(const Vector3d& velocity);
  void SetWorldTwist(const Vector3d& linear, const Vector3d& angular, bool = true) override;  // of the origin
  virtual void SetForce(const Vector3d& force);
  virtual void SetTorque(const Vector3d& torque);
  virtual void AddForce(const Vector3d& force);
  virtual void AddRelativeForce(const Vector3d& force);
  virtual void AddForceAtWorldPosition(const Vector3d& force, const Vector3d& position);
  virtual void AddForceAtRelativePosition(const Vector3d& force,
                                          const Vector3d& position);  // link axes, from the centre of mass
  virtual void AddLinkForce(const Vector3d& force, const Vector3d& offset = Vector3d::Zero);  // link frame
  virtual void AddTorque(const Vector3d& torque);
  virtual void AddRelativeTorque(const Vector3d& torque);

  ignition::math::Pose3d WorldCoGPose() const;
  Vector3d WorldLinearVel() const override;  // of the origin
  virtual Vector3d WorldLinearVel(const Vector3d& offset) const;
  virtual Vector3d WorldLinearVel(const Vector3d& offset, const ignition::math::Quaterniond& q) const;
  virtual Vector3d WorldCoGLinearVel() const;
  Vector3d WorldAngularVel() const override;
  Vector3d WorldLinearAccel() const override;  // from one step to the next; known from the second question on
  Vector3d WorldAngularAccel() const override;
  Vector3d WorldAngularMomentum() const;
  virtual Vector3d WorldForce() const;  // added for the next step, else that of the last one
  virtual Vector3d WorldTorque() const;
  Vector3d RelativeForce() const { return local(WorldForce()); }
  Vector3d RelativeTorque() const { return local(WorldTorque()); }

  ModelPtr GetModel() const;
  InertialPtr GetInertial() const { return inertial; }
  void SetInertial(const InertialPtr& inertial) { *this->inertial = *inertial, UpdateMass(); }
  virtual void UpdateMass();
  virtual void UpdateSurface() {}
  ignition::math::Pose3d WorldInertialPose() const;
  ignition::math::Matrix3d WorldInertiaMatrix() const;
  CollisionPtr GetCollisionById(unsigned int id) const;
  CollisionPtr GetCollision(const std::string& name);
  CollisionPtr GetCollision(unsigned int index) const;
  Collision_V GetCollisions() const { return collisions_; }
  ignition::math::AxisAlignedBox BoundingBox() const override;
  unsigned int GetSensorCount() const { return static_cast<unsigned int>(sensors_.size()); }
  std::string GetSensorName(unsigned int index) const { return index < sensors_.size() ? sensors_[index] : ""; }
  event::ConnectionPtr ConnectEnabled(std::function<void(bool)> subscriber) { return enabled_.Connect(subscriber); }
  Link_V GetChildJointsLinks() const;
  Link_V GetParentJointsLinks() const;
  Joint_V GetParentJoints() const;
  Joint_V GetChildJoints() const;
  void SetPublishData(bool) {}
  double GetWorldEnergyPotential() const;
  double GetWorldEnergyKinetic() const;
  double GetWorldEnergy() const { return GetWorldEnergyPotential() + GetWorldEnergyKinetic(); }
  void MoveFrame(const ignition::math::Pose3d& from, const ignition::math::Pose3d& to, bool preserve_velocity = false);
  Vector3d WorldWindLinearVel() const;  // once in each step; none where the wind does not count
  Vector3d RelativeWindLinearVel() const { return local(WorldWindLinearVel()); }
  common::BatteryPtr Battery(const std::string& name) const;
  common::BatteryPtr Battery(std::size_t index) const;
  std::size_t BatteryCount() const { return batteries_.size(); }
  virtual void FillMsg(msgs::Link& message);
  std::shared_ptr<ode_sim::Link> Core() const { return core_; }

protected:
  void place(const ignition::math::Pose3d& X_WL) override;
  InertialPtr inertial;

private:
  friend class Mirror;
  void add(const Vector3d& force, const Vector3d& torque);  // about the centre of mass
  Vector3d com() const;
  std::shared_ptr<ode_sim::Link> core_;
  Collision_V collisions_;
  std::vector<std::string> sensors_;
  std::vector<common::BatteryPtr> batteries_;
  event::EventT<void(bool)> enabled_;
  mutable bool watched_ = false;
  bool windy_ = false;
  mutable Vector3d wind_;
  mutable uint64_t wind_of_step_ = ~0ULL;
  mutable Vector3d v_, w_, a_, alpha_;  // of the last step
};

}  // namespace physics
}  // namespace gazebo
