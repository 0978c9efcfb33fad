// States: values of variables, named and random values, distances, bounds.
#include <moveit/robot_state/robot_state.h>

#include <climits>

#include "motion/robot_state.hpp"

namespace moveit
{
namespace core
{
RobotState::RobotState(const RobotModelConstPtr& robot_model)
  : robot_model_(robot_model)
  , core_(new motion::RobotState(robot_model->core()))
{
}

RobotState::~RobotState() { clearAttachedBodies(); }

RobotState::RobotState(const RobotState& other) : robot_model_(other.robot_model_), core_(new motion::RobotState(*other.core_))
{
  copyBodies(other);
}

RobotState& RobotState::operator=(const RobotState& other)
{
  if (this == &other)
    return *this;
  robot_model_ = other.robot_model_;
  *core_ = *other.core_;
  copyBodies(other);
  return *this;
}

void RobotState::copyBodies(const RobotState& other)
{
  attached_body_update_callback_ = other.attached_body_update_callback_;
  bodies_.clear();
  for (const auto& body : other.bodies_)
    bodies_[body.first].reset(new AttachedBody(*body.second, core_.get()));
}

void RobotState::setCore(const motion::RobotState& core)
{
  *core_ = core;
  std::map<std::string, std::unique_ptr<AttachedBody>> bodies;
  for (const auto& item : core.attached())
  {
    std::unique_ptr<AttachedBody>& known = bodies_[item.first];
    if (known && known->core() == item.second)
      bodies[item.first] = std::move(known);
    else
      bodies[item.first].reset(new AttachedBody(robot_model_->getLinkModel(item.second->link), item.second, core_.get()));
  }
  bodies_ = std::move(bodies);
}

// ---------------------------------------------------------------- positions

double* RobotState::getVariablePositions() { return core_->writePositions(); }

const double* RobotState::getVariablePositions() const { return core_->positions().data(); }

void RobotState::setVariablePositions(const double* position) { core_->setPositions(position); }

void RobotState::setVariablePositions(const std::vector<double>& position)
{
  if (position.size() < getVariableCount())
    throw Exception("setVariablePositions: " + std::to_string(position.size()) + " values for the " +
                    std::to_string(getVariableCount()) + " variables of '" + robot_model_->getName() + "'");
  core_->setPositions(position.data());
}

void RobotState::setVariablePosition(int index, double value) { core_->setVariable(index, value); }

void RobotState::setVariablePositions(const std::map<std::string, double>& variable_map)
{
  for (const auto& item : variable_map)
    setVariablePosition(item.first, item.second);
}

void RobotState::setVariablePositions(const std::map<std::string, double>& variable_map,
                                      std::vector<std::string>& missing_variables)
{
  setVariablePositions(variable_map);
  missing(variable_map, missing_variables);
}

void RobotState::setVariablePositions(const std::vector<std::string>& variable_names,
                                      const std::vector<double>& variable_position)
{
  for (std::size_t i = 0; i < variable_names.size() && i < variable_position.size(); ++i)
    setVariablePosition(variable_names[i], variable_position[i]);
}

void RobotState::missing(const std::map<std::string, double>& variable_map, std::vector<std::string>& missing_variables) const
{
  missing_variables.clear();
  for (const std::string& name : robot_model_->getVariableNames())
    if (!variable_map.count(name) && !robot_model_->getJointOfVariable(name)->getMimic())
      missing_variables.push_back(name);
}

// ---------------------------------------------------------------- velocities and the like

std::vector<double>& RobotState::values(Kind kind)
{
  return kind == VELOCITY ? core_->velocities : kind == ACCELERATION ? core_->accelerations : core_->efforts;
}

std::vector<double>& RobotState::made(Kind kind)
{
  std::vector<double>& all = values(kind);
  if (all.empty())
    all.assign(getVariableCount(), 0.0);
  return all;
}

const double* RobotState::read(Kind kind) const
{
  static thread_local std::vector<double> zeros;
  const std::vector<double>& all = values(kind);
  if (!all.empty())
    return all.data();
  if (zeros.size() < getVariableCount())
    zeros.assign(getVariableCount(), 0.0);
  return zeros.data();
}

void RobotState::dropDynamics()
{
  dropVelocities();
  dropAccelerations();
  dropEffort();
}

void RobotState::invertVelocity()
{
  for (double& value : core_->velocities)
    value = -value;
}

// ---------------------------------------------------------------- joints and groups

void RobotState::setJointPositions(const JointModel* joint, const double* position)
{
  core_->setJoint(joint->core(), position);
}

void RobotState::setJointPositions(const JointModel* joint, const Eigen::Isometry3d& transform)
{
  std::vector<double> position(joint->getVariableCount());
  joint->computeVariablePositions(transform, position.data());
  core_->setJoint(joint->core(), position.data());
}

void RobotState::setJointVelocities(const JointModel* joint, const double* velocity)
{
  std::copy(velocity, velocity + joint->getVariableCount(), made(VELOCITY).begin() + joint->getFirstVariableIndex());
}

void RobotState::setJointEfforts(const JointModel* joint, const double* effort)
{
  std::copy(effort, effort + joint->getVariableCount(), made(EFFORT).begin() + joint->getFirstVariableIndex());
}

const double* RobotState::sized(const JointModelGroup* group, const double* data, std::size_t size) const
{
  if (size != group->getVariableCount())
    throw Exception(std::to_string(size) + " values for group '" + group->getName() + "', which has " +
                    std::to_string(group->getVariableCount()) + " variables");
  return data;
}

namespace
{
void scatter(const JointModelGroup* group, const double* from, double* to)
{
  for (int index : group->getVariableIndexList())
    to[index] = *from++;
}

void gather(const JointModelGroup* group, const double* from, double* to)
{
  for (int index : group->getVariableIndexList())
    *to++ = from[index];
}
}  // namespace

// A mimic joint whose leader is in the group follows that one, whatever the values say.
void RobotState::setJointGroupPositions(const JointModelGroup* group, const double* gstate)
{
  scatter(group, gstate, core_->writePositions());
  for (const JointModel* joint : group->getActiveJointModels())
    if (!joint->getMimicRequests().empty())
      core_->setVariable(joint->getFirstVariableIndex(), core_->positions()[joint->getFirstVariableIndex()]);
}

void RobotState::copyJointGroupPositions(const JointModelGroup* group, double* gstate) const
{
  gather(group, getVariablePositions(), gstate);
}

void RobotState::setJointGroupVelocities(const JointModelGroup* group, const double* gstate)
{
  scatter(group, gstate, made(VELOCITY).data());
}

void RobotState::copyJointGroupVelocities(const JointModelGroup* group, double* gstate) const
{
  gather(group, read(VELOCITY), gstate);
}

void RobotState::setJointGroupAccelerations(const JointModelGroup* group, const double* gstate)
{
  scatter(group, gstate, made(ACCELERATION).data());
}

void RobotState::copyJointGroupAccelerations(const JointModelGroup* group, double* gstate) const
{
  gather(group, read(ACCELERATION), gstate);
}

void RobotState::setJointGroupActivePositions(const JointModelGroup* group, const std::vector<double>& gstate)
{
  if (gstate.size() != group->getActiveVariableCount())
    throw Exception(std::to_string(gstate.size()) + " values for group '" + group->getName() + "', which has " +
                    std::to_string(group->getActiveVariableCount()) + " active variables");
  core_->setGroup(group->core(), gstate.data());
}

void RobotState::setJointGroupActivePositions(const JointModelGroup* group, const Eigen::VectorXd& values)
{
  setJointGroupActivePositions(group, std::vector<double>(values.data(), values.data() + values.size()));
}

void RobotState::setVariableValues(const sensor_msgs::JointState& msg)
{
  if (!msg.position.empty())
    setVariablePositions(msg.name, msg.position);
  if (!msg.velocity.empty())
    setVariableVelocities(msg.name, msg.velocity);
}

// ---------------------------------------------------------------- named and random values

void RobotState::setToDefaultValues() { core_->setDefault(); }

bool RobotState::setToDefaultValues(const JointModelGroup* group, const std::string& name)
{
  return core_->setNamed(group->core(), name);
}

bool RobotState::setToDefaultValues(const std::string& group_name, const std::string& state_name)
{
  const JointModelGroup* group = getJointModelGroup(group_name);
  return group && setToDefaultValues(group, state_name);
}

random_numbers::RandomNumberGenerator& RobotState::getRandomNumberGenerator()
{
  if (!rng_)
    rng_.reset(new random_numbers::RandomNumberGenerator());
  return *rng_;
}

void RobotState::setToRandomPositions() { setToRandomPositions(getRandomNumberGenerator()); }

void RobotState::setToRandomPositions(const JointModelGroup* group) { setToRandomPositions(group, getRandomNumberGenerator()); }

void RobotState::setToRandomPositions(random_numbers::RandomNumberGenerator& rng) { setToRandomPositions(nullptr, rng); }

void RobotState::setToRandomPositions(const JointModelGroup* group, random_numbers::RandomNumberGenerator& rng)
{
  motion::Random random(static_cast<std::uint64_t>(rng.uniformInteger(0, INT_MAX)));
  core_->randomize(group ? &group->core() : nullptr, random);
}

void RobotState::setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed, double distance)
{
  setToRandomPositionsNearBy(group, seed, distance, getRandomNumberGenerator());
}

void RobotState::setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed, double distance,
                                            random_numbers::RandomNumberGenerator& rng)
{
  motion::Random random(static_cast<std::uint64_t>(rng.uniformInteger(0, INT_MAX)));
  core_->randomizeNear(group->core(), *seed.core_, distance, random);
}

