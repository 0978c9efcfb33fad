#include <moveit/robot_model/robot_model.h>

#include <algorithm>

#include <ros/package.h>

#include "log_names.hpp"
#include "motion/robot_model.hpp"

namespace moveit
{
namespace core
{
namespace
{
std::string findFile(const std::string& uri)
{
  const std::string package = "package://", file = "file://";
  if (uri.compare(0, package.size(), package) == 0)
  {
    const std::string rest = uri.substr(package.size());
    const std::size_t slash = rest.find('/');
    const std::string path = ros::package::getPath(rest.substr(0, slash));
    return path.empty() || slash == std::string::npos ? "" : path + rest.substr(slash);
  }
  return uri.compare(0, file.size(), file) == 0 ? uri.substr(file.size()) : uri;
}

std::shared_ptr<motion::RobotModel> load(const urdf::ModelInterfaceSharedPtr& urdf, const srdf::ModelConstSharedPtr& srdf)
{
  motion::RobotModel::Options options;
  options.find_file = findFile;
  try
  {
    const auto core = motion::RobotModel::load(urdf, srdf ? *srdf->core() : motion::Srdf(), options);
    const std::string mark = "error: ";
    for (const std::string& warning : core->warnings)
      if (warning.compare(0, mark.size(), mark) == 0)
        ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "%s", warning.c_str() + mark.size());
      else
        ROS_WARN_NAMED(log_names::ROBOT_MODEL, "%s", warning.c_str());
    return core;
  }
  catch (const motion::Error& error)
  {
    throw ConstructException(error.what());
  }
}
}  // namespace

RobotModel::RobotModel(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model)
  : RobotModel(load(urdf_model, srdf_model), urdf_model, srdf_model)
{
}

RobotModel::RobotModel(const std::shared_ptr<motion::RobotModel>& core, const urdf::ModelInterfaceSharedPtr& urdf_model,
                       const srdf::ModelConstSharedPtr& srdf_model)
  : core_(core)
  , urdf_(urdf_model)
  , srdf_(srdf_model ? srdf_model : std::make_shared<srdf::Model>())
{
  build();
}

RobotModel::~RobotModel() = default;

void RobotModel::build()
{
  model_name_ = core_->name;
  model_frame_ = core_->frame;
  variable_names_ = core_->variables;
  buildLinks();
  buildJoints();
  connect();
  buildGroups();
}

void RobotModel::buildLinks()
{
  for (const motion::LinkModel& core : core_->links)
  {
    links_.emplace_back(new LinkModel(core));
    LinkModel* link = links_.back().get();
    link_model_vector_.push_back(link);
    link_model_vector_const_.push_back(link);
    link_model_names_vector_.push_back(core.name);
    if (core.hasGeometry())
    {
      link->first_collision_body_transform_index_ = static_cast<int>(link_geometry_count_);
      link_geometry_count_ += core.shapes.size();
      link_models_with_collision_geometry_vector_.push_back(link);
      link_model_names_with_collision_geometry_vector_.push_back(core.name);
    }
    const auto described = urdf_ ? urdf_->getLink(core.name) : nullptr;
    if (!described || !described->visual || !described->visual->geometry ||
        described->visual->geometry->type != urdf::Geometry::MESH)
      continue;
    const auto& mesh = static_cast<const urdf::Mesh&>(*described->visual->geometry);
    const urdf::Pose& p = described->visual->origin;
    link->setVisualMesh(mesh.filename,
                        Eigen::Translation3d(p.position.x, p.position.y, p.position.z) *
                            Eigen::Quaterniond(p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z),
                        Eigen::Vector3d(mesh.scale.x, mesh.scale.y, mesh.scale.z));
  }
}

void RobotModel::buildJoints()
{
  for (const motion::JointModel& core : core_->joints)
  {
    const auto make = [&]() -> JointModel* {
      switch (core.type)
      {
        case motion::JointType::Revolute:
          return new RevoluteJointModel(*core_, core.index);
        case motion::JointType::Prismatic:
          return new PrismaticJointModel(*core_, core.index);
        case motion::JointType::Planar:
          return new PlanarJointModel(*core_, core.index);
        case motion::JointType::Floating:
          return new FloatingJointModel(*core_, core.index);
        default:
          return new FixedJointModel(*core_, core.index);
      }
    };
    joints_.emplace_back(make());
    JointModel* joint = joints_.back().get();
    joint_model_vector_.push_back(joint);
    joint_model_vector_const_.push_back(joint);
    joint_model_names_vector_.push_back(core.name);
    joints_of_variable_.insert(joints_of_variable_.end(), core.variable_count, joint);
    if (core.type == motion::JointType::Fixed)
      continue;
    (core.singleVariable() ? single_dof_joints_ : multi_dof_joints_).push_back(joint);
    if (core.continuous)
      continuous_joint_model_vector_.push_back(joint);
    if (!core.active())
    {
      mimic_joints_.push_back(joint);
      continue;
    }
    active_joint_model_vector_.push_back(joint);
    active_joint_model_vector_const_.push_back(joint);
    active_joint_model_names_vector_.push_back(core.name);
    active_joint_models_bounds_.push_back(&joint->getVariableBounds());
  }
}

// Joints and links learn of each other.
void RobotModel::connect()
{
  for (const motion::JointModel& core : core_->joints)
  {
    JointModel& joint = *joints_[core.index];
    joint.parent_link_model_ = core.parent_link < 0 ? nullptr : link_model_vector_[core.parent_link];
    joint.child_link_model_ = link_model_vector_[core.child_link];
    joint.mimic_ = core.mimic < 0 ? nullptr : joint_model_vector_[core.mimic];
    for (int follower : core.mimicked_by)
      joint.mimic_requests_.push_back(joint_model_vector_[follower]);
    for (int link : core.descendant_links)
    {
      joint.descendant_link_models_.push_back(link_model_vector_[link]);
      const JointModel* below = joint_model_vector_[core_->links[link].parent_joint];
      if (below == &joint)
        continue;
      joint.descendant_joint_models_.push_back(below);
      if (below->getType() != JointModel::FIXED)
        joint.non_fixed_descendant_joint_models_.push_back(below);
    }
  }
  std::map<int, std::vector<int>> bolted;  // by the topmost link
  std::vector<Eigen::Isometry3d> in_top(links_.size());
  for (const motion::LinkModel& core : core_->links)
  {
    LinkModel& link = *links_[core.index];
    link.parent_joint_model_ = joint_model_vector_[core.parent_joint];
    link.parent_link_model_ = core.parent_link < 0 ? nullptr : link_model_vector_[core.parent_link];
    link.is_parent_joint_fixed_ = link.parent_joint_model_->getType() == JointModel::FIXED;
    link.joint_origin_transform_ = core_->joints[core.parent_joint].origin;
    link.joint_origin_transform_is_identity_ = link.joint_origin_transform_.isApprox(Eigen::Isometry3d::Identity(), 1e-12);
    for (int joint : core.child_joints)
      link.child_joint_models_.push_back(joint_model_vector_[joint]);
    bolted[core_->rigidParent(core.index, in_top[core.index])].push_back(core.index);
  }
  for (const auto& group : bolted)
    for (int a : group.second)
      for (int b : group.second)
        if (a != b)
          links_[a]->associated_fixed_transforms_[link_model_vector_[b]] = in_top[a].inverse() * in_top[b];
}

void RobotModel::buildGroups()
{
  std::vector<const motion::JointModelGroup*> sorted;
  for (const motion::JointModelGroup& core : core_->groups)
    sorted.push_back(&core);
  std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
  for (const motion::JointModelGroup* core : sorted)
  {
    srdf::Model::Group config;
    for (const srdf::Model::Group& group : srdf_->getGroups())
      if (group.name_ == core->name)
        config = group;
    groups_.emplace_back(new JointModelGroup(*core, config, this));
    joint_model_groups_.push_back(groups_.back().get());
    joint_model_groups_const_.push_back(groups_.back().get());
    joint_model_group_names_.push_back(core->name);
  }
  for (const motion::Srdf::EndEffector& effector : core_->srdf.end_effectors)
    if (JointModelGroup* group = getJointModelGroup(effector.group))
    {
      group->end_effector_parent_ = { effector.parent_group, effector.parent_link };
      if (end_effectors_map_.emplace(effector.name, group).second)
        end_effectors_.push_back(group);
    }
}

void RobotModel::setKinematicsAllocators(const std::map<std::string, SolverAllocatorFn>& allocators)
{
  for (JointModelGroup* group : joint_model_groups_)
  {
    const auto own = allocators.find(group->getName());
    if (own != allocators.end())
      group->setSolverAllocators(own->second);
  }
  for (JointModelGroup* group : joint_model_groups_)
  {
    if (allocators.count(group->getName()))
      continue;
    // Subgroups with solvers, the largest first, none sharing a joint with another, all of the group covered.
    std::vector<const JointModelGroup*> subs;
    for (const JointModelGroup* sub : joint_model_groups_const_)
      if (sub != group && allocators.count(sub->getName()))
        subs.push_back(sub);
    std::stable_sort(subs.begin(), subs.end(),
                     [](const auto* a, const auto* b) { return a->getVariableCount() > b->getVariableCount(); });
    std::set<const JointModel*> left(group->getActiveJointModels().begin(), group->getActiveJointModels().end());
    SolverAllocatorMapFn solvers;
    for (const JointModelGroup* sub : subs)
    {
      const auto& joints = sub->getActiveJointModels();
      if (joints.empty() || !std::all_of(joints.begin(), joints.end(), [&](const JointModel* j) { return left.count(j); }))
        continue;
      for (const JointModel* joint : joints)
        left.erase(joint);
      solvers[sub] = allocators.at(sub->getName());
    }
    if (!solvers.empty() && left.empty())
      group->setSolverAllocators(SolverAllocatorFn(), solvers);
  }
}

// ---------------------------------------------------------------- look-ups

bool RobotModel::hasJointModel(const std::string& name) const { return core_->findJoint(name) != nullptr; }

const JointModel* RobotModel::getJointModel(const std::string& joint) const
{
  return const_cast<RobotModel*>(this)->getJointModel(joint);
}

const JointModel* RobotModel::getJointModel(int index) const
{
  if (index >= 0 && index < static_cast<int>(joint_model_vector_.size()))
    return joint_model_vector_[index];
  ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "Joint index '%i' out of bounds of joints in model '%s'", index, model_name_.c_str());
  return nullptr;
}

