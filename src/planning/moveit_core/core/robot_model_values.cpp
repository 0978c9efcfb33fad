// Values of all of a robot's variables.
#include <moveit/robot_model/robot_model.h>

#include <algorithm>

#include "motion/robot_model.hpp"

namespace moveit
{
namespace core
{
namespace
{
void followMimics(const motion::RobotModel& core, double* values)
{
  for (const motion::JointModel& joint : core.joints)
    if (joint.mimic >= 0)
      values[joint.first_variable] = joint.mimic_factor * values[core.joints[joint.mimic].first_variable] + joint.mimic_offset;
}
}  // namespace

void RobotModel::getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values) const
{
  for (const JointModel* joint : active_joint_model_vector_)
    joint->getVariableRandomPositions(rng, values + joint->getFirstVariableIndex());
  followMimics(*core_, values);
}

void RobotModel::getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values) const
{
  values.resize(getVariableCount());
  getVariableRandomPositions(rng, values.data());
}

void RobotModel::getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng,
                                            std::map<std::string, double>& values) const
{
  std::vector<double> all;
  getVariableRandomPositions(rng, all);
  values.clear();
  for (std::size_t i = 0; i < all.size(); ++i)
    values[variable_names_[i]] = all[i];
}

void RobotModel::getVariableDefaultPositions(double* values) const
{
  std::copy(core_->defaults.begin(), core_->defaults.end(), values);
}

void RobotModel::getVariableDefaultPositions(std::vector<double>& values) const { values = core_->defaults; }

void RobotModel::getVariableDefaultPositions(std::map<std::string, double>& values) const
{
  values.clear();
  for (std::size_t i = 0; i < variable_names_.size(); ++i)
    values[variable_names_[i]] = core_->defaults[i];
}

bool RobotModel::enforcePositionBounds(double* state, const JointBoundsVector& active_joint_bounds) const
{
  bool changed = false;
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
  {
    const JointModel* joint = active_joint_model_vector_[i];
    if (joint->enforcePositionBounds(state + joint->getFirstVariableIndex(), *active_joint_bounds[i]))
      changed = true;
  }
  if (changed)
    followMimics(*core_, state);
  return changed;
}

bool RobotModel::satisfiesPositionBounds(const double* state, const JointBoundsVector& active_joint_bounds, double margin) const
{
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
  {
    const JointModel* joint = active_joint_model_vector_[i];
    if (!joint->satisfiesPositionBounds(state + joint->getFirstVariableIndex(), *active_joint_bounds[i], margin))
      return false;
  }
  return true;
}

double RobotModel::getMaximumExtent(const JointBoundsVector& active_joint_bounds) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
    sum += active_joint_model_vector_[i]->getDistanceFactor() *
           active_joint_model_vector_[i]->getMaximumExtent(*active_joint_bounds[i]);
  return sum;
}

double RobotModel::distance(const double* state1, const double* state2) const
{
  double sum = 0.0;
  for (const JointModel* joint : active_joint_model_vector_)
    sum += joint->getDistanceFactor() *
           joint->distance(state1 + joint->getFirstVariableIndex(), state2 + joint->getFirstVariableIndex());
  return sum;
}

void RobotModel::interpolate(const double* from, const double* to, double t, double* state) const
{
  for (const JointModel* joint : active_joint_model_vector_)
  {
    const int first = joint->getFirstVariableIndex();
    joint->interpolate(from + first, to + first, t, state + first);
  }
  followMimics(*core_, state);
}

void RobotModel::printModelInfo(std::ostream& out) const
{
  out << "Model " << model_name_ << " in frame " << model_frame_ << ", using " << getVariableCount() << " variables\n";
  out << "Joints: \n";
  for (const JointModel* joint : joint_model_vector_)
  {
    out << " '" << joint->getName() << "' (" << joint->getTypeName() << ")\n";
    out << "  * Joint Index: " << joint->getJointIndex() << '\n';
    for (std::size_t k = 0; k < joint->getVariableCount(); ++k)
      out << "  * '" << joint->getVariableNames()[k] << "', index " << joint->getFirstVariableIndex() + k
          << " in full state\n        " << joint->getVariableBounds()[k] << '\n';
    if (joint->getMimic())
      out << "  * mimic '" << joint->getMimic()->getName() << "'\n";
  }
  out << "Links: \n";
  for (const LinkModel* link : link_model_vector_)
    out << " '" << link->getName() << "' with " << core_->links[link->getLinkIndex()].shapes.size() << " geoms"
        << (link->parentJointIsFixed() ? ", parent joint is fixed" : "") << '\n';
  out << "Available groups: \n";
  for (const JointModelGroup* group : joint_model_groups_)
    group->printGroupInfo(out);
}
}  // namespace core
}  // namespace moveit
