#include <moveit/constraint_samplers/constraint_sampler_manager.h>
#include <moveit/constraint_samplers/constraint_sampler_tools.h>
#include <moveit/constraint_samplers/default_constraint_samplers.h>
#include <moveit/constraint_samplers/union_constraint_sampler.h>

#include <set>

namespace constraint_samplers
{
using moveit::core::JointModelGroup;
using planning_scene::PlanningSceneConstPtr;

namespace
{
// All joint constraints that are of the group; `all` tells whether they leave none of its variables free.
ConstraintSamplerPtr jointSampler(const PlanningSceneConstPtr& scene, const JointModelGroup& group,
                                  const moveit_msgs::Constraints& constr, bool& all)
{
  std::set<std::string> free(group.getVariableNames().begin(), group.getVariableNames().end());
  std::vector<kinematic_constraints::JointConstraint> usable;
  for (const moveit_msgs::JointConstraint& message : constr.joint_constraints)
  {
    kinematic_constraints::JointConstraint constraint(scene->getRobotModel());
    if (group.getVariableCount() == 0 || !constraint.configure(message) ||
        !group.hasJointModel(constraint.getJointModel()->getName()))
      continue;
    free.erase(constraint.getJointVariableName());
    usable.push_back(constraint);
  }
  for (const moveit::core::JointModel* mimic : group.getMimicJointModels())
    for (const std::string& name : mimic->getVariableNames())
      free.erase(name);
  all = free.empty();
  if (usable.empty())
    return nullptr;
  const auto sampler = std::make_shared<JointConstraintSampler>(scene, group.getName());
  return sampler->configure(usable) ? sampler : nullptr;
}

// Of the poses, positions and orientations of links that the group's solver moves, those with the least room.
ConstraintSamplerPtr linkSampler(const PlanningSceneConstPtr& scene, const JointModelGroup& group,
                                 const moveit_msgs::Constraints& constr)
{
  IKConstraintSamplerPtr best;
  const auto consider = [&](const moveit_msgs::Constraints& one) {
    const auto sampler = std::make_shared<IKConstraintSampler>(scene, group.getName());
    if (sampler->configure(one) && (!best || sampler->getSamplingVolume() < best->getSamplingVolume()))
      best = sampler;
  };
  std::set<std::string> posed;
  for (const auto& position : constr.position_constraints)
    for (const auto& orientation : constr.orientation_constraints)
      if (position.link_name == orientation.link_name && group.canSetStateFromIK(position.link_name))
      {
        moveit_msgs::Constraints one;
        one.position_constraints.push_back(position);
        one.orientation_constraints.push_back(orientation);
        consider(one);
        posed.insert(position.link_name);
      }
  if (best)
    return best;
  for (const auto& position : constr.position_constraints)
    if (!posed.count(position.link_name) && group.canSetStateFromIK(position.link_name))
    {
      moveit_msgs::Constraints one;
      one.position_constraints.push_back(position);
      consider(one);
    }
  for (const auto& orientation : constr.orientation_constraints)
    if (!posed.count(orientation.link_name) && group.canSetStateFromIK(orientation.link_name))
    {
      moveit_msgs::Constraints one;
      one.orientation_constraints.push_back(orientation);
      consider(one);
    }
  return best;
}

// Each solver of a subgroup takes the constraints of links that it moves.
std::vector<ConstraintSamplerPtr> subgroupSamplers(const PlanningSceneConstPtr& scene, const JointModelGroup& group,
                                                   moveit_msgs::Constraints left)
{
  std::vector<ConstraintSamplerPtr> samplers;
  for (const auto& solver : group.getGroupKinematics().second)
  {
    moveit_msgs::Constraints own, rest;
    for (const auto& position : left.position_constraints)
      (solver.first->hasLinkModel(position.link_name) ? own : rest).position_constraints.push_back(position);
    for (const auto& orientation : left.orientation_constraints)
      (solver.first->hasLinkModel(orientation.link_name) ? own : rest).orientation_constraints.push_back(orientation);
    if (own.position_constraints.empty() && own.orientation_constraints.empty())
      continue;
    left = rest;
    if (const ConstraintSamplerPtr sampler =
            ConstraintSamplerManager::selectDefaultSampler(scene, solver.first->getName(), own))
      samplers.push_back(sampler);
  }
  return samplers;
}
}  // namespace

ConstraintSamplerPtr ConstraintSamplerManager::selectSampler(const PlanningSceneConstPtr& scene, const std::string& group_name,
                                                             const moveit_msgs::Constraints& constr) const
{
  for (const ConstraintSamplerAllocatorPtr& allocator : sampler_alloc_)
    if (allocator->canService(scene, group_name, constr))
      return allocator->alloc(scene, group_name, constr);
  return selectDefaultSampler(scene, group_name, constr);
}

ConstraintSamplerPtr ConstraintSamplerManager::selectDefaultSampler(const PlanningSceneConstPtr& scene,
                                                                    const std::string& group_name,
                                                                    const moveit_msgs::Constraints& constr)
{
  const JointModelGroup* group = scene->getRobotModel()->getJointModelGroup(group_name);
  if (!group)
    return nullptr;
  bool all = false;
  const ConstraintSamplerPtr joints = jointSampler(scene, *group, constr, all);
  if (joints && all)
    return joints;
  std::vector<ConstraintSamplerPtr> samplers;
  if (joints)
    samplers.push_back(joints);
  if (group->getGroupKinematics().first)
  {
    if (const ConstraintSamplerPtr links = linkSampler(scene, *group, constr))
      samplers.push_back(links);
  }
  else
    for (const ConstraintSamplerPtr& sampler : subgroupSamplers(scene, *group, constr))
      samplers.push_back(sampler);
  if (samplers.size() < 2)
    return samplers.empty() ? nullptr : samplers[0];
  return std::make_shared<UnionConstraintSampler>(scene, group_name, samplers);
}

// ---------------------------------------------------------------- looking at them

void visualizeDistribution(const ConstraintSamplerPtr& sampler, const moveit::core::RobotState& reference_state,
                           const std::string& link_name, unsigned int sample_count, visualization_msgs::MarkerArray& markers)
{
  const moveit::core::LinkModel* link = sampler ? reference_state.getLinkModel(link_name) : nullptr;
  if (!link)
    return;
  moveit::core::RobotState state(reference_state);
  for (unsigned int i = 0; i < sample_count; ++i)
  {
    if (!sampler->sample(state, reference_state))
      continue;
    const Eigen::Vector3d place = state.getGlobalLinkTransform(link).translation();
    visualization_msgs::Marker marker;
    marker.header.stamp = ros::Time::now();
    marker.header.frame_id = sampler->getPlanningScene()->getPlanningFrame();
    marker.ns = "constraint_samples";
    marker.id = static_cast<int>(i);
    marker.type = visualization_msgs::Marker::SPHERE;
    marker.action = visualization_msgs::Marker::ADD;
    marker.pose.position.x = place.x();
    marker.pose.position.y = place.y();
    marker.pose.position.z = place.z();
    marker.pose.orientation.w = 1.0;
    marker.lifetime = ros::Duration(60.0);
    marker.scale.x = marker.scale.y = marker.scale.z = 0.035;
    marker.color.r = 1.0;
    marker.color.a = 0.8;
    markers.markers.push_back(marker);
  }
}

void visualizeDistribution(const moveit_msgs::Constraints& constr, const PlanningSceneConstPtr& scene, const std::string& group,
                           const std::string& link_name, unsigned int sample_count, visualization_msgs::MarkerArray& markers)
{
  visualizeDistribution(ConstraintSamplerManager::selectDefaultSampler(scene, group, constr), scene->getCurrentState(),
                        link_name, sample_count, markers);
}

double countSamplesPerSecond(const ConstraintSamplerPtr& sampler, const moveit::core::RobotState& reference_state)
{
  if (!sampler)
  {
    ROS_ERROR_NAMED("constraint_samplers", "No sampler specified for counting samples per second");
    return 0.0;
  }
  moveit::core::RobotState state(reference_state);
  unsigned long count = 0;
  const ros::WallTime start = ros::WallTime::now();
  while (ros::WallTime::now() - start < ros::WallDuration(1.0))
    if (sampler->sample(state, reference_state, 1))
      ++count;
  return count / (ros::WallTime::now() - start).toSec();
}

double countSamplesPerSecond(const moveit_msgs::Constraints& constr, const PlanningSceneConstPtr& scene,
                             const std::string& group)
{
  return countSamplesPerSecond(ConstraintSamplerManager::selectDefaultSampler(scene, group, constr), scene->getCurrentState());
}
}  // namespace constraint_samplers
