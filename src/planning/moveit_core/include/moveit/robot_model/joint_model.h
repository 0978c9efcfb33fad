// A joint of a robot: its variables, their bounds, and the transform that it makes of their values.
#pragma once

#include <moveit_msgs/JointLimits.h>
#include <random_numbers/random_numbers.h>

#include <Eigen/Geometry>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace motion
{
struct JointModel;
class RobotModel;
}  // namespace motion

namespace moveit
{
namespace core
{
struct VariableBounds
{
  double min_position_ = 0.0, max_position_ = 0.0;
  bool position_bounded_ = false;
  double min_velocity_ = 0.0, max_velocity_ = 0.0;
  bool velocity_bounded_ = false;
  double min_acceleration_ = 0.0, max_acceleration_ = 0.0;
  bool acceleration_bounded_ = false;
};

class LinkModel;
class JointModel;

typedef std::map<std::string, int> VariableIndexMap;
using VariableBoundsMap = std::map<std::string, VariableBounds>;
using JointModelMap = std::map<std::string, JointModel*>;
using JointModelMapConst = std::map<std::string, const JointModel*>;

// Made by RobotModel alone; values are arrays of getVariableCount() numbers.
class JointModel
{
public:
  enum JointType
  {
    UNKNOWN,
    REVOLUTE,
    PRISMATIC,
    PLANAR,
    FLOATING,
    FIXED
  };
  using Bounds = std::vector<VariableBounds>;

  virtual ~JointModel();
  JointModel(const JointModel&) = delete;
  JointModel& operator=(const JointModel&) = delete;

  const std::string& getName() const { return name_; }
  JointType getType() const { return type_; }
  std::string getTypeName() const;
  const LinkModel* getParentLinkModel() const { return parent_link_model_; }
  const LinkModel* getChildLinkModel() const { return child_link_model_; }

  // ------------------------------------------------------------ variables
  const std::vector<std::string>& getVariableNames() const { return variable_names_; }
  const std::vector<std::string>& getLocalVariableNames() const { return local_variable_names_; }  // "x", "theta"
  bool hasVariable(const std::string& variable) const;
  std::size_t getVariableCount() const { return variable_names_.size(); }
  int getFirstVariableIndex() const { return first_variable_index_; }
  int getJointIndex() const { return joint_index_; }
  int getLocalVariableIndex(const std::string& variable) const;

  void getVariableDefaultPositions(double* values) const { getVariableDefaultPositions(values, variable_bounds_); }
  void getVariableDefaultPositions(double* values, const Bounds& other_bounds) const;
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values) const
  {
    getVariableRandomPositions(rng, values, variable_bounds_);
  }
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values, const Bounds& other_bounds) const;
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values, const double* seed,
                                        const double distance) const
  {
    getVariableRandomPositionsNearBy(rng, values, variable_bounds_, seed, distance);
  }
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values, const Bounds& other_bounds,
                                        const double* seed, const double distance) const;

  // ------------------------------------------------------------ bounds
  bool satisfiesPositionBounds(const double* values, double margin = 0.0) const
  {
    return satisfiesPositionBounds(values, variable_bounds_, margin);
  }
  bool satisfiesPositionBounds(const double* values, const Bounds& other_bounds, double margin) const;
  bool enforcePositionBounds(double* values) const { return enforcePositionBounds(values, variable_bounds_); }
  bool enforcePositionBounds(double* values, const Bounds& other_bounds) const;
  // Whole turns added until the value is within its bounds, if it can be.
  bool harmonizePosition(double* values) const { return harmonizePosition(values, variable_bounds_); }
  bool harmonizePosition(double* values, const Bounds& other_bounds) const;
  bool satisfiesVelocityBounds(const double* values, double margin = 0.0) const
  {
    return satisfiesVelocityBounds(values, variable_bounds_, margin);
  }
  bool satisfiesVelocityBounds(const double* values, const Bounds& other_bounds, double margin) const;
  bool enforceVelocityBounds(double* values) const { return enforceVelocityBounds(values, variable_bounds_); }
  bool enforceVelocityBounds(double* values, const Bounds& other_bounds) const;
  bool satisfiesAccelerationBounds(const double* values, double margin = 0.0) const
  {
    return satisfiesAccelerationBounds(values, variable_bounds_, margin);
  }
  bool satisfiesAccelerationBounds(const double* values, const Bounds& other_bounds, double margin) const;
  const VariableBounds& getVariableBounds(const std::string& variable) const;
  const Bounds& getVariableBounds() const { return variable_bounds_; }
  void setVariableBounds(const std::string& variable, const VariableBounds& bounds);
  void setVariableBounds(const std::vector<moveit_msgs::JointLimits>& jlim);
  const std::vector<moveit_msgs::JointLimits>& getVariableBoundsMsg() const { return variable_bounds_msg_; }

  // ------------------------------------------------------------ distance, motion
  double distance(const double* value1, const double* value2) const;
  double getDistanceFactor() const;
  void setDistanceFactor(double factor);
  unsigned int getStateSpaceDimension() const;
  void interpolate(const double* from, const double* to, const double t, double* state) const;
  double getMaximumExtent(const Bounds& other_bounds) const;
  double getMaximumExtent() const { return getMaximumExtent(variable_bounds_); }
  // The motion alone, without the joint's origin in its parent link.
  void computeTransform(const double* joint_values, Eigen::Isometry3d& transf) const;
  void computeVariablePositions(const Eigen::Isometry3d& transform, double* joint_values) const;

  // ------------------------------------------------------------ relatives
  const JointModel* getMimic() const { return mimic_; }
  double getMimicOffset() const;
  double getMimicFactor() const;
  const std::vector<const JointModel*>& getMimicRequests() const { return mimic_requests_; }
  const std::vector<const LinkModel*>& getDescendantLinkModels() const { return descendant_link_models_; }
  const std::vector<const JointModel*>& getDescendantJointModels() const { return descendant_joint_models_; }
  const std::vector<const JointModel*>& getNonFixedDescendantJointModels() const { return non_fixed_descendant_joint_models_; }
  bool isPassive() const;
  void setPassive(bool flag);

  const motion::JointModel& core() const { return *core_; }

protected:
  friend class RobotModel;
  JointModel(motion::RobotModel& robot, int index);
  void readBounds();
  void writeBounds();

  motion::RobotModel* robot_;
  motion::JointModel* core_;
  std::string name_;
  JointType type_;
  std::vector<std::string> local_variable_names_, variable_names_;
  Bounds variable_bounds_;
  std::vector<moveit_msgs::JointLimits> variable_bounds_msg_;
  const LinkModel *parent_link_model_ = nullptr, *child_link_model_ = nullptr;
  const JointModel* mimic_ = nullptr;
  std::vector<const JointModel*> mimic_requests_;
  std::vector<const LinkModel*> descendant_link_models_;
  std::vector<const JointModel*> descendant_joint_models_, non_fixed_descendant_joint_models_;
  int first_variable_index_, joint_index_;
};

std::ostream& operator<<(std::ostream& out, const VariableBounds& b);
}  // namespace core
}  // namespace moveit
