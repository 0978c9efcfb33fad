#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/physics/Entity.hh>

namespace gazebo
{
namespace physics
{

class GAZEBO_VISIBLE Model : public Entity
{
public:
  explicit Model(BasePtr parent) : Entity(parent) { AddType(MODEL); }
  ~Model() override;
  const sdf::ElementPtr GetSDF() override;
  const sdf::ElementPtr UnscaledSDF() { return GetSDF(); }
  bool IsStatic() const override;
  void Reset() override;
  void ResetPhysicsStates();
  const ignition::math::Pose3d& WorldPose() const override;
  void SetLinearVel(const ignition::math::Vector3d& velocity);   // of every link's centre of mass
  void SetAngularVel(const ignition::math::Vector3d& velocity);  // of every link
  void SetWorldTwist(const ignition::math::Vector3d& linear, const ignition::math::Vector3d& angular, bool = true) override;
  ignition::math::Vector3d WorldLinearVel() const override;
  ignition::math::Vector3d WorldAngularVel() const override;
  ignition::math::Vector3d WorldLinearAccel() const override;
  ignition::math::Vector3d WorldAngularAccel() const override;
  ignition::math::AxisAlignedBox BoundingBox() const override;
  unsigned int GetJointCount() const { return static_cast<unsigned int>(joints_.size()); }
  ModelPtr NestedModel(const std::string&) const { return ModelPtr(); }
  const Model_V& NestedModels() const { return nested_; }
  const Link_V& GetLinks() const { return links_; }
  const Joint_V& GetJoints() const { return joints_; }
  JointPtr GetJoint(const std::string& name);  // scoped or not; null if there is none
  LinkPtr GetLinkById(unsigned int id) const;
  LinkPtr GetLink(const std::string& name = "canonical") const;
  virtual bool GetSelfCollide() const;
  virtual void SetSelfCollide(bool self_collide);
  void SetGravityMode(const bool& on);
  void SetCollideMode(const std::string& mode);
  void SetLaserRetro(float) {}
  void SetJointPosition(const std::string& joint, double position, int index = 0);
  void SetJointPositions(const std::map<std::string, double>& positions);
  void SetEnabled(bool enabled);
  void SetLinkWorldPose(const ignition::math::Pose3d& pose, std::string link);
  void SetLinkWorldPose(const ignition::math::Pose3d& pose,
                        const LinkPtr& link);  // the whole model moves, so that the link is there
  void SetAutoDisable(bool disable);
  bool GetAutoDisable() const;
  ignition::math::Vector3d Scale() const { return ignition::math::Vector3d::One; }
  unsigned int GetPluginCount() const;
  unsigned int GetSensorCount() const;
  std::vector<std::string> SensorScopedName(const std::string& name) const;
  JointControllerPtr GetJointController();
  double GetWorldEnergyPotential() const;
  double GetWorldEnergyKinetic() const;
  double GetWorldEnergy() const { return GetWorldEnergyPotential() + GetWorldEnergyKinetic(); }
  JointPtr CreateJoint(const std::string& name, const std::string& type, LinkPtr parent, LinkPtr child);
  JointPtr CreateJoint(sdf::ElementPtr sdf);
  bool RemoveJoint(const std::string& name);
  void SetWindMode(bool enable);  // of all its links
  bool WindMode() const;          // of its first one
  virtual void FillMsg(msgs::Model& message);
  boost::shared_ptr<Model> shared_from_this();

protected:
  void place(const ignition::math::Pose3d& X_WM) override;

private:
  friend class Mirror;
  JointPtr newJoint(const std::string& name, const std::string& type);
  std::shared_ptr<ode_sim::Model> core_;
  ignition::math::Pose3d X_LM_;  // in the frame of the first link
  Link_V links_;
  Joint_V joints_;
  Model_V nested_;
  JointControllerPtr controller_;
  std::string text_;  // SDF, parsed when somebody asks for it
};

}  // namespace physics
}  // namespace gazebo
