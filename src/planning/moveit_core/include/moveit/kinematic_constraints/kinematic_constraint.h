// What paths and goals may demand of joints, links and sensors: the motion library's constraints, made of messages.
#pragma once

#include <moveit_msgs/Constraints.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/robot_model/robot_model.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/transforms/transforms.h>

namespace bodies
{
class Body;
typedef std::shared_ptr<Body> BodyPtr;
}  // namespace bodies

namespace motion
{
struct Constraints;
class ConstraintSet;
}  // namespace motion

namespace kinematic_constraints
{
struct ConstraintEvaluationResult
{
  ConstraintEvaluationResult(bool result_satisfied = false, double dist = 0.0) : satisfied(result_satisfied), distance(dist) {}
  bool satisfied;
  double distance;  // from what is wanted, rad or m, times the weight
};

MOVEIT_CLASS_FORWARD(KinematicConstraint);

class KinematicConstraint
{
public:
  enum ConstraintType
  {
    UNKNOWN_CONSTRAINT,
    JOINT_CONSTRAINT,
    POSITION_CONSTRAINT,
    ORIENTATION_CONSTRAINT,
    VISIBILITY_CONSTRAINT
  };
  KinematicConstraint(const moveit::core::RobotModelConstPtr& model) : robot_model_(model) {}
  virtual ~KinematicConstraint() {}

  virtual void clear()
  {
    core_.reset();
    given_.reset();
  }
  virtual ConstraintEvaluationResult decide(const moveit::core::RobotState& state, bool verbose = false) const;
  virtual bool enabled() const { return core_ != nullptr; }
  virtual bool equal(const KinematicConstraint& other, double margin) const = 0;
  virtual void print(std::ostream& /*out*/ = std::cout) const {}
  ConstraintType getType() const { return type_; }
  double getConstraintWeight() const { return constraint_weight_; }
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  // As the motion library takes it; null until configured.
  const std::shared_ptr<const motion::Constraints>& given() const { return given_; }

protected:
  bool make(const motion::Constraints& constraints, const moveit::core::Transforms* tf);

