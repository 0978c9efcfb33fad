// States drawn at random that keep to constraints.
#pragma once

#include <string>
#include <vector>

#include <moveit/kinematic_constraints/kinematic_constraint.h>
#include <moveit/macros/class_forward.h>
#include <moveit/planning_scene/planning_scene.h>

namespace constraint_samplers
{
MOVEIT_CLASS_FORWARD(ConstraintSampler);

class ConstraintSampler
{
public:
  static const unsigned int DEFAULT_MAX_SAMPLING_ATTEMPTS = 2;

  // A group that the robot lacks leaves getJointModelGroup() null, and nothing can be configured.
  ConstraintSampler(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name);
  virtual ~ConstraintSampler() {}

  virtual bool configure(const moveit_msgs::Constraints& constr) = 0;
  const std::string& getGroupName() const { return jmg_->getName(); }
  const moveit::core::JointModelGroup* getJointModelGroup() const { return jmg_; }
  const planning_scene::PlanningSceneConstPtr& getPlanningScene() const { return scene_; }
  // Links that move and that constraints are given in.
  const std::vector<std::string>& getFrameDependency() const { return frame_depends_; }
  const moveit::core::GroupStateValidityCallbackFn& getGroupStateValidityCallback() const
  {
    return group_state_validity_callback_;
  }
  // Asked for each solution of inverse kinematics.
  void setGroupStateValidityCallback(const moveit::core::GroupStateValidityCallbackFn& callback)
  {
    group_state_validity_callback_ = callback;
  }

  // The group's joints of `state` are drawn; frames that move are where `reference_state` has them. False: none was found.
  bool sample(moveit::core::RobotState& state) { return sample(state, state, DEFAULT_MAX_SAMPLING_ATTEMPTS); }
  bool sample(moveit::core::RobotState& state, unsigned int max_attempts) { return sample(state, state, max_attempts); }
  bool sample(moveit::core::RobotState& state, const moveit::core::RobotState& reference_state)
  {
    return sample(state, reference_state, DEFAULT_MAX_SAMPLING_ATTEMPTS);
  }
  virtual bool sample(moveit::core::RobotState& state, const moveit::core::RobotState& reference_state,
                      unsigned int max_attempts) = 0;
  bool isValid() const { return is_valid_; }
  bool getVerbose() const { return verbose_; }
  virtual void setVerbose(bool verbose) { verbose_ = verbose; }
  virtual const std::string& getName() const = 0;

protected:
  virtual void clear();

  bool is_valid_ = false;
  planning_scene::PlanningSceneConstPtr scene_;
  const moveit::core::JointModelGroup* const jmg_;
  std::vector<std::string> frame_depends_;
  moveit::core::GroupStateValidityCallbackFn group_state_validity_callback_;
  bool verbose_ = false;
};
}  // namespace constraint_samplers