JointModel* RobotModel::getJointModel(const std::string& joint)
{
  if (const motion::JointModel* found = core_->findJoint(joint))
    return joint_model_vector_[found->index];
  ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "Joint '%s' not found in model '%s'", joint.c_str(), model_name_.c_str());
  return nullptr;
}

const JointModel* RobotModel::getCommonRoot(const JointModel* a, const JointModel* b) const
{
  if (!a || !b)
    return a ? a : b;
  const JointModel* common = a;
  while (!core_->isAncestor(common->core().child_link, b->core().child_link))
    common = common->getParentLinkModel()->getParentJointModel();
  return common;
}

bool RobotModel::hasLinkModel(const std::string& name) const { return core_->findLink(name) != nullptr; }

const LinkModel* RobotModel::getLinkModel(const std::string& link, bool* has_link) const
{
  return const_cast<RobotModel*>(this)->getLinkModel(link, has_link);
}

const LinkModel* RobotModel::getLinkModel(int index) const
{
  if (index >= 0 && index < static_cast<int>(link_model_vector_.size()))
    return link_model_vector_[index];
  ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "Link index '%i' out of bounds of links in model '%s'", index, model_name_.c_str());
  return nullptr;
}

LinkModel* RobotModel::getLinkModel(const std::string& link, bool* has_link)
{
  const motion::LinkModel* found = core_->findLink(link);
  if (has_link)
    *has_link = found != nullptr;
  if (found)
    return link_model_vector_[found->index];
  if (!has_link)
    ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "Link '%s' not found in model '%s'", link.c_str(), model_name_.c_str());
  return nullptr;
}