void RobotState::setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed,
                                            const std::vector<double>& distances)
{
  setToRandomPositionsNearBy(group, seed, distances, getRandomNumberGenerator());
}

void RobotState::setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed,
                                            const std::vector<double>& distances, random_numbers::RandomNumberGenerator& rng)
{
  std::vector<double> from, to(group->getVariableCount());
  seed.copyJointGroupPositions(group, from);
  group->getVariableRandomPositionsNearBy(rng, to.data(), from.data(), distances);
  setJointGroupPositions(group, to.data());
}

// ---------------------------------------------------------------- distance, bounds

double RobotState::distance(const RobotState& other) const { return core_->distance(*other.core_, nullptr); }

double RobotState::distance(const RobotState& other, const JointModelGroup* joint_group) const
{
  return core_->distance(*other.core_, &joint_group->core());
}

double RobotState::distance(const RobotState& other, const JointModel* joint) const
{
  return joint->distance(getJointPositions(joint), other.getJointPositions(joint));
}

void RobotState::interpolate(const RobotState& to, double t, RobotState& state) const
{
  interpolate(to, t, state, static_cast<const JointModelGroup*>(nullptr));
}

void RobotState::interpolate(const RobotState& to, double t, RobotState& state, const JointModelGroup* joint_group) const
{
  if (!std::isfinite(t))
    throw Exception("Interpolation parameter is NaN or inf.");
  const motion::RobotState between = core_->interpolate(*to.core_, t, joint_group ? &joint_group->core() : nullptr);
  if (!joint_group)
    state.core_->setPositions(between.positions().data());
  else
  {
    std::vector<double> values(joint_group->core().size());
    between.getGroup(joint_group->core(), values.data());
    state.core_->setGroup(joint_group->core(), values.data());
  }
}

