// What goals and paths may demand: of joints, of a link's position and orientation, of what a sensor sees.
#pragma once

#include <string>
#include <vector>

#include "motion/planning_scene.hpp"

namespace motion
{
struct JointConstraint
{
  std::string joint;  // or a variable of a joint with several
  double position = 0, above = 0, below = 0, weight = 1;
};

struct PositionConstraint
{
  std::string link, frame;           // frame "" is the model frame
  Vector3 offset = Vector3::Zero();  // of the point in the link
  std::vector<ShapePtr> shapes;
  std::vector<Transform> poses;  // in the frame
  double weight = 1;
};

struct OrientationConstraint
{
  std::string link, frame;
  Quaternion orientation = Quaternion::Identity();
  Vector3 tolerance = Vector3::Zero();  // rad
  bool rotation_vector = false;         // else intrinsic X-Y-Z angles
  double weight = 1;
};

struct VisibilityConstraint
{
  double target_radius = 0;
  Transform target_pose = Transform::Identity(), sensor_pose = Transform::Identity();
  std::string target_frame, sensor_frame;
  int cone_sides = 4;
  double max_view_angle = 0, max_range_angle = 0;  // rad, 0 = any
  char sensor_view = 'z';
  double weight = 1;
};

struct Constraints
{
  std::string name;
  std::vector<JointConstraint> joint;
  std::vector<PositionConstraint> position;
  std::vector<OrientationConstraint> orientation;
  std::vector<VisibilityConstraint> visibility;

  bool empty() const { return joint.empty() && position.empty() && orientation.empty() && visibility.empty(); }
};

struct ConstraintResult
{
  bool satisfied = true;
  double distance = 0;  // rad or m from what is wanted
  std::string description;
};

// Constraints looked up in a robot and its scene. Reads only; for any number of threads, each with a state of its own.
class ConstraintSet
{
public:
  // Throws UnknownName and InvalidInput. Frames of objects are taken where they are now.
  ConstraintSet(const PlanningScene& scene, const Constraints& constraints);

  struct Frame
  {
    int link = -1;                           // -1: does not move
    Transform pose = Transform::Identity();  // in the link or in the model frame
    Transform at(const RobotState& state) const { return link < 0 ? pose : state.linkPose(link) * pose; }
  };
  struct Joint
  {
    int variable;
    bool continuous;
    double position, above, below;
  };
  struct Position
  {
    Frame link, frame;  // the link's includes the offset
    Vector3 offset;
    std::vector<ShapePtr> shapes;
    std::vector<Transform> poses;
    std::string name;
  };
  struct Orientation
  {
    Frame link, frame;
    Eigen::Matrix3d wanted;
    Vector3 tolerance;
    bool rotation_vector;
    std::string name;
  };
  std::vector<Joint> joints;
  std::vector<Position> positions;
  std::vector<Orientation> orientations;

  bool empty() const { return joints.empty() && positions.empty() && orientations.empty() && sights_.empty(); }
  bool satisfied(const RobotState& state) const;
  std::vector<ConstraintResult> evaluate(const RobotState& state) const;
  // The first constraint that is broken, for the user; "" if none is.
  std::string problem(const RobotState& state) const;
  // Can `project` do something about them (all but visibility)?
  bool projectable() const { return !positions.empty() || !orientations.empty() || !joints.empty(); }

  // Moves the group's joints as little as it can until positions, orientations and joints are within their tolerances.
  bool project(RobotState& state, const JointModelGroup& group, int iterations = 40) const;

private:
  struct Sight
  {
    VisibilityConstraint given;
    Frame target, sensor;
  };
  ConstraintResult check(const RobotState& state, const Joint& c) const;
  ConstraintResult check(const RobotState& state, const Position& c) const;
  ConstraintResult check(const RobotState& state, const Orientation& c) const;
  ConstraintResult check(const RobotState& state, const Sight& c) const;
  Frame link(const PlanningScene& scene, const std::string& name, const std::string& of) const;
  Frame frame(const PlanningScene& scene, const std::string& name, const std::string& of) const;

  RobotModelPtr model_;
  std::vector<Sight> sights_;
};

// The rotation nearest to `actual` that the constraint allows, within `share` of its tolerances.
Eigen::Matrix3d nearestAllowed(const ConstraintSet::Orientation& c, const Eigen::Matrix3d& frame, const Eigen::Matrix3d& actual,
                               double share = 1.0);
}  // namespace motion
