// Values of a group's variables: named and random ones, bounds, distance.
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
// ---------------------------------------------------------------- named and random values

void JointModelGroup::addDefaultState(const std::string& name, const std::map<std::string, double>& default_state)
{
  if (!default_states_.count(name))
    default_states_names_.push_back(name);
  default_states_[name] = default_state;
}

bool JointModelGroup::getVariableDefaultPositions(const std::string& name, std::map<std::string, double>& values) const
{
  const auto found = default_states_.find(name);
  if (found == default_states_.end())
    return false;
  values = found->second;
  return true;
}

void JointModelGroup::getVariableDefaultPositions(double* values) const
{
  for (std::size_t i = 0; i < variable_index_list_.size(); ++i)
    values[i] = parent_model_->core()->defaults[variable_index_list_[i]];
}

void JointModelGroup::getVariableDefaultPositions(std::vector<double>& values) const
{
  values.resize(getVariableCount());
  getVariableDefaultPositions(values.data());
}

void JointModelGroup::getVariableDefaultPositions(std::map<std::string, double>& values) const
{
  std::vector<double> all;
  getVariableDefaultPositions(all);
  for (std::size_t i = 0; i < all.size(); ++i)
    values[variable_names_[i]] = all[i];
}

void JointModelGroup::getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values) const
{
  values.resize(getVariableCount());
  getVariableRandomPositions(rng, values.data());
}

void JointModelGroup::getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values,
                                                 const JointBoundsVector& active_joint_bounds) const
{
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
    active_joint_model_vector_[i]->getVariableRandomPositions(rng, values + active_joint_model_start_index_[i],
                                                              *active_joint_bounds[i]);
  updateMimicJoints(values);
}

void JointModelGroup::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                                       const JointBoundsVector& active_joint_bounds, const double* seed,
                                                       const std::vector<double>& distances) const
{
  if (distances.size() != active_joint_model_vector_.size())
    throw Exception("When sampling random values nearby for group '" + name_ + "', distances vector should be of size " +
                    std::to_string(active_joint_model_vector_.size()) + ", but it is of size " +
                    std::to_string(distances.size()));
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
  {
    const int start = active_joint_model_start_index_[i];
    active_joint_model_vector_[i]->getVariableRandomPositionsNearBy(rng, values + start, *active_joint_bounds[i], seed + start,
                                                                    distances[i]);
  }
  updateMimicJoints(values);
}

void JointModelGroup::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                                       const JointBoundsVector& active_joint_bounds, const double* seed,
                                                       const double distance) const
{
  getVariableRandomPositionsNearBy(rng, values, active_joint_bounds, seed,
                                   std::vector<double>(active_joint_model_vector_.size(), distance));
}

void JointModelGroup::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                                       const JointBoundsVector& active_joint_bounds, const double* seed,
                                                       const std::map<JointModel::JointType, double>& distance_map) const
{
  std::vector<double> distances;
  for (const JointModel* joint : active_joint_model_vector_)
  {
    const auto found = distance_map.find(joint->getType());
    if (found == distance_map.end())
      ROS_WARN_NAMED(log_names::JOINT_MODEL_GROUP, "Did not pass in distance for '%s'", joint->getName().c_str());
    distances.push_back(found == distance_map.end() ? 0.0 : found->second);
  }
  getVariableRandomPositionsNearBy(rng, values, active_joint_bounds, seed, distances);
}

void JointModelGroup::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values,
                                                       const std::vector<double>& seed, double distance) const
{
  values.resize(getVariableCount());
  getVariableRandomPositionsNearBy(rng, values.data(), active_joint_models_bounds_, seed.data(), distance);
}

void JointModelGroup::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values,
                                                       const std::vector<double>& seed,
                                                       const std::map<JointModel::JointType, double>& distance_map) const
{
  values.resize(getVariableCount());
  getVariableRandomPositionsNearBy(rng, values.data(), active_joint_models_bounds_, seed.data(), distance_map);
}

void JointModelGroup::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values,
                                                       const std::vector<double>& seed,
                                                       const std::vector<double>& distances) const
{
  values.resize(getVariableCount());
  getVariableRandomPositionsNearBy(rng, values.data(), active_joint_models_bounds_, seed.data(), distances);
}

void JointModelGroup::updateMimicJoints(double* values) const
{
  for (const JointModel* joint : mimic_joints_)
  {
    const auto source = joint_variables_index_map_.find(joint->getMimic()->getName());
    if (source != joint_variables_index_map_.end())
      values[joint_variables_index_map_.at(joint->getName())] =
          values[source->second] * joint->getMimicFactor() + joint->getMimicOffset();
  }
}

// ---------------------------------------------------------------- bounds, distance

bool JointModelGroup::enforcePositionBounds(double* state, const JointBoundsVector& active_joint_bounds) const
{
  bool changed = false;
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
    if (active_joint_model_vector_[i]->enforcePositionBounds(state + active_joint_model_start_index_[i],
                                                             *active_joint_bounds[i]))
      changed = true;
  if (changed)
    updateMimicJoints(state);
  return changed;
}

bool JointModelGroup::satisfiesPositionBounds(const double* state, const JointBoundsVector& active_joint_bounds,
                                              double margin) const
{
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
    if (!active_joint_model_vector_[i]->satisfiesPositionBounds(state + active_joint_model_start_index_[i],
                                                                *active_joint_bounds[i], margin))
      return false;
  return true;
}

double JointModelGroup::getMaximumExtent(const JointBoundsVector& active_joint_bounds) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
    sum += active_joint_model_vector_[i]->getDistanceFactor() *
           active_joint_model_vector_[i]->getMaximumExtent(*active_joint_bounds[i]);
  return sum;
}

double JointModelGroup::distance(const double* state1, const double* state2) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
  {
    const int start = active_joint_model_start_index_[i];
    sum += active_joint_model_vector_[i]->getDistanceFactor() *
           active_joint_model_vector_[i]->distance(state1 + start, state2 + start);
  }
  return sum;
}

void JointModelGroup::interpolate(const double* from, const double* to, double t, double* state) const
{
  for (std::size_t i = 0; i < active_joint_model_vector_.size(); ++i)
  {
    const int start = active_joint_model_start_index_[i];
    active_joint_model_vector_[i]->interpolate(from + start, to + start, t, state + start);
  }
  updateMimicJoints(state);
}

bool JointModelGroup::isValidVelocityMove(const std::vector<double>& from_joint_pose, const std::vector<double>& to_joint_pose,
                                          double dt) const
{
  if (from_joint_pose.size() != to_joint_pose.size())
  {
    ROS_ERROR_NAMED(log_names::JOINT_MODEL_GROUP, "To and from joint poses are of different sizes.");
    return false;
  }
  return isValidVelocityMove(from_joint_pose.data(), to_joint_pose.data(), from_joint_pose.size(), dt);
}

bool JointModelGroup::isValidVelocityMove(const double* from_joint_pose, const double* to_joint_pose, std::size_t array_size,
                                          double dt) const
{
  for (std::size_t i = 0; i < array_size && i < active_joint_models_bounds_.size(); ++i)
  {
    const VariableBounds& b = (*active_joint_models_bounds_[i])[0];
    const double way = to_joint_pose[i] - from_joint_pose[i];
    if (b.velocity_bounded_ && (way > dt * b.max_velocity_ || way < dt * b.min_velocity_))
      return false;
  }
  return true;
}
}  // namespace core
}  // namespace moveit
