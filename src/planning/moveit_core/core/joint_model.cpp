#include <algorithm>
#include <climits>
#include <cmath>

#include <ros/console.h>

#include <moveit/exceptions/exceptions.h>
#include <moveit/robot_model/fixed_joint_model.h>
#include <moveit/robot_model/floating_joint_model.h>
#include <moveit/robot_model/planar_joint_model.h>
#include <moveit/robot_model/prismatic_joint_model.h>
#include <moveit/robot_model/revolute_joint_model.h>

#include "motion/robot_state.hpp"

namespace moveit
{
namespace core
{
namespace
{
JointModel::JointType typeOf(const motion::JointModel& core)
{
  switch (core.type)
  {
    case motion::JointType::Revolute:
      return JointModel::REVOLUTE;
    case motion::JointType::Prismatic:
      return JointModel::PRISMATIC;
    case motion::JointType::Planar:
      return JointModel::PLANAR;
    case motion::JointType::Floating:
      return JointModel::FLOATING;
    default:
      return JointModel::FIXED;
  }
}

VariableBounds fromCore(const motion::VariableBounds& b)
{
  VariableBounds out;
  out.position_bounded_ = b.has_position;
  out.min_position_ = b.min_position;
  out.max_position_ = b.max_position;
  out.velocity_bounded_ = b.has_velocity;
  out.min_velocity_ = -b.max_velocity;
  out.max_velocity_ = b.max_velocity;
  out.acceleration_bounded_ = b.has_acceleration;
  out.min_acceleration_ = -b.max_acceleration;
  out.max_acceleration_ = b.max_acceleration;
  return out;
}

motion::VariableBounds toCore(const VariableBounds& b, motion::VariableBounds out)
{
  out.has_position = b.position_bounded_;
  out.min_position = b.min_position_;
  out.max_position = b.max_position_;
  out.has_velocity = b.velocity_bounded_;
  out.max_velocity = b.max_velocity_;
  out.has_acceleration = b.acceleration_bounded_;
  out.max_acceleration = b.max_acceleration_;
  return out;
}

moveit_msgs::JointLimits message(const std::string& name, const VariableBounds& b)
{
  moveit_msgs::JointLimits limit;
  limit.joint_name = name;
  limit.has_position_limits = b.position_bounded_;
  limit.min_position = b.min_position_;
  limit.max_position = b.max_position_;
  limit.has_velocity_limits = b.velocity_bounded_;
  limit.max_velocity = std::min(std::abs(b.min_velocity_), std::abs(b.max_velocity_));
  limit.has_acceleration_limits = b.acceleration_bounded_;
  limit.max_acceleration = std::min(std::abs(b.min_acceleration_), std::abs(b.max_acceleration_));
  return limit;
}

// The joint of the library, with other bounds when they are not its own.
class WithBounds
{
public:
  WithBounds(const JointModel& joint, const JointModel::Bounds& bounds) : core_(&joint.core())
  {
    if (&bounds == &joint.getVariableBounds())
      return;
    copy_ = joint.core();
    for (std::size_t i = 0; i < copy_.bounds.size() && i < bounds.size(); ++i)
      copy_.bounds[i] = toCore(bounds[i], copy_.bounds[i]);
    core_ = &copy_;
  }
  const motion::JointModel* operator->() const { return core_; }
  const motion::JointModel& operator*() const { return *core_; }

private:
  const motion::JointModel* core_;
  motion::JointModel copy_;
};

motion::Random seeded(random_numbers::RandomNumberGenerator& rng)
{
  return motion::Random(static_cast<std::uint64_t>(rng.uniformInteger(0, INT_MAX)));
}
}  // namespace

JointModel::JointModel(motion::RobotModel& robot, int index)
  : robot_(&robot)
  , core_(&robot.joints[index])
  , name_(core_->name)
  , type_(typeOf(*core_))
  , variable_names_(core_->variables)
  , first_variable_index_(core_->first_variable)
  , joint_index_(index)
{
  for (const std::string& variable : variable_names_)
    local_variable_names_.push_back(variable == name_ ? name_ : variable.substr(name_.size() + 1));
  readBounds();
}

JointModel::~JointModel() = default;

void JointModel::readBounds()
{
  variable_bounds_.clear();
  variable_bounds_msg_.clear();
  for (std::size_t i = 0; i < variable_names_.size(); ++i)
  {
    variable_bounds_.push_back(fromCore(core_->bounds[i]));
    variable_bounds_msg_.push_back(message(variable_names_[i], variable_bounds_[i]));
  }
}

void JointModel::writeBounds()
{
  std::vector<motion::VariableBounds> bounds = core_->bounds;
  for (std::size_t i = 0; i < bounds.size(); ++i)
  {
    bounds[i] = toCore(variable_bounds_[i], bounds[i]);
    variable_bounds_msg_[i] = message(variable_names_[i], variable_bounds_[i]);
  }
  robot_->setBounds(joint_index_, bounds);
}

std::string JointModel::getTypeName() const
{
  static const char* const names[] = { "[unkown]", "Revolute", "Prismatic", "Planar", "Floating", "Fixed" };
  return names[type_];
}

bool JointModel::hasVariable(const std::string& variable) const
{
  return std::find(variable_names_.begin(), variable_names_.end(), variable) != variable_names_.end();
}

int JointModel::getLocalVariableIndex(const std::string& variable) const
{
  for (std::size_t i = 0; i < variable_names_.size(); ++i)
    if (variable_names_[i] == variable || local_variable_names_[i] == variable)
      return static_cast<int>(i);
  throw Exception("Could not find variable '" + variable + "' to get bounds for within joint '" + name_ + "'");
}

// ---------------------------------------------------------------- values

void JointModel::getVariableDefaultPositions(double* values, const Bounds& other_bounds) const
{
  for (std::size_t i = 0; i < variable_names_.size(); ++i)
  {
    const VariableBounds& b = other_bounds[i];
    const bool zero_fits = !b.position_bounded_ || (b.min_position_ <= 0 && b.max_position_ >= 0);
    values[i] = zero_fits ? 0.0 : 0.5 * (b.min_position_ + b.max_position_);
  }
  if (type_ == FLOATING)
    values[6] = 1.0;
}

void JointModel::getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values,
                                            const Bounds& other_bounds) const
{
  motion::Random random = seeded(rng);
  motion::randomJoint(*WithBounds(*this, other_bounds), values, random);
}

void JointModel::getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                                  const Bounds& other_bounds, const double* seed, const double distance) const
{
  for (std::size_t i = 0; i < variable_names_.size(); ++i)
    values[i] = seed[i] + rng.uniformReal(-distance, distance);
  WithBounds(*this, other_bounds)->enforceBounds(values);
}

