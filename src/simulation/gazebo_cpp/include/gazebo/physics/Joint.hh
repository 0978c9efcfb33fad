#pragma once
#include <map>
#include <memory>
#include <string>

#include <boost/any.hpp>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/common/Event.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/physics/Base.hh>
#include <gazebo/physics/JointWrench.hh>

#define MAX_JOINT_AXIS 2

namespace gazebo
{
namespace physics
{

/// Axes are counted from 0; positions in rad or m, forces in N m or N. An index beyond DOF() answers NaN and does nothing.
class GAZEBO_VISIBLE Joint : public Base
{
  using Vector3d = ignition::math::Vector3d;
  using Pose3d = ignition::math::Pose3d;

public:
  enum Attribute
  {
    FUDGE_FACTOR,
    SUSPENSION_ERP,
    SUSPENSION_CFM,
    STOP_ERP,
    STOP_CFM,
    ERP,
    CFM,
    FMAX,
    VEL,
    HI_STOP,
    LO_STOP
  };

  explicit Joint(BasePtr parent) : Base(parent) { AddType(JOINT); }
  ~Joint() override;

  // Joints that plugins make hold two links of any models from Init() on, or one and the world; `pose`: in the child.
  void Load(LinkPtr parent, LinkPtr child, const Pose3d& pose);
  void Load(sdf::ElementPtr sdf) override;
  void Init() override;
  void Fini() override { Detach(); }
  virtual void Attach(LinkPtr parent, LinkPtr child);
  virtual void Detach();
  void SetModel(ModelPtr model);

  virtual LinkPtr GetJointLink(unsigned int index) const { return index == 0 ? child_ : parent_; }
  virtual bool AreConnected(LinkPtr one, LinkPtr two) const;
  LinkPtr GetChild() const { return child_; }
  LinkPtr GetParent() const { return parent_; }
  using Base::GetChild;
  void Reset() override;

  virtual unsigned int DOF() const;
  double Position(unsigned int index = 0) const;
  virtual double GetVelocity(unsigned int index) const;
  virtual bool SetPosition(unsigned int index, double position, bool preserve_velocity = false);
  virtual void SetVelocity(unsigned int index, double velocity);
  virtual void SetForce(unsigned int index, double effort);
  double CheckAndTruncateForce(unsigned int index, double effort);
  virtual double GetForce(unsigned int index);
  virtual JointWrench GetForceTorque(unsigned int index);  // known from the step after the first question on
  virtual Vector3d LinkForce(unsigned int index) const;
  virtual Vector3d LinkTorque(unsigned int index) const;
  virtual bool SetParam(const std::string& key, unsigned int index, const boost::any& value);
  virtual double GetParam(const std::string& key, unsigned int index);

  virtual void SetDamping(unsigned int index, double damping);
  double GetDamping(unsigned int index);
  virtual void SetStiffness(unsigned int index, double stiffness);
  double GetStiffness(unsigned int index);
  virtual void SetStiffnessDamping(unsigned int index, double stiffness, double damping, double reference = 0);
  double GetSpringReferencePosition(unsigned int index) const;
  virtual void ApplyStiffnessDamping() {}
  virtual double GetEffortLimit(unsigned int index);
  virtual void SetEffortLimit(unsigned int index, double effort);
  virtual double GetVelocityLimit(unsigned int index);
  virtual void SetVelocityLimit(unsigned int index, double velocity);
  virtual double LowerLimit(unsigned int index = 0) const;
  virtual double UpperLimit(unsigned int index = 0) const;
  virtual void SetLowerLimit(unsigned int index, double limit);
  virtual void SetUpperLimit(unsigned int index, double limit);
  virtual void SetProvideFeedback(bool enable);
  virtual void CacheForceTorque() {}
  // Numbers of <limit> that ODE's stops do not use; they are kept.
  void SetStopStiffness(unsigned int index, double stiffness) { params_["stop_stiffness" + std::to_string(index)] = stiffness; }
  void SetStopDissipation(unsigned int index, double dissipation)
  {
    params_["stop_dissipation" + std::to_string(index)] = dissipation;
  }
  double GetStopStiffness(unsigned int index) const { return stop("stiffness", index, 1e8); }
  double GetStopDissipation(unsigned int index) const { return stop("dissipation", index, 1); }

  virtual void SetAxis(unsigned int index, const Vector3d& axis);  // joint frame, or the model's where its description says so
  Vector3d LocalAxis(unsigned int index) const;                    // joint frame
  virtual Vector3d GlobalAxis(unsigned int index) const;
  virtual void SetAnchor(unsigned int, const Vector3d& anchor);  // world; of a joint that a plugin made
  virtual Vector3d Anchor(unsigned int index) const;
  Pose3d InitialAnchorPose() const;
  Pose3d WorldPose() const;
  Pose3d ParentWorldPose() const;
  Pose3d AnchorErrorPose() const { return WorldPose() - ParentWorldPose(); }
  double GetInertiaRatio(unsigned int index) const;                       // of the child about the axis to that of the parent
  double InertiaRatio(const Vector3d& axis) const;                        // world axes
  ignition::math::Quaterniond AxisFrame(unsigned int index) const;        // of the axis' frame in the world
  ignition::math::Quaterniond AxisFrameOffset(unsigned int index) const;  // in the joint's frame
  double GetWorldEnergyPotentialSpring(unsigned int index) const;         // J
  virtual void FillMsg(msgs::Joint& message);
  template <typename T>
  event::ConnectionPtr ConnectJointUpdate(T subscriber)
  {
    return event::Events::ConnectWorldUpdateBegin([subscriber](const common::UpdateInfo&) { subscriber(); });
  }
  std::shared_ptr<ode_sim::Joint> Core() const { return core_; }

private:
  friend class Mirror;
  bool firm() const;
  void setLimit(unsigned int index, double limit, bool upper);
  ode_sim::Feedback feedback() const;
  void hold();
  void letGo();
  ode_sim::Joint& wanted() const;
  ode_sim::Axis* settings(unsigned int index) const;
  void changed() const;
  double stop(const std::string& what, unsigned int index, double otherwise) const;
  bool inModelAxes(unsigned int index) const;
  std::shared_ptr<ode_sim::Joint> core_;
  LinkPtr parent_, child_;
  std::weak_ptr<int> alive_;
  mutable std::shared_ptr<ode_sim::Joint>
      made_;                 // what a plugin wants of a joint that it makes; null for those of descriptions
  bool wanted_now_ = false;  // since Init()
  int weld_ = 0;
  std::map<std::string, double> params_;  // that ODE would take and that have no effect here
};

}  // namespace physics
}  // namespace gazebo
