// A robot as it is described: joints, links, groups. Never changes after it is built, so threads share it freely.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "motion/shapes.hpp"
#include "motion/srdf.hpp"
#include "motion/types.hpp"

namespace urdf
{
class ModelInterface;
}

namespace motion
{
enum class JointType
{
  Fixed,
  Revolute,
  Prismatic,
  Planar,
  Floating
};

struct VariableBounds
{
  bool has_position = false, has_velocity = false, has_acceleration = false, has_jerk = false;
  double min_position = 0, max_position = 0;
  double max_velocity = 0, max_acceleration = 0, max_jerk = 0;
};

// One variable of joint_limits.yaml; what is not set there keeps the URDF's value.
struct LimitOverride
{
  std::optional<bool> has_velocity, has_acceleration, has_jerk;
  std::optional<double> min_position, max_position, max_velocity, max_acceleration, max_jerk;
};

struct JointModel
{
  std::string name;
  JointType type = JointType::Fixed;
  bool continuous = false;
  int index = 0;
  int parent_link = -1, child_link = -1;     // -1: the frame outside the robot
  Transform origin = Transform::Identity();  // of the joint in the parent link
  Vector3 axis = Vector3::UnitZ();
  int first_variable = 0, variable_count = 0;
  std::vector<std::string> variables;
  std::vector<VariableBounds> bounds;
  bool passive = false;
  int mimic = -1;  // index of the joint it follows
  double mimic_factor = 1, mimic_offset = 0;
  std::vector<int> mimicked_by;
  double distance_factor = 1;
  double angular_distance_weight = 1;
  bool diff_drive = false;
  double min_translational_distance = 1e-5;
  std::vector<int> descendant_links;  // all that move with it

  bool active() const { return type != JointType::Fixed && mimic < 0; }
  bool singleVariable() const { return variable_count == 1; }
  const char* typeName() const;
  // Transform from parent link to child link for this joint's variables.
  Transform transform(const double* values) const;
  // The values whose transform, less the joint's origin, comes nearest to `moved`.
  void valuesOf(const Transform& moved, double* values) const;
  double distance(const double* a, const double* b) const;
  double maximumExtent() const;
  void interpolate(const double* from, const double* to, double t, double* out) const;
  bool satisfiesBounds(const double* values, double margin) const;
  bool enforceBounds(double* values) const;
};

struct LinkModel
{
  std::string name;
  int index = 0, parent_joint = 0, parent_link = -1;
  std::vector<int> child_joints;
  std::vector<ShapePtr> shapes;
  std::vector<Transform> shape_origins;
  double mass = 0;
  bool hasGeometry() const { return !shapes.empty(); }
};

struct JointModelGroup
{
  std::string name;
  std::vector<int> joints, active_joints;  // model order
  std::vector<int> variables;              // model indices of the active joints' variables: the group array
  std::vector<std::string> variable_names;
  std::vector<int> links, updated_links;
  std::vector<char> link_updated;  // by link index
  std::vector<std::string> subgroups;
  std::vector<int> joint_roots;
  bool is_chain = false, single_variable_joints = true;
  int base_link = -1, tip_link = -1;
  std::vector<int> tips;
  std::vector<std::string> state_names;
  std::map<std::string, std::map<std::string, std::vector<double>>> states;
  std::string end_effector;
  std::vector<std::string> attached_end_effectors;

  std::size_t size() const { return variables.size(); }
  bool hasJoint(int joint) const;
};

class GroupSolver;  // ik.hpp

class RobotModel
{
public:
  using FindFile = std::function<std::string(const std::string& uri)>;  // "" when there is no such file

  struct Options
  {
    std::map<std::string, LimitOverride> limits;
    FindFile find_file;
    bool meshes = true;
  };

  // Throws ModelError. `srdf` may be empty: a robot without groups.
  static std::shared_ptr<const RobotModel> load(const std::string& urdf, const std::string& srdf, const Options& options);
  // The same of a URDF that is parsed already.
  static std::shared_ptr<RobotModel> load(const std::shared_ptr<urdf::ModelInterface>& urdf, const Srdf& srdf,
                                          const Options& options);
  // Other limits for a joint: before the model is shared.
  void setBounds(int joint, const std::vector<VariableBounds>& limits);
  // Somebody else's inverse kinematics for a group, in place of the library's: before the model is shared.
  void setSolver(const std::string& group, std::shared_ptr<const GroupSolver> solver);
  const GroupSolver* solver(const std::string& group) const;  // null: the library's

  std::string name, frame;
  std::vector<std::string> warnings;
  std::vector<JointModel> joints;  // depth first; 0 is the root joint
  std::vector<LinkModel> links;    // depth first; 0 is the root link
  std::vector<JointModelGroup> groups;
  std::vector<std::string> variables;
  std::vector<VariableBounds> bounds;  // by variable
  std::vector<int> variable_joint;     // by variable
  std::vector<double> defaults;
  Srdf srdf;

  const JointModel& joint(const std::string& name) const;
  const LinkModel& link(const std::string& name) const;
  const JointModelGroup& group(const std::string& name) const;
  int variable(const std::string& name) const;
  const JointModel* findJoint(const std::string& name) const;
  const LinkModel* findLink(const std::string& name) const;
  const JointModelGroup* findGroup(const std::string& name) const;
  int findVariable(const std::string& name) const;  // -1

  // The topmost link that `link` is bolted to by fixed joints alone, and the pose of `link` in it.
  int rigidParent(int link, Transform& pose) const;
  // Is `ancestor` on the way from `link` to the root (or the same)?
  bool isAncestor(int ancestor, int link) const;

  std::vector<std::string> jointNames() const;
  std::vector<std::string> linkNames() const;
  std::vector<std::string> groupNames() const;

private:
  friend class ModelBuilder;
  std::map<std::string, std::shared_ptr<const GroupSolver>> solvers_;
  std::unordered_map<std::string, int> joint_index_, link_index_, group_index_, variable_index_;
};
using RobotModelPtr = std::shared_ptr<const RobotModel>;
}  // namespace motion