const LinkModel* RobotModel::getRigidlyConnectedParentLinkModel(const LinkModel* link, Eigen::Isometry3d& transform,
                                                                const JointModelGroup* jmg)
{
  transform.setIdentity();
  if (!link)
    return link;
  auto bolted = [jmg](const JointModel* joint) {
    return joint->getType() == JointModel::FIXED || (jmg && !jmg->hasJointModel(joint->getName()));
  };
  const LinkModel* parent = link->getParentLinkModel();
  while (parent && bolted(link->getParentJointModel()))
  {
    // Joints outside of the group count as if at zero, as they stand still while it moves.
    transform = link->getJointOriginTransform() * transform;
    link = parent;
    parent = link->getParentLinkModel();
  }
  return link;
}

void RobotModel::getMissingVariableNames(const std::vector<std::string>& variables,
                                         std::vector<std::string>& missing_variables) const
{
  missing_variables.clear();
  const std::set<std::string> given(variables.begin(), variables.end());
  for (const std::string& name : variable_names_)
    if (!given.count(name) && !getJointOfVariable(name)->getMimic())
      missing_variables.push_back(name);
}

int RobotModel::getVariableIndex(const std::string& variable) const
{
  int index = core_->findVariable(variable);
  if (index < 0)
    if (const motion::JointModel* joint = core_->findJoint(variable))
      index = joint->first_variable;
  if (index < 0)
    throw Exception("Variable '" + variable + "' is not known to model '" + model_name_ + "'");
  return index;
}

bool RobotModel::hasJointModelGroup(const std::string& group) const { return core_->findGroup(group) != nullptr; }

const JointModelGroup* RobotModel::getJointModelGroup(const std::string& name) const
{
  return const_cast<RobotModel*>(this)->getJointModelGroup(name);
}

JointModelGroup* RobotModel::getJointModelGroup(const std::string& name)
{
  for (JointModelGroup* group : joint_model_groups_)
    if (group->getName() == name)
      return group;
  ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "Group '%s' not found in model '%s'", name.c_str(), model_name_.c_str());
  return nullptr;
}

bool RobotModel::hasEndEffector(const std::string& eef) const { return end_effectors_map_.count(eef) > 0; }

const JointModelGroup* RobotModel::getEndEffector(const std::string& name) const
{
  return const_cast<RobotModel*>(this)->getEndEffector(name);
}

JointModelGroup* RobotModel::getEndEffector(const std::string& name)
{
  const auto found = end_effectors_map_.find(name);
  if (found != end_effectors_map_.end())
    return found->second;
  for (JointModelGroup* group : joint_model_groups_)
    if (group->getName() == name && group->isEndEffector())
      return group;
  ROS_ERROR_NAMED(log_names::ROBOT_MODEL, "End-effector '%s' not found in model '%s'", name.c_str(), model_name_.c_str());
  return nullptr;
}
}  // namespace core
}  // namespace moveit
