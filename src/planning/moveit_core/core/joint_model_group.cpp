#include <moveit/robot_model/joint_model_group.h>

#include <algorithm>

#include <moveit/exceptions/exceptions.h>
#include <moveit/robot_model/revolute_joint_model.h>
#include <moveit/robot_model/robot_model.h>

#include "log_names.hpp"
#include "motion/robot_model.hpp"

namespace moveit
{
namespace core
{
namespace
{
void addCoreJoint(const motion::RobotModel& robot, int index, motion::JointModelGroup& group)
{
  const motion::JointModel& joint = robot.joints[index];
  const bool follows = !group.joints.empty() && joint.parent_link == robot.joints[group.joints.back()].child_link;
  group.is_chain = group.joints.empty() || (group.is_chain && follows);
  const auto moves_it = [&](int other) {
    const std::vector<int>& moved = robot.joints[other].descendant_links;
    return std::find(moved.begin(), moved.end(), joint.child_link) != moved.end();
  };
  if (std::none_of(group.joints.begin(), group.joints.end(), moves_it))
    group.joint_roots.push_back(index);
  group.joints.push_back(index);
  group.links.push_back(joint.child_link);
  if (!joint.active())
    return;
  group.active_joints.push_back(index);
  group.single_variable_joints = group.single_variable_joints && joint.singleVariable();
  for (int k = 0; k < joint.variable_count; ++k)
  {
    group.variables.push_back(joint.first_variable + k);
    group.variable_names.push_back(joint.variables[k]);
  }
}

std::shared_ptr<const motion::JointModelGroup> makeCore(const std::string& name, const std::vector<const JointModel*>& joints,
                                                        const motion::RobotModel& robot)
{
  const auto group = std::make_shared<motion::JointModelGroup>();
  group->name = name;
  std::set<int> sorted, updated;
  for (const JointModel* joint : joints)
    sorted.insert(joint->getJointIndex());
  for (int index : sorted)
  {
    addCoreJoint(robot, index, *group);
    if (robot.joints[index].variable_count > 0)
      updated.insert(robot.joints[index].descendant_links.begin(), robot.joints[index].descendant_links.end());
  }
  group->updated_links.assign(updated.begin(), updated.end());
  group->link_updated.assign(robot.links.size(), 0);
  for (int link : updated)
    group->link_updated[link] = 1;
  if (group->joints.empty())
    return group;
  group->base_link = robot.joints[group->joints.front()].parent_link;
  if (group->is_chain)
    group->tips = { group->tip_link = robot.joints[group->joints.back()].child_link };
  return group;
}
}  // namespace

JointModelGroup::JointModelGroup(const std::string& name, const srdf::Model::Group& config,
                                 const std::vector<const JointModel*>& joint_models, const RobotModel* parent_model)
  : JointModelGroup(makeCore(name, joint_models, *parent_model->core()), config, parent_model)
{
}

JointModelGroup::JointModelGroup(const std::shared_ptr<const motion::JointModelGroup>& core, const srdf::Model::Group& config,
                                 const RobotModel* parent_model)
  : JointModelGroup(*core, config, parent_model)
{
  own_core_ = core;
}

JointModelGroup::JointModelGroup(const motion::JointModelGroup& core, const srdf::Model::Group& config,
                                 const RobotModel* parent_model)
  : core_(&core)
  , parent_model_(parent_model)
  , name_(core.name)
  , config_(config)
  , is_chain_(core.is_chain)
  , is_single_dof_(core.single_variable_joints)
  , subgroup_names_(core.subgroups)
  , attached_end_effector_names_(core.attached_end_effectors)
  , end_effector_name_(core.end_effector)
  , default_states_names_(core.state_names)
{
  for (int joint : core.joints)
    addJoint(parent_model->getJointModel(joint));
  for (std::size_t i = 1; i < variable_index_list_.size(); ++i)
    is_contiguous_index_list_ = is_contiguous_index_list_ && variable_index_list_[i] == variable_index_list_[i - 1] + 1;
  for (int joint : core.joint_roots)
  {
    joint_roots_.push_back(parent_model->getJointModel(joint));
    common_root_ = parent_model->getCommonRoot(common_root_, joint_roots_.back());
  }
  addLinks();
  for (const auto& state : core.states)
    for (const auto& joint : state.second)
      for (std::size_t k = 0; k < joint.second.size(); ++k)
        default_states_[state.first][parent_model->core()->joint(joint.first).variables[k]] = joint.second[k];
}

JointModelGroup::~JointModelGroup() = default;

void JointModelGroup::addJoint(const JointModel* joint)
{
  joint_model_vector_.push_back(joint);
  joint_model_name_vector_.push_back(joint->getName());
  if (joint->getVariableCount() == 0)
  {
    fixed_joints_.push_back(joint);
    return;
  }
  if (joint->getMimic())
    mimic_joints_.push_back(joint);
  else
  {
    active_joint_model_vector_.push_back(joint);
    active_joint_model_name_vector_.push_back(joint->getName());
    active_joint_model_start_index_.push_back(variable_names_.size());
    active_joint_models_bounds_.push_back(&joint->getVariableBounds());
    active_variable_count_ += joint->getVariableCount();
  }
  if (joint->getType() == JointModel::REVOLUTE && static_cast<const RevoluteJointModel*>(joint)->isContinuous())
    continuous_joint_model_vector_.push_back(joint);
  joint_variables_index_map_[joint->getName()] = variable_names_.size();
  for (std::size_t k = 0; k < joint->getVariableCount(); ++k)
  {
    joint_variables_index_map_[joint->getVariableNames()[k]] = variable_names_.size();
    variable_names_.push_back(joint->getVariableNames()[k]);
    variable_index_list_.push_back(joint->getFirstVariableIndex() + k);
  }
}

void JointModelGroup::addLinks()
{
  for (int index : core_->links)
  {
    const LinkModel* link = parent_model_->getLinkModel(index);
    link_model_vector_.push_back(link);
    link_model_name_vector_.push_back(link->getName());
    if (parent_model_->core()->links[index].hasGeometry())
      link_model_with_geometry_name_vector_.push_back(link->getName());
  }
  for (int index : core_->updated_links)
  {
    const LinkModel* link = parent_model_->getLinkModel(index);
    updated_link_model_vector_.push_back(link);
    updated_link_model_set_.insert(link);
    updated_link_model_name_vector_.push_back(link->getName());
    if (!parent_model_->core()->links[index].hasGeometry())
      continue;
    updated_link_model_with_geometry_vector_.push_back(link);
    updated_link_model_with_geometry_set_.insert(link);
    updated_link_model_with_geometry_name_vector_.push_back(link->getName());
    updated_link_model_with_geometry_name_set_.insert(link->getName());
  }
}

namespace
{
bool contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}
}  // namespace

bool JointModelGroup::hasJointModel(const std::string& joint) const { return contains(joint_model_name_vector_, joint); }

bool JointModelGroup::hasLinkModel(const std::string& link) const { return contains(link_model_name_vector_, link); }

bool JointModelGroup::isLinkUpdated(const std::string& name) const { return contains(updated_link_model_name_vector_, name); }

bool JointModelGroup::isSubgroup(const std::string& group) const { return contains(subgroup_names_, group); }

const JointModel* JointModelGroup::getJointModel(const std::string& joint) const
{
  if (hasJointModel(joint))
    return parent_model_->getJointModel(joint);
  ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "Joint '%s' not found in group '%s'", joint.c_str(), name_.c_str());
  return nullptr;
}