bool JointModel::satisfiesPositionBounds(const double* values, const Bounds& other_bounds, double margin) const
{
  return WithBounds(*this, other_bounds)->satisfiesBounds(values, margin);
}

bool JointModel::enforcePositionBounds(double* values, const Bounds& other_bounds) const
{
  return WithBounds(*this, other_bounds)->enforceBounds(values);
}

bool JointModel::harmonizePosition(double* values, const Bounds& other_bounds) const
{
  if (type_ != REVOLUTE)
    return false;
  const double before = *values, low = other_bounds[0].min_position_, high = other_bounds[0].max_position_;
  while (*values > high && *values - 2 * M_PI >= low)
    *values -= 2 * M_PI;
  while (*values < low && *values + 2 * M_PI <= high)
    *values += 2 * M_PI;
  return *values != before;
}

bool JointModel::satisfiesVelocityBounds(const double* values, const Bounds& other_bounds, double margin) const
{
  for (std::size_t i = 0; i < other_bounds.size(); ++i)
    if (other_bounds[i].velocity_bounded_ &&
        (values[i] > other_bounds[i].max_velocity_ + margin || values[i] < other_bounds[i].min_velocity_ - margin))
      return false;
  return true;
}

bool JointModel::enforceVelocityBounds(double* values, const Bounds& other_bounds) const
{
  bool changed = false;
  for (std::size_t i = 0; i < other_bounds.size(); ++i)
  {
    if (!other_bounds[i].velocity_bounded_)
      continue;
    const double value = std::min(std::max(values[i], other_bounds[i].min_velocity_), other_bounds[i].max_velocity_);
    changed = changed || value != values[i];
    values[i] = value;
  }
  return changed;
}

bool JointModel::satisfiesAccelerationBounds(const double* values, const Bounds& other_bounds, double margin) const
{
  for (std::size_t i = 0; i < other_bounds.size(); ++i)
    if (other_bounds[i].acceleration_bounded_ &&
        (values[i] > other_bounds[i].max_acceleration_ + margin || values[i] < other_bounds[i].min_acceleration_ - margin))
      return false;
  return true;
}

const VariableBounds& JointModel::getVariableBounds(const std::string& variable) const
{
  return variable_bounds_[getLocalVariableIndex(variable)];
}

void JointModel::setVariableBounds(const std::string& variable, const VariableBounds& bounds)
{
  variable_bounds_[getLocalVariableIndex(variable)] = bounds;
  writeBounds();
}

void JointModel::setVariableBounds(const std::vector<moveit_msgs::JointLimits>& jlim)
{
  for (const moveit_msgs::JointLimits& limit : jlim)
    for (std::size_t i = 0; i < variable_names_.size(); ++i)
    {
      if (variable_names_[i] != limit.joint_name)
        continue;
      VariableBounds& b = variable_bounds_[i];
      b.position_bounded_ = limit.has_position_limits;
      if (b.position_bounded_)
      {
        b.min_position_ = limit.min_position;
        b.max_position_ = limit.max_position;
      }
      b.velocity_bounded_ = limit.has_velocity_limits;
      if (b.velocity_bounded_)
      {
        b.min_velocity_ = -limit.max_velocity;
        b.max_velocity_ = limit.max_velocity;
      }
      b.acceleration_bounded_ = limit.has_acceleration_limits;
      if (b.acceleration_bounded_)
      {
        b.min_acceleration_ = -limit.max_acceleration;
        b.max_acceleration_ = limit.max_acceleration;
      }
    }
  writeBounds();
}

