#include <moveit/kinematic_constraints/kinematic_constraint.h>

#include <geometric_shapes/bodies.h>
#include <geometric_shapes/body_operations.h>

#include <algorithm>
#include <cmath>

#include "frames.hpp"
#include "log_names.hpp"
#include "motion/constraints.hpp"
#include "object_messages.hpp"
#include "shapes.hpp"

namespace kinematic_constraints
{
namespace
{
void addFrame(motion::PlanningScene& scene, const moveit::core::Transforms* tf, const std::string& frame)
{
  if (tf && !frame.empty() && frame != scene.frame() && !scene.model()->findLink(frame) && tf->canTransform(frame))
    scene.setTransform(frame, tf->getTransform(frame));
}

Eigen::Quaterniond quaternion(const geometry_msgs::Quaternion& q) { return Eigen::Quaterniond(q.w, q.x, q.y, q.z); }

bool near(double a, double b, double margin) { return std::abs(a - b) <= margin; }
}  // namespace

bool KinematicConstraint::make(const motion::Constraints& constraints, const moveit::core::Transforms* tf)
{
  clear();
  try
  {
    motion::PlanningScene scene(robot_model_->core());
    for (const auto& c : constraints.position)
      addFrame(scene, tf, c.frame);
    for (const auto& c : constraints.orientation)
      addFrame(scene, tf, c.frame);
    for (const auto& c : constraints.visibility)
      for (const std::string& frame : { c.sensor_frame, c.target_frame })
        addFrame(scene, tf, frame);
    core_ = std::make_shared<motion::ConstraintSet>(scene, constraints);
    given_ = std::make_shared<motion::Constraints>(constraints);
    return true;
  }
  catch (const motion::Error& error)
  {
    ROS_ERROR_NAMED(log_names::KINEMATIC_CONSTRAINTS, "%s", error.what());
    return false;
  }
}

ConstraintEvaluationResult KinematicConstraint::decide(const moveit::core::RobotState& state, bool verbose) const
{
  if (!core_)
    return ConstraintEvaluationResult(true, 0.0);
  const std::vector<motion::ConstraintResult> results = core_->evaluate(state.core());
  ConstraintEvaluationResult all(true, 0.0);
  for (const motion::ConstraintResult& result : results)
  {
    all.satisfied = all.satisfied && result.satisfied;
    all.distance += constraint_weight_ * result.distance;
    if (verbose)
      ROS_INFO_NAMED(log_names::KINEMATIC_CONSTRAINTS, "Constraint %s: %s", result.satisfied ? "satisfied" : "violated",
                     result.description.c_str());
  }
  return all;
}

// ---------------------------------------------------------------- joints

bool JointConstraint::configure(const moveit_msgs::JointConstraint& jc)
{
  message_ = jc;
  constraint_weight_ = jc.weight > std::numeric_limits<double>::epsilon() ? jc.weight : 1.0;
  if (!(jc.tolerance_above >= 0.0) || !(jc.tolerance_below >= 0.0) || !std::isfinite(jc.position))
  {
    clear();
    ROS_WARN_NAMED(log_names::KINEMATIC_CONSTRAINTS,
                   "JointConstraint of '%s': tolerance values must be positive and the position finite.",
                   jc.joint_name.c_str());
    return false;
  }
  motion::Constraints constraints;
  constraints.joint.push_back({ jc.joint_name, jc.position, jc.tolerance_above, jc.tolerance_below, constraint_weight_ });
  if (!make(constraints, nullptr))
    return false;
  const auto& taken = core_->joints.front();  // angles within a turn; beyond a limit, the limit
  message_.position = taken.position, message_.tolerance_above = taken.above, message_.tolerance_below = taken.below;
  return true;
}

const moveit::core::JointModel* JointConstraint::getJointModel() const
{
  return enabled() ? robot_model_->getJointOfVariable(message_.joint_name) : nullptr;
}

int JointConstraint::getJointVariableIndex() const
{
  return enabled() ? robot_model_->getVariableIndex(message_.joint_name) : -1;
}

std::string JointConstraint::getLocalVariableName() const
{
  const moveit::core::JointModel* joint = getJointModel();
  return joint && joint->getVariableCount() > 1 ? message_.joint_name.substr(joint->getName().size() + 1) : "";
}

bool JointConstraint::equal(const KinematicConstraint& other, double margin) const
{
  if (other.getType() != type_)
    return false;
  const moveit_msgs::JointConstraint& o = static_cast<const JointConstraint&>(other).message_;
  return o.joint_name == message_.joint_name && near(o.position, message_.position, margin) &&
         near(o.tolerance_above, message_.tolerance_above, margin) && near(o.tolerance_below, message_.tolerance_below, margin);
}

void JointConstraint::print(std::ostream& out) const
{
  out << "Joint constraint for joint " << message_.joint_name << ": \n  value: " << message_.position
      << "; tolerance below: " << message_.tolerance_below << "; tolerance above: " << message_.tolerance_above << '\n';
}

// ---------------------------------------------------------------- orientation

bool OrientationConstraint::configure(const moveit_msgs::OrientationConstraint& oc, const moveit::core::Transforms& tf)
{
  message_ = oc;
  constraint_weight_ = oc.weight > std::numeric_limits<double>::epsilon() ? oc.weight : 1.0;
  motion::OrientationConstraint c;
  c.link = oc.link_name;
  c.frame = frames::withoutSlash(oc.header.frame_id);
  c.orientation = quaternion(oc.orientation);
  if (std::abs(c.orientation.norm() - 1.0) > 1e-3)
  {
    ROS_WARN_NAMED(log_names::KINEMATIC_CONSTRAINTS,
                   "Orientation constraint for link '%s' is probably incorrect: %f, %f, %f, %f. Assuming identity instead.",
                   oc.link_name.c_str(), oc.orientation.x, oc.orientation.y, oc.orientation.z, oc.orientation.w);
    c.orientation.setIdentity();
  }
  c.orientation.normalize();
  c.tolerance = motion::Vector3(std::abs(oc.absolute_x_axis_tolerance), std::abs(oc.absolute_y_axis_tolerance),
                                std::abs(oc.absolute_z_axis_tolerance));
  c.rotation_vector = oc.parameterization == moveit_msgs::OrientationConstraint::ROTATION_VECTOR;
  c.weight = constraint_weight_;
  motion::Constraints constraints;
  constraints.orientation.push_back(c);
  return make(constraints, &tf);
}

const moveit::core::LinkModel* OrientationConstraint::getLinkModel() const
{
  return enabled() ? robot_model_->getLinkModel(message_.link_name) : nullptr;
}

bool OrientationConstraint::mobileReferenceFrame() const { return enabled() && core_->orientations[0].frame.link >= 0; }

Eigen::Matrix3d OrientationConstraint::getDesiredRotationMatrix() const
{
  if (!enabled())
    return Eigen::Matrix3d::Identity();
  const auto& orientation = core_->orientations[0];
  return mobileReferenceFrame() ? orientation.wanted : Eigen::Matrix3d(orientation.frame.pose.linear() * orientation.wanted);
}

Eigen::Matrix3d OrientationConstraint::getDesiredRotationMatrixInRefFrame() const
{
  return enabled() ? core_->orientations[0].wanted : Eigen::Matrix3d::Identity();
}

bool OrientationConstraint::equal(const KinematicConstraint& other, double margin) const
{
  if (other.getType() != type_)
    return false;
  const moveit_msgs::OrientationConstraint& o = static_cast<const OrientationConstraint&>(other).message_;
  return o.link_name == message_.link_name &&
         moveit::core::Transforms::sameFrame(o.header.frame_id, message_.header.frame_id) &&
         quaternion(o.orientation).angularDistance(quaternion(message_.orientation)) <= margin &&
         near(o.absolute_x_axis_tolerance, message_.absolute_x_axis_tolerance, margin) &&
         near(o.absolute_y_axis_tolerance, message_.absolute_y_axis_tolerance, margin) &&
         near(o.absolute_z_axis_tolerance, message_.absolute_z_axis_tolerance, margin);
}

void OrientationConstraint::print(std::ostream& out) const
{
  out << "Orientation constraint on link '" << message_.link_name << "'\nDesired orientation: " << message_.orientation.x << ' '
      << message_.orientation.y << ' ' << message_.orientation.z << ' ' << message_.orientation.w << '\n';
}

// ---------------------------------------------------------------- position

bool PositionConstraint::configure(const moveit_msgs::PositionConstraint& pc, const moveit::core::Transforms& tf)
{
  message_ = pc;
  constraint_weight_ = pc.weight > std::numeric_limits<double>::epsilon() ? pc.weight : 1.0;
  motion::PositionConstraint c;
  c.link = pc.link_name;
  c.frame = frames::withoutSlash(pc.header.frame_id);
  c.offset = motion::Vector3(pc.target_point_offset.x, pc.target_point_offset.y, pc.target_point_offset.z);
  c.weight = constraint_weight_;
  moveit_msgs::CollisionObject region;
  region.id = "position constraint of link '" + pc.link_name + "'";
  const auto pairs = [&pc](const auto& shapes, const auto& poses, auto& to_shapes, auto& to_poses) {
    const std::size_t both = std::min(shapes.size(), poses.size());
    if (shapes.size() > both)
      ROS_WARN_NAMED(
          log_names::KINEMATIC_CONSTRAINTS,
          "Position constraint for link '%s': its region has %zu shapes and poses for %zu of them; the others are left out",
          pc.link_name.c_str(), shapes.size(), both);
    to_shapes.assign(shapes.begin(), shapes.begin() + both), to_poses.assign(poses.begin(), poses.begin() + both);
  };
  pairs(pc.constraint_region.primitives, pc.constraint_region.primitive_poses, region.primitives, region.primitive_poses);
  pairs(pc.constraint_region.meshes, pc.constraint_region.mesh_poses, region.meshes, region.mesh_poses);
  region.pose.orientation.w = 1;  // set: shapes keep their own poses
  moveit::core::ObjectParts parts;
  if (!moveit::core::readObject(region, parts) || parts.shapes.empty())
  {
    clear();
    ROS_ERROR_NAMED(log_names::KINEMATIC_CONSTRAINTS, "Position constraint for link '%s' has no region", pc.link_name.c_str());
    return false;
  }
  try
  {
    for (const shapes::ShapeConstPtr& shape : parts.shapes)
      c.shapes.push_back(moveit::core::fromShape(shape));
  }
  catch (const motion::Error& error)
  {
    clear();
    ROS_ERROR_NAMED(log_names::KINEMATIC_CONSTRAINTS, "Position constraint for link '%s': %s", pc.link_name.c_str(),
                    error.what());
    return false;
  }
  c.poses.assign(parts.shape_poses.begin(), parts.shape_poses.end());
  motion::Constraints constraints;
  constraints.position.push_back(c);
  constraint_region_.clear();
  if (!make(constraints, &tf))
    return false;
  for (std::size_t i = 0; i < parts.shapes.size(); ++i)
    if (const bodies::BodyPtr body{ bodies::createBodyFromShape(parts.shapes[i].get()) })
    {
      body->setPose(mobileReferenceFrame() ? parts.shape_poses[i]
                                           : Eigen::Isometry3d(core_->positions[0].frame.pose * parts.shape_poses[i]));
      constraint_region_.push_back(body);
    }
  return true;
}

const moveit::core::LinkModel* PositionConstraint::getLinkModel() const
{
  return enabled() ? robot_model_->getLinkModel(message_.link_name) : nullptr;
}

Eigen::Vector3d PositionConstraint::getLinkOffset() const
{
  return Eigen::Vector3d(message_.target_point_offset.x, message_.target_point_offset.y, message_.target_point_offset.z);
}

bool PositionConstraint::hasLinkOffset() const { return enabled() && getLinkOffset().squaredNorm() > 0.0; }

bool PositionConstraint::mobileReferenceFrame() const { return enabled() && core_->positions[0].frame.link >= 0; }

bool PositionConstraint::equal(const KinematicConstraint& other, double margin) const
{
  if (other.getType() != type_)
    return false;
  const auto& o = static_cast<const PositionConstraint&>(other);
  if (o.message_.link_name != message_.link_name || (o.getLinkOffset() - getLinkOffset()).norm() > margin ||
      !moveit::core::Transforms::sameFrame(o.message_.header.frame_id, message_.header.frame_id) || !enabled() ||
      !o.enabled() || o.core_->positions[0].poses.size() != core_->positions[0].poses.size())
    return false;
  for (std::size_t i = 0; i < core_->positions[0].poses.size(); ++i)
    if (core_->positions[0].shapes[i]->describe() != o.core_->positions[0].shapes[i]->describe() ||
        !core_->positions[0].poses[i].isApprox(o.core_->positions[0].poses[i], margin))
      return false;
  return true;
}

void PositionConstraint::print(std::ostream& out) const
{
  out << "Position constraint on link '" << message_.link_name << "' in frame '" << message_.header.frame_id << "'\n";
}

// ---------------------------------------------------------------- visibility

bool VisibilityConstraint::configure(const moveit_msgs::VisibilityConstraint& vc, const moveit::core::Transforms& tf)
{
  message_ = vc;
  constraint_weight_ = vc.weight > std::numeric_limits<double>::epsilon() ? vc.weight : 1.0;
  motion::VisibilityConstraint c;
  c.target_radius = vc.target_radius;
  c.target_pose = moveit::core::poseFromMessage(vc.target_pose.pose);
  c.sensor_pose = moveit::core::poseFromMessage(vc.sensor_pose.pose);
  c.target_frame = frames::withoutSlash(vc.target_pose.header.frame_id);
  c.sensor_frame = frames::withoutSlash(vc.sensor_pose.header.frame_id);
  c.cone_sides = vc.cone_sides;
  c.max_view_angle = vc.max_view_angle;
  c.max_range_angle = vc.max_range_angle;
  c.sensor_view = vc.sensor_view_direction == moveit_msgs::VisibilityConstraint::SENSOR_X   ? 'x'
                  : vc.sensor_view_direction == moveit_msgs::VisibilityConstraint::SENSOR_Y ? 'y'
                                                                                            : 'z';
  c.weight = constraint_weight_;
  motion::Constraints constraints;
  constraints.visibility.push_back(c);
  return make(constraints, &tf);
}

bool VisibilityConstraint::equal(const KinematicConstraint& other, double margin) const
{
  if (other.getType() != type_)
    return false;
  const moveit_msgs::VisibilityConstraint& o = static_cast<const VisibilityConstraint&>(other).message_;
  return o.target_pose.header.frame_id == message_.target_pose.header.frame_id &&
         o.sensor_pose.header.frame_id == message_.sensor_pose.header.frame_id &&
         moveit::core::poseFromMessage(o.target_pose.pose)
             .isApprox(moveit::core::poseFromMessage(message_.target_pose.pose), margin) &&
         moveit::core::poseFromMessage(o.sensor_pose.pose)
             .isApprox(moveit::core::poseFromMessage(message_.sensor_pose.pose), margin) &&
         near(o.target_radius, message_.target_radius, margin) && near(o.max_view_angle, message_.max_view_angle, margin);
}

// ---------------------------------------------------------------- all of them

void KinematicConstraintSet::clear()
{
  constraints_.clear();
  all_ = moveit_msgs::Constraints();
}

bool KinematicConstraintSet::add(const moveit_msgs::Constraints& c, const moveit::core::Transforms& tf)
{
  const bool joints = add(c.joint_constraints), positions = add(c.position_constraints, tf);
  const bool orientations = add(c.orientation_constraints, tf), sights = add(c.visibility_constraints, tf);
  return joints && positions && orientations && sights;
}

bool KinematicConstraintSet::add(const std::vector<moveit_msgs::JointConstraint>& jc)
{
  bool good = true;
  for (const auto& message : jc)
  {
    const auto constraint = std::make_shared<JointConstraint>(robot_model_);
    good = constraint->configure(message) && good;
    constraints_.push_back(constraint);
    all_.joint_constraints.push_back(message);
  }
  return good;
}

namespace
{
template <typename Constraint, typename Messages>
bool addAll(const Messages& messages, const moveit::core::Transforms& tf, const moveit::core::RobotModelConstPtr& model,
            std::vector<KinematicConstraintPtr>& into, Messages& all)
{
  bool good = true;
  for (const auto& message : messages)
  {
    const auto constraint = std::make_shared<Constraint>(model);
    good = constraint->configure(message, tf) && good;
    into.push_back(constraint);
    all.push_back(message);
  }
  return good;
}
}  // namespace

bool KinematicConstraintSet::add(const std::vector<moveit_msgs::PositionConstraint>& pc, const moveit::core::Transforms& tf)
{
  return addAll<PositionConstraint>(pc, tf, robot_model_, constraints_, all_.position_constraints);
}

bool KinematicConstraintSet::add(const std::vector<moveit_msgs::OrientationConstraint>& oc, const moveit::core::Transforms& tf)
{
  return addAll<OrientationConstraint>(oc, tf, robot_model_, constraints_, all_.orientation_constraints);
}

bool KinematicConstraintSet::add(const std::vector<moveit_msgs::VisibilityConstraint>& vc, const moveit::core::Transforms& tf)
{
  return addAll<VisibilityConstraint>(vc, tf, robot_model_, constraints_, all_.visibility_constraints);
}

ConstraintEvaluationResult KinematicConstraintSet::decide(const moveit::core::RobotState& state, bool verbose) const
{
  std::vector<ConstraintEvaluationResult> results;
  return decide(state, results, verbose);
}

ConstraintEvaluationResult KinematicConstraintSet::decide(const moveit::core::RobotState& state,
                                                          std::vector<ConstraintEvaluationResult>& results, bool verbose) const
{
  ConstraintEvaluationResult all(true, 0.0);
  results.clear();
  for (const KinematicConstraintPtr& constraint : constraints_)
  {
    results.push_back(constraint->decide(state, verbose));
    all.satisfied = all.satisfied && results.back().satisfied;
    all.distance += results.back().distance;
  }
  return all;
}

motion::Constraints KinematicConstraintSet::given() const
{
  motion::Constraints all;
  for (const KinematicConstraintPtr& constraint : constraints_)
    if (const auto one = constraint->given())
    {
      all.joint.insert(all.joint.end(), one->joint.begin(), one->joint.end());
      all.position.insert(all.position.end(), one->position.begin(), one->position.end());
      all.orientation.insert(all.orientation.end(), one->orientation.begin(), one->orientation.end());
      all.visibility.insert(all.visibility.end(), one->visibility.begin(), one->visibility.end());
    }
  return all;
}

bool KinematicConstraintSet::equal(const KinematicConstraintSet& other, double margin) const
{
  const auto within = [margin](const KinematicConstraintSet& a, const KinematicConstraintSet& b) {
    return std::all_of(a.constraints_.begin(), a.constraints_.end(), [&](const KinematicConstraintPtr& one) {
      return std::any_of(b.constraints_.begin(), b.constraints_.end(),
                         [&](const KinematicConstraintPtr& two) { return one->equal(*two, margin); });
    });
  };
  return within(*this, other) && within(other, *this);
}

void KinematicConstraintSet::print(std::ostream& out) const
{
  out << constraints_.size() << " kinematic constraints\n";
  for (const KinematicConstraintPtr& constraint : constraints_)
    constraint->print(out);
}
}  // namespace kinematic_constraints