const LinkModel* JointModelGroup::getLinkModel(const std::string& link) const
{
  if (hasLinkModel(link))
    return parent_model_->getLinkModel(link);
  ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "Link '%s' not found in group '%s'", link.c_str(), name_.c_str());
  return nullptr;
}

int JointModelGroup::getVariableGroupIndex(const std::string& variable) const
{
  const auto found = joint_variables_index_map_.find(variable);
  if (found != joint_variables_index_map_.end())
    return found->second;
  ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "Variable '%s' is not part of group '%s'", variable.c_str(), name_.c_str());
  return -1;
}

void JointModelGroup::getSubgroups(std::vector<const JointModelGroup*>& sub_groups) const
{
  sub_groups.clear();
  for (const std::string& name : subgroup_names_)
    sub_groups.push_back(parent_model_->getJointModelGroup(name));
}

// ---------------------------------------------------------------- end effectors, inverse kinematics

bool JointModelGroup::getEndEffectorTips(std::vector<std::string>& tips) const
{
  std::vector<const LinkModel*> links;
  if (!getEndEffectorTips(links))
    return false;
  tips.clear();
  for (const LinkModel* link : links)
    tips.push_back(link->getName());
  return true;
}

bool JointModelGroup::getEndEffectorTips(std::vector<const LinkModel*>& tips) const
{
  tips.clear();
  for (const std::string& name : attached_end_effector_names_)
  {
    const JointModelGroup* effector = parent_model_->getEndEffector(name);
    if (!effector)
    {
      ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "Unable to find joint model group for eef");
      return false;
    }
    const LinkModel* link = parent_model_->getLinkModel(effector->getEndEffectorParentGroup().second);
    if (!link)
    {
      ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "Unable to find end effector link for eef");
      return false;
    }
    if (std::find(tips.begin(), tips.end(), link) == tips.end())
      tips.push_back(link);
  }
  return true;
}

const LinkModel* JointModelGroup::getOnlyOneEndEffectorTip() const
{
  std::vector<const LinkModel*> tips;
  getEndEffectorTips(tips);
  if (tips.size() == 1)
    return tips.front();
  if (tips.size() > 1)
    ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP,
                    "More than one end effector tip found for joint model group '%s', so cannot return only one",
                    name_.c_str());
  else
    ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "No end effector tips found in joint model group '%s'", name_.c_str());
  return nullptr;
}

