#pragma once
#include <map>
#include <string>

#include <gazebo/common/PID.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/common/common.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace physics
{

/// PID controllers of a model's joints by their scoped names; the simulator updates it before each step.
class GAZEBO_VISIBLE JointController
{
public:
  explicit JointController(ModelPtr model);
  virtual ~JointController() = default;
  void AddJoint(JointPtr joint);
  void RemoveJoint(Joint* joint);
  void Update();
  void Reset();
  void SetJointPosition(const std::string& name, double position, int index = 0);
  void SetJointPosition(JointPtr joint, double position, int index = 0);
  void SetJointPositions(const std::map<std::string, double>& positions);
  common::Time GetLastUpdateTime() const { return last_; }
  std::map<std::string, JointPtr> GetJoints() const { return joints_; }
  void SetPositionPID(const std::string& name, const common::PID& pid);
  bool SetPositionTarget(const std::string& name, double target);
  void SetVelocityPID(const std::string& name, const common::PID& pid);
  bool SetVelocityTarget(const std::string& name, double target);
  bool SetForce(const std::string& name, double force);
  std::map<std::string, common::PID> GetPositionPIDs() const { return position_pids_; }
  std::map<std::string, common::PID> GetVelocityPIDs() const { return velocity_pids_; }
  std::map<std::string, double> GetForces() const { return forces_; }
  std::map<std::string, double> GetPositions() const { return positions_; }
  std::map<std::string, double> GetVelocities() const { return velocities_; }

private:
  Model* model_;
  common::Time last_;
  std::map<std::string, JointPtr> joints_;
  std::map<std::string, common::PID> position_pids_, velocity_pids_;
  std::map<std::string, double> forces_, positions_, velocities_;
};

}  // namespace physics
}  // namespace gazebo