void RobotState::interpolate(const RobotState& to, double t, RobotState& state, const JointModel* joint) const
{
  std::vector<double> values(joint->getVariableCount());
  joint->interpolate(getJointPositions(joint), to.getJointPositions(joint), t, values.data());
  state.setJointPositions(joint, values.data());
}

void RobotState::enforceBounds()
{
  for (const JointModel* joint : robot_model_->getActiveJointModels())
    enforceBounds(joint);
}

void RobotState::enforceBounds(const JointModelGroup* joint_group)
{
  for (const JointModel* joint : joint_group->getActiveJointModels())
    enforceBounds(joint);
}

void RobotState::enforceBounds(const JointModel* joint)
{
  enforcePositionBounds(joint);
  if (hasVelocities())
    enforceVelocityBounds(joint);
}

void RobotState::enforcePositionBounds(const JointModel* joint)
{
  std::vector<double> values(getJointPositions(joint), getJointPositions(joint) + joint->getVariableCount());
  if (joint->enforcePositionBounds(values.data()))
    setJointPositions(joint, values.data());
}

void RobotState::enforceVelocityBounds(const JointModel* joint)
{
  joint->enforceVelocityBounds(made(VELOCITY).data() + joint->getFirstVariableIndex());
}

void RobotState::harmonizePositions()
{
  for (const JointModel* joint : robot_model_->getActiveJointModels())
    harmonizePosition(joint);
}

