// Samplers of joints, links and unions.
#include <geometric_shapes/bodies.h>
#include <ros/param.h>

#include <algorithm>
#include <cmath>

#include <moveit/constraint_samplers/default_constraint_samplers.h>
#include <moveit/constraint_samplers/union_constraint_sampler.h>

#include "log_names.hpp"

namespace constraint_samplers
{
using kinematic_constraints::JointConstraint;
using kinematic_constraints::OrientationConstraint;
using kinematic_constraints::PositionConstraint;
using moveit::core::RobotState;
using planning_scene::PlanningSceneConstPtr;

namespace
{
constexpr double EPSILON = std::numeric_limits<double>::epsilon();
}  // namespace

ConstraintSampler::ConstraintSampler(const PlanningSceneConstPtr& scene, const std::string& group_name)
  : scene_(scene)
  , jmg_(scene->getRobotModel()->getJointModelGroup(group_name))
{
  if (!jmg_)
    ROS_ERROR_NAMED(log_names::CONSTRAINT_SAMPLERS,
                    "A JointModelGroup should have been specified for the constraint sampler: there is no '%s'",
                    group_name.c_str());
}

void ConstraintSampler::clear()
{
  is_valid_ = false;
  frame_depends_.clear();
}

random_numbers::RandomNumberGenerator createSeededRNG(const std::string& seed_param)
{
  int seed;
  if (ros::isInitialized() && ros::param::get(seed_param, seed))
    return random_numbers::RandomNumberGenerator(static_cast<boost::uint32_t>(seed));
  return random_numbers::RandomNumberGenerator();
}

// ---------------------------------------------------------------- joints

JointConstraintSampler::JointConstraintSampler(const PlanningSceneConstPtr& scene, const std::string& group_name)
  : ConstraintSampler(scene, group_name)
  , random_number_generator_(createSeededRNG("~joint_constraint_sampler_random_seed"))
{
}

const std::string& JointConstraintSampler::getName() const
{
  static const std::string name = "JointConstraintSampler";
  return name;
}

void JointConstraintSampler::clear()
{
  ConstraintSampler::clear();
  bounds_.clear();
  unbounded_.clear();
  uindex_.clear();
  values_.clear();
}

bool JointConstraintSampler::configure(const moveit_msgs::Constraints& constr)
{
  std::vector<JointConstraint> usable;
  for (const moveit_msgs::JointConstraint& message : constr.joint_constraints)
  {
    JointConstraint constraint(scene_->getRobotModel());
    if (constraint.configure(message))
      usable.push_back(constraint);
  }
  return !usable.empty() && configure(usable);
}

bool JointConstraintSampler::configure(const std::vector<JointConstraint>& jc)
{
  clear();
  if (!jmg_)
    return false;
  std::map<std::string, JointInfo> infos;
  for (const JointConstraint& constraint : jc)
  {
    if (!constraint.enabled() || !jmg_->hasJointModel(constraint.getJointModel()->getName()))
      continue;
    const std::string& variable = constraint.getJointVariableName();
    const moveit::core::VariableBounds& limits = constraint.getJointModel()->getVariableBounds(variable);
    const double low = constraint.getDesiredJointPosition() - constraint.getJointToleranceBelow();
    const double high = constraint.getDesiredJointPosition() + constraint.getJointToleranceAbove();
    JointInfo& info = infos[variable];
    info.index_ = jmg_->getVariableGroupIndex(variable);
    info.potentiallyAdjustMinMaxBounds(limits.position_bounded_ ? std::max(limits.min_position_, low) : low,
                                       limits.position_bounded_ ? std::min(limits.max_position_, high) : high);
    if (info.min_bound_ > info.max_bound_ + EPSILON)
    {
      ROS_ERROR_NAMED(log_names::CONSTRAINT_SAMPLERS,
                      "The constraints for joint '%s' are such that there are no possible values for it: "
                      "min_bound: %g, max_bound: %g",
                      variable.c_str(), info.min_bound_, info.max_bound_);
      clear();
      return false;
    }
  }
  if (infos.empty())
  {
    ROS_WARN_NAMED(log_names::CONSTRAINT_SAMPLERS, "No valid joint constraints for group '%s'", jmg_->getName().c_str());
    return false;
  }
  for (const auto& info : infos)
    bounds_.push_back(info.second);
  for (const moveit::core::JointModel* joint : jmg_->getActiveJointModels())
  {
    const std::vector<std::string>& variables = joint->getVariableNames();
    if (std::all_of(variables.begin(), variables.end(), [&](const std::string& name) { return infos.count(name) > 0; }))
      continue;
    unbounded_.push_back(joint);
    uindex_.push_back(jmg_->getVariableGroupIndex(variables[0]));
  }
  values_.resize(jmg_->getVariableCount());
  return is_valid_ = true;
}

bool JointConstraintSampler::sample(RobotState& state, const RobotState& /*reference_state*/, unsigned int /*max_attempts*/)
{
  if (!is_valid_)
  {
    ROS_WARN_NAMED(log_names::CONSTRAINT_SAMPLERS, "JointConstraintSampler not configured, won't sample");
    return false;
  }
  state.copyJointGroupPositions(jmg_, values_);
  for (std::size_t i = 0; i < unbounded_.size(); ++i)
    unbounded_[i]->getVariableRandomPositions(random_number_generator_, &values_[uindex_[i]]);
  for (const JointInfo& bound : bounds_)
    values_[bound.index_] =
        random_number_generator_.uniformReal(bound.min_bound_, std::max(bound.min_bound_, bound.max_bound_));
  state.setJointGroupPositions(jmg_, values_);
  return true;
}

// ---------------------------------------------------------------- links

IKSamplingPose::IKSamplingPose(const PositionConstraint& pc) : position_constraint_(std::make_shared<PositionConstraint>(pc)) {}

IKSamplingPose::IKSamplingPose(const OrientationConstraint& oc)
  : orientation_constraint_(std::make_shared<OrientationConstraint>(oc))
{
}

IKSamplingPose::IKSamplingPose(const PositionConstraint& pc, const OrientationConstraint& oc)
  : position_constraint_(std::make_shared<PositionConstraint>(pc))
  , orientation_constraint_(std::make_shared<OrientationConstraint>(oc))
{
}

IKConstraintSampler::IKConstraintSampler(const PlanningSceneConstPtr& scene, const std::string& group_name)
  : ConstraintSampler(scene, group_name)
  , random_number_generator_(createSeededRNG("~ik_constraint_sampler_random_seed"))
{
}

const std::string& IKConstraintSampler::getName() const
{
  static const std::string name = "IKConstraintSampler";
  return name;
}

void IKConstraintSampler::clear()
{
  ConstraintSampler::clear();
  sampling_pose_ = IKSamplingPose();
}

bool IKConstraintSampler::configure(const IKSamplingPose& sp)
{
  const IKSamplingPose wanted = sp;
  clear();
  const bool place = wanted.position_constraint_ && wanted.position_constraint_->enabled();
  const bool turn = wanted.orientation_constraint_ && wanted.orientation_constraint_->enabled();
  if (!jmg_ || (!place && !turn))
    return false;
  if (place && turn && wanted.position_constraint_->getLinkModel() != wanted.orientation_constraint_->getLinkModel())
  {
    ROS_ERROR_NAMED(log_names::CONSTRAINT_SAMPLERS,
                    "Position and orientation constraints need to be specified for the same link "
                    "in order to use IK-based sampling");
    return false;
  }
  if (place)
    sampling_pose_.position_constraint_ = wanted.position_constraint_;
  if (turn)
    sampling_pose_.orientation_constraint_ = wanted.orientation_constraint_;
  if (!jmg_->getSolverInstance())
  {
    ROS_WARN_NAMED(log_names::CONSTRAINT_SAMPLERS, "No solver instance in setup: group '%s' has no kinematics solver",
                   jmg_->getName().c_str());
    return false;
  }
  if (!jmg_->canSetStateFromIK(getLinkName()))
  {
    ROS_ERROR_NAMED(log_names::CONSTRAINT_SAMPLERS,
                    "IK cannot be performed for link '%s'. The solver can report IK solutions for link '%s'.",
                    getLinkName().c_str(), jmg_->getSolverInstance()->getTipFrame().c_str());
    return false;
  }
  if (place && wanted.position_constraint_->mobileReferenceFrame())
    frame_depends_.push_back(wanted.position_constraint_->getReferenceFrame());
  if (turn && wanted.orientation_constraint_->mobileReferenceFrame())
    frame_depends_.push_back(wanted.orientation_constraint_->getReferenceFrame());
  ik_timeout_ = jmg_->getDefaultIKTimeout();
  return is_valid_ = true;
}

bool IKConstraintSampler::configure(const moveit_msgs::Constraints& constr)
{
  const auto place = [this](const moveit_msgs::PositionConstraint& message) {
    const auto made = std::make_shared<PositionConstraint>(scene_->getRobotModel());
    return made->configure(message, scene_->getTransforms()) ? made : nullptr;
  };
  const auto turn = [this](const moveit_msgs::OrientationConstraint& message) {
    const auto made = std::make_shared<OrientationConstraint>(scene_->getRobotModel());
    return made->configure(message, scene_->getTransforms()) ? made : nullptr;
  };
  for (const auto& position : constr.position_constraints)
    for (const auto& orientation : constr.orientation_constraints)
      if (position.link_name == orientation.link_name)
        if (const auto one = place(position))
          if (const auto other = turn(orientation))
            return configure(IKSamplingPose(one, other));
  for (const auto& position : constr.position_constraints)
    if (const auto made = place(position))
      return configure(IKSamplingPose(made));
  for (const auto& orientation : constr.orientation_constraints)
    if (const auto made = turn(orientation))
      return configure(IKSamplingPose(made));
  return false;
}

const std::string& IKConstraintSampler::getLinkName() const
{
  return sampling_pose_.orientation_constraint_ ? sampling_pose_.orientation_constraint_->getLinkModel()->getName()
                                                : sampling_pose_.position_constraint_->getLinkModel()->getName();
}

double IKConstraintSampler::getSamplingVolume() const
{
  double volume = 1.0;
  if (sampling_pose_.position_constraint_)
  {
    double sum = 0.0;
    for (const bodies::BodyPtr& body : sampling_pose_.position_constraint_->getConstraintRegions())
      sum += body->computeVolume();
    volume *= sum;
  }
  if (const auto& turn = sampling_pose_.orientation_constraint_)
    volume *= turn->getXAxisTolerance() * turn->getYAxisTolerance() * turn->getZAxisTolerance();
  return volume;
}

bool IKConstraintSampler::samplePosition(Eigen::Vector3d& pos, const RobotState& ks, unsigned int max_attempts)
{
  const auto& regions = sampling_pose_.position_constraint_->getConstraintRegions();
  const int first = random_number_generator_.uniformInteger(0, static_cast<int>(regions.size()) - 1);
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[(i + first) % regions.size()]->samplePointInside(random_number_generator_, std::max(1u, max_attempts), pos))
    {
      if (sampling_pose_.position_constraint_->mobileReferenceFrame())
        pos = ks.getFrameTransform(sampling_pose_.position_constraint_->getReferenceFrame()) * pos;
      return true;
    }
  return false;
}

