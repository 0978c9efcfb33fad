// Torques that a chain of joints needs, by KDL's recursive Newton-Euler.
#pragma once

#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <kdl/chain.hpp>

#include <memory>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/robot_state/robot_state.h>

namespace dynamics_solver
{
MOVEIT_CLASS_FORWARD(DynamicsSolver);

class DynamicsSolver
{
public:
  // `gravity_vector` (m/s2) is given in the axes of the link that the chain stands on. When the group is no chain of joints with
  // one value each, an error line says so and every question is answered by false.
  DynamicsSolver(const moveit::core::RobotModelConstPtr& robot_model, const std::string& group_name,
                 const geometry_msgs::Vector3& gravity_vector);

  // Torques (N m, or N) for a motion, in the group's order. One wrench for each segment of the chain, fixed ones included, acts
  // on its frame and is given in it. `torques` must have its size already.
  bool getTorques(const std::vector<double>& joint_angles, const std::vector<double>& joint_velocities,
                  const std::vector<double>& joint_accelerations, const std::vector<geometry_msgs::Wrench>& wrenches,
                  std::vector<double>& torques) const;

  // The largest mass (kg) that can be held at the tip, and the joint whose effort limit is reached first.
  bool getMaxPayload(const std::vector<double>& joint_angles, double& payload, unsigned int& joint_saturated) const;

  // Torques to hold still with a mass (kg) at the tip.
  bool getPayloadTorques(const std::vector<double>& joint_angles, double payload, std::vector<double>& joint_torques) const;

  // Effort limits of the URDF; 0 where there is none.
  const std::vector<double>& getMaxTorques() const { return max_torques_; }
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  const moveit::core::JointModelGroup* getGroup() const { return group_; }

private:
  bool fits(const std::vector<double>& values, const char* what) const;
  bool refuse(const std::string& reason);

  moveit::core::RobotModelConstPtr robot_model_;
  const moveit::core::JointModelGroup* group_ = nullptr;
  KDL::Chain chain_;
  KDL::Vector gravity_;
  std::vector<double> max_torques_;
};
}  // namespace dynamics_solver