void RobotState::harmonizePositions(const JointModelGroup* joint_group)
{
  for (const JointModel* joint : joint_group->getActiveJointModels())
    harmonizePosition(joint);
}

void RobotState::harmonizePosition(const JointModel* joint)
{
  std::vector<double> values(getJointPositions(joint), getJointPositions(joint) + joint->getVariableCount());
  if (joint->harmonizePosition(values.data()))
    setJointPositions(joint, values.data());
}

bool RobotState::satisfiesBounds(double margin) const
{
  for (const JointModel* joint : robot_model_->getActiveJointModels())
    if (!satisfiesBounds(joint, margin))
      return false;
  return true;
}

bool RobotState::satisfiesBounds(const JointModelGroup* joint_group, double margin) const
{
  for (const JointModel* joint : joint_group->getActiveJointModels())
    if (!satisfiesBounds(joint, margin))
      return false;
  return true;
}

bool RobotState::satisfiesBounds(const JointModel* joint, double margin) const
{
  return satisfiesPositionBounds(joint, margin) && (!hasVelocities() || satisfiesVelocityBounds(joint, margin));
}

std::pair<double, const JointModel*> RobotState::getMinDistanceToPositionBounds() const
{
  return getMinDistanceToPositionBounds(robot_model_->getActiveJointModels());
}

std::pair<double, const JointModel*> RobotState::getMinDistanceToPositionBounds(const JointModelGroup* group) const
{
  return getMinDistanceToPositionBounds(group->getActiveJointModels());
}

std::pair<double, const JointModel*> RobotState::getMinDistanceToPositionBounds(
    const std::vector<const JointModel*>& joints) const
{
  std::pair<double, const JointModel*> nearest(std::numeric_limits<double>::max(), nullptr);
  for (const JointModel* joint : joints)
  {
    if (joint->getType() == JointModel::REVOLUTE && static_cast<const RevoluteJointModel*>(joint)->isContinuous())
      continue;
    const double* value = getJointPositions(joint);
    for (const VariableBounds& b : joint->getVariableBounds())
    {
      const double left = std::min(std::abs(*value - b.min_position_), std::abs(b.max_position_ - *value));
      ++value;
      if (b.position_bounded_ && left < nearest.first)
        nearest = { left, joint };
    }
  }
  return nearest;
}

bool RobotState::isValidVelocityMove(const RobotState& other, const JointModelGroup* group, double dt) const
{
  for (const JointModel* joint : group->getActiveJointModels())
  {
    const VariableBounds& b = joint->getVariableBounds()[0];
    if (joint->getVariableCount() == 1 && b.velocity_bounded_ && distance(other, joint) > dt * b.max_velocity_)
      return false;
  }
  return true;
}
}  // namespace core
}  // namespace moveit