double JointModel::distance(const double* value1, const double* value2) const { return core_->distance(value1, value2); }

double JointModel::getDistanceFactor() const { return core_->distance_factor; }

void JointModel::setDistanceFactor(double factor) { core_->distance_factor = factor; }

unsigned int JointModel::getStateSpaceDimension() const { return type_ == FLOATING ? 6 : variable_names_.size(); }

void JointModel::interpolate(const double* from, const double* to, const double t, double* state) const
{
  core_->interpolate(from, to, t, state);
}

double JointModel::getMaximumExtent(const Bounds& other_bounds) const
{
  if (core_->continuous)  // as upstream, although no two angles are farther apart than half of that
    return other_bounds[0].max_position_ - other_bounds[0].min_position_;
  return WithBounds(*this, other_bounds)->maximumExtent();
}

void JointModel::computeTransform(const double* joint_values, Eigen::Isometry3d& transf) const
{
  transf = core_->origin.inverse() * core_->transform(joint_values);
}

void JointModel::computeVariablePositions(const Eigen::Isometry3d& transform, double* joint_values) const
{
  core_->valuesOf(transform, joint_values);
}

double JointModel::getMimicOffset() const { return core_->mimic_offset; }

double JointModel::getMimicFactor() const { return core_->mimic_factor; }

bool JointModel::isPassive() const { return core_->passive; }

void JointModel::setPassive(bool flag) { core_->passive = flag; }

// ---------------------------------------------------------------- kinds of joints

const Eigen::Vector3d& PrismaticJointModel::getAxis() const { return core_->axis; }

const Eigen::Vector3d& RevoluteJointModel::getAxis() const { return core_->axis; }

bool RevoluteJointModel::isContinuous() const { return core_->continuous; }

void RevoluteJointModel::setContinuous(bool flag)
{
  core_->continuous = flag;
  VariableBounds& b = variable_bounds_[0];
  b.position_bounded_ = !flag;
  if (flag)
  {
    b.min_position_ = -M_PI;
    b.max_position_ = M_PI;
  }
  writeBounds();
}

double PlanarJointModel::getAngularDistanceWeight() const { return core_->angular_distance_weight; }

void PlanarJointModel::setAngularDistanceWeight(double weight) { core_->angular_distance_weight = weight; }

double PlanarJointModel::getMinTranslationalDistance() const { return core_->min_translational_distance; }

void PlanarJointModel::setMinTranslationalDistance(double min_translational_distance)
{
  core_->min_translational_distance = min_translational_distance;
}

PlanarJointModel::MotionModel PlanarJointModel::getMotionModel() const { return core_->diff_drive ? DIFF_DRIVE : HOLONOMIC; }

void PlanarJointModel::setMotionModel(MotionModel model) { core_->diff_drive = model == DIFF_DRIVE; }

bool PlanarJointModel::normalizeRotation(double* values) const
{
  if (std::abs(values[2]) <= M_PI)
    return false;
  values[2] = motion::wrapAngle(values[2]);
  return true;
}

double FloatingJointModel::getAngularDistanceWeight() const { return core_->angular_distance_weight; }

void FloatingJointModel::setAngularDistanceWeight(double weight) { core_->angular_distance_weight = weight; }

bool FloatingJointModel::normalizeRotation(double* values) const
{
  Eigen::Map<Eigen::Vector4d> q(values + 3);
  const double norm = q.norm();
  if (std::abs(norm - 1.0) <= std::numeric_limits<double>::epsilon() * 10.0)
    return false;
  if (norm > 1e-9)
    q /= norm;
  else
    q = Eigen::Vector4d::UnitW();
  return true;
}

double FloatingJointModel::distanceTranslation(const double* values1, const double* values2) const
{
  return (Eigen::Map<const Eigen::Vector3d>(values1) - Eigen::Map<const Eigen::Vector3d>(values2)).norm();
}

double FloatingJointModel::distanceRotation(const double* values1, const double* values2) const
{
  return distance(values1, values2) - distanceTranslation(values1, values2);
}

std::ostream& operator<<(std::ostream& out, const VariableBounds& b)
{
  auto range = [&out](char letter, bool bounded, double low, double high) {
    out << letter << '.';
    if (bounded)
      out << "bounded [" << low << ", " << high << "]; ";
    else
      out << "unbounded; ";
  };
  range('P', b.position_bounded_, b.min_position_, b.max_position_);
  range('V', b.velocity_bounded_, b.min_velocity_, b.max_velocity_);
  range('A', b.acceleration_bounded_, b.min_acceleration_, b.max_acceleration_);
  return out;
}
}  // namespace core
}  // namespace moveit