  ConstraintType type_ = UNKNOWN_CONSTRAINT;
  moveit::core::RobotModelConstPtr robot_model_;
  double constraint_weight_ = 1.0;
  std::shared_ptr<const motion::ConstraintSet> core_;  // of this one; null until configured
  std::shared_ptr<const motion::Constraints> given_;
};

MOVEIT_CLASS_FORWARD(JointConstraint);

class JointConstraint : public KinematicConstraint
{
public:
  JointConstraint(const moveit::core::RobotModelConstPtr& model) : KinematicConstraint(model) { type_ = JOINT_CONSTRAINT; }
  bool configure(const moveit_msgs::JointConstraint& jc);  // false, and a line in the log, when it cannot be used
  bool equal(const KinematicConstraint& other, double margin) const override;
  void print(std::ostream& out = std::cout) const override;
  const moveit::core::JointModel* getJointModel() const;
  std::string getLocalVariableName() const;
  const std::string& getJointVariableName() const { return message_.joint_name; }
  int getJointVariableIndex() const;
  double getDesiredJointPosition() const { return message_.position; }
  double getJointToleranceAbove() const { return message_.tolerance_above; }
  double getJointToleranceBelow() const { return message_.tolerance_below; }

protected:
  moveit_msgs::JointConstraint message_;
};

MOVEIT_CLASS_FORWARD(OrientationConstraint);

class OrientationConstraint : public KinematicConstraint
{
public:
  OrientationConstraint(const moveit::core::RobotModelConstPtr& model) : KinematicConstraint(model)
  {
    type_ = ORIENTATION_CONSTRAINT;
  }
  bool configure(const moveit_msgs::OrientationConstraint& oc, const moveit::core::Transforms& tf);
  bool equal(const KinematicConstraint& other, double margin) const override;
  void print(std::ostream& out = std::cout) const override;
  const moveit::core::LinkModel* getLinkModel() const;
  const std::string& getReferenceFrame() const { return message_.header.frame_id; }
  bool mobileReferenceFrame() const;
  // In the reference frame when that moves, else in the model frame.
  Eigen::Matrix3d getDesiredRotationMatrix() const;
  Eigen::Matrix3d getDesiredRotationMatrixInRefFrame() const;  // in the reference frame, whether that moves or not
  double getXAxisTolerance() const { return message_.absolute_x_axis_tolerance; }
  double getYAxisTolerance() const { return message_.absolute_y_axis_tolerance; }
  double getZAxisTolerance() const { return message_.absolute_z_axis_tolerance; }
  int getParameterizationType() const { return message_.parameterization; }

protected:
  moveit_msgs::OrientationConstraint message_;
};

MOVEIT_CLASS_FORWARD(PositionConstraint);

class PositionConstraint : public KinematicConstraint
{
public:
  PositionConstraint(const moveit::core::RobotModelConstPtr& model) : KinematicConstraint(model)
  {
    type_ = POSITION_CONSTRAINT;
  }
  bool configure(const moveit_msgs::PositionConstraint& pc, const moveit::core::Transforms& tf);
  bool equal(const KinematicConstraint& other, double margin) const override;
  void print(std::ostream& out = std::cout) const override;
  const moveit::core::LinkModel* getLinkModel() const;
  Eigen::Vector3d getLinkOffset() const;
  bool hasLinkOffset() const;
  const std::string& getReferenceFrame() const { return message_.header.frame_id; }
  bool mobileReferenceFrame() const;
  // In the reference frame when that moves, else in the model frame.
  const std::vector<bodies::BodyPtr>& getConstraintRegions() const { return constraint_region_; }

protected:
  moveit_msgs::PositionConstraint message_;
  std::vector<bodies::BodyPtr> constraint_region_;
};

MOVEIT_CLASS_FORWARD(VisibilityConstraint);

class VisibilityConstraint : public KinematicConstraint
{
public:
  VisibilityConstraint(const moveit::core::RobotModelConstPtr& model) : KinematicConstraint(model)
  {
    type_ = VISIBILITY_CONSTRAINT;
  }
  bool configure(const moveit_msgs::VisibilityConstraint& vc, const moveit::core::Transforms& tf);
  bool equal(const KinematicConstraint& other, double margin) const override;

protected:
  moveit_msgs::VisibilityConstraint message_;
};

MOVEIT_CLASS_FORWARD(KinematicConstraintSet);

// All of them at once.
class KinematicConstraintSet
{
public:
  KinematicConstraintSet(const moveit::core::RobotModelConstPtr& model) : robot_model_(model) {}

  void clear();
  // False if one cannot be used; the others are added.
  bool add(const moveit_msgs::Constraints& c, const moveit::core::Transforms& tf);
  bool add(const std::vector<moveit_msgs::JointConstraint>& jc);
  bool add(const std::vector<moveit_msgs::PositionConstraint>& pc, const moveit::core::Transforms& tf);
  bool add(const std::vector<moveit_msgs::OrientationConstraint>& oc, const moveit::core::Transforms& tf);
  bool add(const std::vector<moveit_msgs::VisibilityConstraint>& vc, const moveit::core::Transforms& tf);
  ConstraintEvaluationResult decide(const moveit::core::RobotState& state, bool verbose = false) const;
  ConstraintEvaluationResult decide(const moveit::core::RobotState& state, std::vector<ConstraintEvaluationResult>& results,
                                    bool verbose = false) const;
  bool equal(const KinematicConstraintSet& other, double margin) const;
  void print(std::ostream& out = std::cout) const;
  const std::vector<moveit_msgs::PositionConstraint>& getPositionConstraints() const { return all_.position_constraints; }
  const std::vector<moveit_msgs::OrientationConstraint>& getOrientationConstraints() const
  {
    return all_.orientation_constraints;
  }
  const std::vector<moveit_msgs::JointConstraint>& getJointConstraints() const { return all_.joint_constraints; }
  const std::vector<moveit_msgs::VisibilityConstraint>& getVisibilityConstraints() const { return all_.visibility_constraints; }
  const moveit_msgs::Constraints& getAllConstraints() const { return all_; }
  motion::Constraints given() const;  // all that can be used, as the motion library takes them
  bool empty() const { return constraints_.empty(); }

protected:
  moveit::core::RobotModelConstPtr robot_model_;
  std::vector<KinematicConstraintPtr> constraints_;
  moveit_msgs::Constraints all_;
};
}  // namespace kinematic_constraints