void JointModelGroup::setDefaultIKTimeout(double ik_timeout)
{
  group_kinematics_.first.default_ik_timeout_ = ik_timeout;
  if (group_kinematics_.first.solver_instance_)
    group_kinematics_.first.solver_instance_->setDefaultTimeout(ik_timeout);
  for (auto& sub : group_kinematics_.second)
    sub.second.default_ik_timeout_ = ik_timeout;
}

bool JointModelGroup::setRedundantJoints(const std::vector<std::string>& joints)
{
  const kinematics::KinematicsBasePtr& solver = group_kinematics_.first.solver_instance_;
  return solver && solver->setRedundantJoints(joints);
}

bool JointModelGroup::computeIKIndexBijection(const std::vector<std::string>& ik_jnames,
                                              std::vector<unsigned int>& joint_bijection) const
{
  joint_bijection.clear();
  for (const std::string& name : ik_jnames)
  {
    const auto found = joint_variables_index_map_.find(name);
    if (found == joint_variables_index_map_.end())
    {
      // Solvers name fixed joints too.
      if (hasJointModel(name) && getJointModel(name)->getType() == JointModel::FIXED)
        continue;
      ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP,
                      "IK solver computes joint values for joint '%s' but group '%s' does not contain such a joint.",
                      name.c_str(), name_.c_str());
      return false;
    }
    const JointModel* joint = getJointModel(name);
    for (std::size_t k = 0; k < joint->getVariableCount(); ++k)
      joint_bijection.push_back(found->second + k);
  }
  return true;
}

void JointModelGroup::setSolverAllocators(const std::pair<SolverAllocatorFn, SolverAllocatorMapFn>& solvers)
{
  if (solvers.first)
  {
    KinematicsSolver& own = group_kinematics_.first;
    own.allocator_ = solvers.first;
    own.solver_instance_ = solvers.first(this);
    if (own.solver_instance_)
    {
      own.solver_instance_->setDefaultTimeout(own.default_ik_timeout_);
      if (!computeIKIndexBijection(own.solver_instance_->getJointNames(), own.bijection_))
        own.reset();
    }
    return;
  }
  // Without a solver of its own: those of the subgroups, which have to make up the whole group.
  for (const auto& sub : solvers.second)
  {
    if (!sub.first->getSolverInstance())
      return;
    KinematicsSolver& solver = group_kinematics_.second[sub.first];
    solver.allocator_ = sub.second;
    solver.solver_instance_ = const_cast<JointModelGroup*>(sub.first)->getSolverInstance();
    solver.default_ik_timeout_ = group_kinematics_.first.default_ik_timeout_;
    if (!computeIKIndexBijection(solver.solver_instance_->getJointNames(), solver.bijection_))
    {
      group_kinematics_.second.clear();
      return;
    }
  }
}

bool JointModelGroup::canSetStateFromIK(const std::string& tip) const
{
  const kinematics::KinematicsBaseConstPtr& solver = group_kinematics_.first.solver_instance_;
  if (!solver || tip.empty())
    return false;
  const std::vector<std::string>& tips = solver->getTipFrames();
  const std::string wanted = tip[0] == '/' ? tip.substr(1) : tip;
  for (const std::string& name : tips)
  {
    const std::string own = !name.empty() && name[0] == '/' ? name.substr(1) : name;
    if (own == wanted)
      return true;
    if (!parent_model_->hasLinkModel(own))
      continue;
    for (const auto& fixed : parent_model_->getLinkModel(own)->getAssociatedFixedTransforms())
      if (fixed.first->getName() == wanted)
        return true;
  }
  return false;
}

void JointModelGroup::printGroupInfo(std::ostream& out) const
{
  out << "Group '" << name_ << "' using " << getVariableCount() << " variables\n";
  out << "  * Joints:\n";
  for (const JointModel* joint : joint_model_vector_)
    out << "    '" << joint->getName() << "' (" << joint->getTypeName() << ")\n";
  out << "  * Variables:\n";
  for (std::size_t i = 0; i < variable_names_.size(); ++i)
  {
    const JointModel* joint = parent_model_->getJointOfVariable(variable_names_[i]);
    out << "    '" << variable_names_[i] << "', index " << variable_index_list_[i] << " in full state, index " << i
        << " in group state";
    if (joint->getMimic())
      out << ", mimic '" << joint->getMimic()->getName() << "'";
    out << "\n        " << parent_model_->getVariableBounds(variable_names_[i]) << '\n';
  }
  out << "  * Variables Index List:\n    ";
  for (int index : variable_index_list_)
    out << index << ' ';
  out << (is_contiguous_index_list_ ? "(contiguous)" : "(non-contiguous)") << '\n';
  if (group_kinematics_.first)
    out << "  * Kinematics solver bijection:\n    ";
  for (unsigned int index : group_kinematics_.first.bijection_)
    out << index << ' ';
  for (const auto& sub : group_kinematics_.second)
    out << "\n  * Compound kinematics solver: '" << sub.first->getName() << "'";
  out << std::endl;
}
}  // namespace core
}  // namespace moveit
