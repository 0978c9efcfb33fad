// Joints within their constraints; and links, through inverse kinematics.
#pragma once

#include <random_numbers/random_numbers.h>

#include <limits>
#include <string>
#include <vector>

#include <moveit/constraint_samplers/constraint_sampler.h>

namespace constraint_samplers
{
// Seeded by the parameter when it is set.
random_numbers::RandomNumberGenerator createSeededRNG(const std::string& seed_param);

MOVEIT_CLASS_FORWARD(JointConstraintSampler);

class JointConstraintSampler : public ConstraintSampler
{
public:
  JointConstraintSampler(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name);
  // False: none is of this group, or they leave a joint no value.
  bool configure(const moveit_msgs::Constraints& constr) override;
  bool configure(const std::vector<kinematic_constraints::JointConstraint>& jc);
  using ConstraintSampler::sample;
  bool sample(moveit::core::RobotState& state, const moveit::core::RobotState& reference_state,
              unsigned int max_attempts) override;
  std::size_t getConstrainedJointCount() const { return bounds_.size(); }
  std::size_t getUnconstrainedJointCount() const { return unbounded_.size(); }
  const std::string& getName() const override;

protected:
  struct JointInfo
  {
    void potentiallyAdjustMinMaxBounds(double min, double max)
    {
      min_bound_ = std::max(min, min_bound_);
      max_bound_ = std::min(max, max_bound_);
    }
    double min_bound_ = -std::numeric_limits<double>::max(), max_bound_ = std::numeric_limits<double>::max();
    std::size_t index_ = 0;  // of the variable in the group
  };
  void clear() override;

  random_numbers::RandomNumberGenerator random_number_generator_;
  std::vector<JointInfo> bounds_;
  std::vector<const moveit::core::JointModel*> unbounded_;  // anywhere within their limits
  std::vector<unsigned int> uindex_;                        // of their first variables in the group
  std::vector<double> values_;
};

// Where a link may be: a position, an orientation, or both.
struct IKSamplingPose
{
  IKSamplingPose() {}
  IKSamplingPose(const kinematic_constraints::PositionConstraint& pc);
  IKSamplingPose(const kinematic_constraints::OrientationConstraint& oc);
  IKSamplingPose(const kinematic_constraints::PositionConstraint& pc, const kinematic_constraints::OrientationConstraint& oc);
  IKSamplingPose(const kinematic_constraints::PositionConstraintPtr& pc) : position_constraint_(pc) {}
  IKSamplingPose(const kinematic_constraints::OrientationConstraintPtr& oc) : orientation_constraint_(oc) {}
  IKSamplingPose(const kinematic_constraints::PositionConstraintPtr& pc,
                 const kinematic_constraints::OrientationConstraintPtr& oc)
    : position_constraint_(pc)
    , orientation_constraint_(oc)
  {
  }
  kinematic_constraints::PositionConstraintPtr position_constraint_;
  kinematic_constraints::OrientationConstraintPtr orientation_constraint_;
};

MOVEIT_CLASS_FORWARD(IKConstraintSampler);

class IKConstraintSampler : public ConstraintSampler
{
public:
  IKConstraintSampler(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name);
  // The first pose of a link, else the first position or orientation. False: none, or the group's solver does not move that link.
  bool configure(const moveit_msgs::Constraints& constr) override;
  bool configure(const IKSamplingPose& sp);
  double getIKTimeout() const { return ik_timeout_; }  // s
  void setIKTimeout(double timeout) { ik_timeout_ = timeout; }
  const kinematic_constraints::PositionConstraintPtr& getPositionConstraint() const
  {
    return sampling_pose_.position_constraint_;
  }
  const kinematic_constraints::OrientationConstraintPtr& getOrientationConstraint() const
  {
    return sampling_pose_.orientation_constraint_;
  }
  double getSamplingVolume() const;  // m^3 times rad^3, of what is constrained
  const std::string& getLinkName() const;
  using ConstraintSampler::sample;
  bool sample(moveit::core::RobotState& state, const moveit::core::RobotState& reference_state,
              unsigned int max_attempts) override;
  // A pose of the link, in the model frame.
  bool samplePose(Eigen::Vector3d& pos, Eigen::Quaterniond& quat, const moveit::core::RobotState& ks,
                  unsigned int max_attempts);
  const std::string& getName() const override;

protected:
  void clear() override;
  bool satisfied(const moveit::core::RobotState& state) const;
  bool samplePosition(Eigen::Vector3d& pos, const moveit::core::RobotState& ks, unsigned int max_attempts);
  Eigen::Quaterniond sampleOrientation(const moveit::core::RobotState& ks);

  random_numbers::RandomNumberGenerator random_number_generator_;
  IKSamplingPose sampling_pose_;
  double ik_timeout_ = 0.0;
};
}  // namespace constraint_samplers