Eigen::Quaterniond IKConstraintSampler::sampleOrientation(const RobotState& ks)
{
  const OrientationConstraint& turn = *sampling_pose_.orientation_constraint_;
  Eigen::Vector3d angles(turn.getXAxisTolerance(), turn.getYAxisTolerance(), turn.getZAxisTolerance());
  for (int axis = 0; axis < 3; ++axis)
    angles[axis] = random_number_generator_.uniformReal(-1.0, 1.0) * std::max(0.0, std::min(angles[axis], M_PI) - EPSILON);
  Eigen::Matrix3d difference;
  if (turn.getParameterizationType() == moveit_msgs::OrientationConstraint::ROTATION_VECTOR)
    difference = Eigen::AngleAxisd(angles.norm(), angles.norm() > EPSILON ? angles.normalized() : Eigen::Vector3d::UnitX())
                     .toRotationMatrix();
  else
    difference =
        (Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
  Eigen::Matrix3d wanted = turn.getDesiredRotationMatrix() * difference;
  if (turn.mobileReferenceFrame())
    wanted = ks.getFrameTransform(turn.getReferenceFrame()).linear() * wanted;
  return Eigen::Quaterniond(wanted);
}

bool IKConstraintSampler::samplePose(Eigen::Vector3d& pos, Eigen::Quaterniond& quat, const RobotState& ks,
                                     unsigned int max_attempts)
{
  if (!is_valid_)
    return false;
  if (sampling_pose_.orientation_constraint_)
    quat = sampleOrientation(ks);
  else
  {
    double q[4];
    random_number_generator_.quaternion(q);
    quat = Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
  }
  if (!sampling_pose_.position_constraint_)
  {
    // Where the link is in any state.
    RobotState anywhere(ks);
    anywhere.setToRandomPositions(jmg_, random_number_generator_);
    pos = anywhere.getGlobalLinkTransform(getLinkName()).translation();
    return true;
  }
  if (!samplePosition(pos, ks, max_attempts))
    return false;
  pos -= quat * sampling_pose_.position_constraint_->getLinkOffset();
  return true;
}

bool IKConstraintSampler::satisfied(const RobotState& state) const
{
  return (!sampling_pose_.orientation_constraint_ || sampling_pose_.orientation_constraint_->decide(state).satisfied) &&
         (!sampling_pose_.position_constraint_ || sampling_pose_.position_constraint_->decide(state).satisfied);
}

bool IKConstraintSampler::sample(RobotState& state, const RobotState& reference_state, unsigned int max_attempts)
{
  if (!is_valid_)
  {
    ROS_WARN_NAMED(log_names::CONSTRAINT_SAMPLERS, "IKConstraintSampler not configured, won't sample");
    return false;
  }
  RobotState reference(reference_state);
  RobotState found(state);
  for (unsigned int attempt = 0; attempt < std::max(1u, max_attempts); ++attempt)
  {
    Eigen::Vector3d place;
    Eigen::Quaterniond turn;
    if (!samplePose(place, turn, reference, max_attempts))
      continue;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn.toRotationMatrix();
    pose.translation() = place;
    found.setToRandomPositions(jmg_, random_number_generator_);
    if (!found.setFromIK(jmg_, pose, getLinkName(), ik_timeout_, group_state_validity_callback_) || !satisfied(found))
    {
      if (verbose_)
        ROS_INFO_NAMED(log_names::CONSTRAINT_SAMPLERS, "IK failed");
      continue;
    }
    std::vector<double> values;
    found.copyJointGroupPositions(jmg_, values);
    state.setJointGroupPositions(jmg_, values);
    return true;
  }
  return false;
}

// ---------------------------------------------------------------- several

namespace
{
bool dependsOn(const ConstraintSampler& one, const ConstraintSampler& other)
{
  const std::vector<std::string>& moved = other.getJointModelGroup()->getUpdatedLinkModelNames();
  return std::any_of(one.getFrameDependency().begin(), one.getFrameDependency().end(),
                     [&](const std::string& frame) { return std::find(moved.begin(), moved.end(), frame) != moved.end(); });
}
}  // namespace

UnionConstraintSampler::UnionConstraintSampler(const PlanningSceneConstPtr& scene, const std::string& group_name,
                                               const std::vector<ConstraintSamplerPtr>& samplers)
  : ConstraintSampler(scene, group_name)
{
  // The larger group first: what a smaller one in it draws is not drawn over.
  std::vector<ConstraintSamplerPtr> left(samplers);
  std::stable_sort(left.begin(), left.end(), [](const ConstraintSamplerPtr& a, const ConstraintSamplerPtr& b) {
    return a->getJointModelGroup()->getVariableCount() > b->getJointModelGroup()->getVariableCount();
  });
  while (!left.empty())
  {
    auto next = std::find_if(left.begin(), left.end(), [&](const ConstraintSamplerPtr& one) {
      return std::none_of(left.begin(), left.end(),
                          [&](const ConstraintSamplerPtr& other) { return one != other && dependsOn(*one, *other); });
    });
    if (next == left.end())
    {
      ROS_WARN_NAMED(log_names::CONSTRAINT_SAMPLERS, "Samplers of group '%s' depend on each other's frames",
                     group_name.c_str());
      next = left.begin();
    }
    frame_depends_.insert(frame_depends_.end(), (*next)->getFrameDependency().begin(), (*next)->getFrameDependency().end());
    samplers_.push_back(*next);
    left.erase(next);
  }
  is_valid_ = jmg_ && !samplers_.empty();
}

const std::string& UnionConstraintSampler::getName() const
{
  static const std::string name = "UnionConstraintSampler";
  return name;
}

bool UnionConstraintSampler::sample(RobotState& state, const RobotState& reference_state, unsigned int max_attempts)
{
  if (!is_valid_)
    return false;
  RobotState reference(reference_state);
  state.setToRandomPositions(jmg_);
  for (const ConstraintSamplerPtr& sampler : samplers_)
  {
    if (group_state_validity_callback_)
      sampler->setGroupStateValidityCallback(group_state_validity_callback_);
    if (!sampler->sample(state, reference, max_attempts))
      return false;
    reference = state;  // the frames that the next ones depend on
  }
  return true;
}
}  // namespace constraint_samplers
