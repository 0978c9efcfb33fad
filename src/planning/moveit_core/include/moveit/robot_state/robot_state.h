// Where a robot is: a value for each variable of its model, what it carries, and from these the pose of each link. Poses are
// computed when they are first asked for after a change, so update() before several threads read one state.
#pragma once

#include <geometry_msgs/Twist.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <cassert>
#include <memory>

#include <moveit/macros/deprecation.h>
#include <moveit/robot_model/robot_model.h>
#include <moveit/robot_state/attached_body.h>
#include <moveit/transforms/transforms.h>

// Rows of one-line functions, and the macros that make them, are read as tables.
// clang-format off

namespace moveit
{
namespace core
{
MOVEIT_CLASS_FORWARD(RobotState);

// Asked for each solution of inverse kinematics: will these values of the group do?
typedef boost::function<bool(RobotState* robot_state, const JointModelGroup* joint_group,
                             const double* joint_group_variable_values)>
    GroupStateValidityCallbackFn;

class RobotState
{
public:
  explicit RobotState(const RobotModelConstPtr& robot_model);
  ~RobotState();
  RobotState(const RobotState& other);
  RobotState& operator=(const RobotState& other);

  const RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  std::size_t getVariableCount() const { return robot_model_->getVariableCount(); }
  const std::vector<std::string>& getVariableNames() const { return robot_model_->getVariableNames(); }
  const LinkModel* getLinkModel(const std::string& link) const { return robot_model_->getLinkModel(link); }
  const JointModel* getJointModel(const std::string& joint) const { return robot_model_->getJointModel(joint); }
  const JointModelGroup* getJointModelGroup(const std::string& group) const
  {
    return robot_model_->getJointModelGroup(group);
  }

  // ------------------------------------------------------------ positions of variables
  double* getVariablePositions();  // to write to; mimic joints are the caller's then
  const double* getVariablePositions() const;
  void setVariablePositions(const double* position);
  void setVariablePositions(const std::vector<double>& position);
  void setVariablePositions(const std::map<std::string, double>& variable_map);
  void setVariablePositions(const std::map<std::string, double>& variable_map, std::vector<std::string>& missing_variables);
  void setVariablePositions(const std::vector<std::string>& variable_names, const std::vector<double>& variable_position);
  void setVariablePosition(const std::string& variable, double value)
  {
    setVariablePosition(robot_model_->getVariableIndex(variable), value);
  }
  void setVariablePosition(int index, double value);
  double getVariablePosition(const std::string& variable) const
  {
    return getVariablePositions()[robot_model_->getVariableIndex(variable)];
  }
  double getVariablePosition(int index) const { return getVariablePositions()[index]; }

  // ------------------------------------------------------------ velocities, accelerations, efforts: there or not
#define MOVEIT_STATE_DERIVATIVE(KIND, Plural, Singular)                                                                \
  bool has##Plural() const { return !values(KIND).empty(); }                                                           \
  double* getVariable##Plural() { return made(KIND).data(); }                                                          \
  const double* getVariable##Plural() const { return read(KIND); }                                                     \
  void zero##Plural() { values(KIND).assign(getVariableCount(), 0.0); }                                                \
  void drop##Plural() { values(KIND).clear(); }                                                                        \
  void setVariable##Plural(const double* all) { values(KIND).assign(all, all + getVariableCount()); }                  \
  void setVariable##Plural(const std::vector<double>& all) { setVariable##Plural(all.data()); }                        \
  void setVariable##Plural(const std::map<std::string, double>& variable_map)                                          \
  {                                                                                                                    \
    for (const auto& item : variable_map)                                                                              \
      made(KIND)[robot_model_->getVariableIndex(item.first)] = item.second;                                            \
  }                                                                                                                    \
  void setVariable##Plural(const std::map<std::string, double>& variable_map,                                          \
                           std::vector<std::string>& missing_variables)                                                \
  {                                                                                                                    \
    missing(variable_map, missing_variables);                                                                          \
    setVariable##Plural(variable_map);                                                                                 \
  }                                                                                                                    \
  void setVariable##Plural(const std::vector<std::string>& variable_names, const std::vector<double>& some)            \
  {                                                                                                                    \
    for (std::size_t i = 0; i < variable_names.size() && i < some.size(); ++i)                                         \
      made(KIND)[robot_model_->getVariableIndex(variable_names[i])] = some[i];                                         \
  }                                                                                                                    \
  void setVariable##Singular(const std::string& variable, double value)                                                \
  {                                                                                                                    \
    made(KIND)[robot_model_->getVariableIndex(variable)] = value;                                                      \
  }                                                                                                                    \
  void setVariable##Singular(int index, double value) { made(KIND)[index] = value; }                                   \
  double getVariable##Singular(const std::string& variable) const                                                      \
  {                                                                                                                    \
    return read(KIND)[robot_model_->getVariableIndex(variable)];                                                       \
  }                                                                                                                    \
  double getVariable##Singular(int index) const { return read(KIND)[index]; }
  MOVEIT_STATE_DERIVATIVE(VELOCITY, Velocities, Velocity)
  MOVEIT_STATE_DERIVATIVE(ACCELERATION, Accelerations, Acceleration)
  MOVEIT_STATE_DERIVATIVE(EFFORT, Effort, Effort)
#undef MOVEIT_STATE_DERIVATIVE
  void dropDynamics();
  void invertVelocity();  // the same way back

  // ------------------------------------------------------------ one joint
  void setJointPositions(const std::string& joint_name, const double* position)
  {
    setJointPositions(robot_model_->getJointModel(joint_name), position);
  }
  void setJointPositions(const std::string& joint_name, const std::vector<double>& position)
  {
    setJointPositions(robot_model_->getJointModel(joint_name), position.data());
  }
  void setJointPositions(const JointModel* joint, const std::vector<double>& position)
  {
    setJointPositions(joint, position.data());
  }
  void setJointPositions(const JointModel* joint, const double* position);
  void setJointPositions(const std::string& joint_name, const Eigen::Isometry3d& transform)
  {
    setJointPositions(robot_model_->getJointModel(joint_name), transform);
  }
  void setJointPositions(const JointModel* joint, const Eigen::Isometry3d& transform);
  void setJointVelocities(const JointModel* joint, const double* velocity);
  void setJointEfforts(const JointModel* joint, const double* effort);
  const double* getJointPositions(const std::string& joint_name) const
  {
    return getJointPositions(robot_model_->getJointModel(joint_name));
  }
  const double* getJointPositions(const JointModel* joint) const
  {
    return getVariablePositions() + joint->getFirstVariableIndex();
  }
  const double* getJointVelocities(const std::string& joint_name) const
  {
    return getJointVelocities(robot_model_->getJointModel(joint_name));
  }
  const double* getJointVelocities(const JointModel* joint) const
  {
    return read(VELOCITY) + joint->getFirstVariableIndex();
  }
  const double* getJointAccelerations(const std::string& joint_name) const
  {
    return getJointAccelerations(robot_model_->getJointModel(joint_name));
  }
  const double* getJointAccelerations(const JointModel* joint) const
  {
    return read(ACCELERATION) + joint->getFirstVariableIndex();
  }
  const double* getJointEffort(const std::string& joint_name) const
  {
    return getJointEffort(robot_model_->getJointModel(joint_name));
  }
  const double* getJointEffort(const JointModel* joint) const { return read(EFFORT) + joint->getFirstVariableIndex(); }

  // ------------------------------------------------------------ a group, in the order of its variables
  // A group by its name or pointer; values by pointer or in a vector of the right size, else moveit::Exception.
#define MOVEIT_STATE_GROUP(What)                                                                                       \
  void setJointGroup##What(const JointModelGroup* group, const double* gstate);                                        \
  void setJointGroup##What(const JointModelGroup* group, const std::vector<double>& gstate)                            \
  {                                                                                                                    \
    setJointGroup##What(group, sized(group, gstate.data(), gstate.size()));                                            \
  }                                                                                                                    \
  void setJointGroup##What(const JointModelGroup* group, const Eigen::VectorXd& gstate)                                \
  {                                                                                                                    \
    setJointGroup##What(group, sized(group, gstate.data(), gstate.size()));                                            \
  }                                                                                                                    \
  void setJointGroup##What(const std::string& joint_group_name, const std::vector<double>& gstate)                     \
  {                                                                                                                    \
    if (const JointModelGroup* group = robot_model_->getJointModelGroup(joint_group_name))                             \
      setJointGroup##What(group, gstate);                                                                              \
  }                                                                                                                    \
  template <typename Values>                                                                                           \
  void setJointGroup##What(const std::string& joint_group_name, const Values& gstate)                                  \
  {                                                                                                                    \
    if (const JointModelGroup* group = robot_model_->getJointModelGroup(joint_group_name))                             \
      setJointGroup##What(group, gstate);                                                                              \
  }                                                                                                                    \
  void copyJointGroup##What(const JointModelGroup* group, double* gstate) const;                                       \
  void copyJointGroup##What(const JointModelGroup* group, std::vector<double>& gstate) const                           \
  {                                                                                                                    \
    gstate.resize(group->getVariableCount());                                                                          \
    copyJointGroup##What(group, gstate.data());                                                                        \
  }                                                                                                                    \
  void copyJointGroup##What(const JointModelGroup* group, Eigen::VectorXd& gstate) const                               \
  {                                                                                                                    \
    gstate.resize(group->getVariableCount());                                                                          \
    copyJointGroup##What(group, gstate.data());                                                                        \
  }                                                                                                                    \
  void copyJointGroup##What(const std::string& joint_group_name, double* gstate) const                                 \
  {                                                                                                                    \
    if (const JointModelGroup* group = robot_model_->getJointModelGroup(joint_group_name))                             \
      copyJointGroup##What(group, gstate);                                                                             \
  }                                                                                                                    \
  template <typename Values>                                                                                           \
  void copyJointGroup##What(const std::string& joint_group_name, Values& gstate) const                                 \
  {                                                                                                                    \
    if (const JointModelGroup* group = robot_model_->getJointModelGroup(joint_group_name))                             \
      copyJointGroup##What(group, gstate);                                                                             \
  }
  MOVEIT_STATE_GROUP(Positions)
  MOVEIT_STATE_GROUP(Velocities)
  MOVEIT_STATE_GROUP(Accelerations)
#undef MOVEIT_STATE_GROUP
  // Of the active joints alone; mimic joints follow.
  void setJointGroupActivePositions(const JointModelGroup* group, const std::vector<double>& gstate);
  void setJointGroupActivePositions(const JointModelGroup* group, const Eigen::VectorXd& values);
  template <typename Values>
  void setJointGroupActivePositions(const std::string& joint_group_name, const Values& gstate)
  {
    if (const JointModelGroup* group = robot_model_->getJointModelGroup(joint_group_name))
      setJointGroupActivePositions(group, gstate);
  }

  void setVariableValues(const sensor_msgs::JointState& msg);
  void setToDefaultValues();
  // A state of the SRDF.
  bool setToDefaultValues(const JointModelGroup* group, const std::string& name);
  bool setToDefaultValues(const std::string& group_name, const std::string& state_name);
  void setToRandomPositions();
  void setToRandomPositions(random_numbers::RandomNumberGenerator& rng);
  void setToRandomPositions(const JointModelGroup* group);
  void setToRandomPositions(const JointModelGroup* group, random_numbers::RandomNumberGenerator& rng);
  void setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed, double distance);
  void setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed, double distance,
                                  random_numbers::RandomNumberGenerator& rng);
  // A distance for each active joint.
  void setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed,
                                  const std::vector<double>& distances);
  void setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed,
                                  const std::vector<double>& distances, random_numbers::RandomNumberGenerator& rng);
  random_numbers::RandomNumberGenerator& getRandomNumberGenerator();

  // ------------------------------------------------------------ inverse kinematics, by the group's solver
  // `pose` is that of the tip in the model frame; timeout in s, 0 is the solver's own.
  bool setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, double timeout = 0.0,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  bool setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, const std::string& tip,
                 double timeout = 0.0, const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, double timeout = 0.0,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, const std::string& tip,
                 double timeout = 0.0, const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, const std::string& tip,
                 const std::vector<double>& consistency_limits, double timeout = 0.0,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  bool setFromIK(const JointModelGroup* group, const EigenSTL::vector_Isometry3d& poses,
                 const std::vector<std::string>& tips, double timeout = 0.0,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  bool setFromIK(const JointModelGroup* group, const EigenSTL::vector_Isometry3d& poses,
                 const std::vector<std::string>& tips, const std::vector<std::vector<double>>& consistency_limits,
                 double timeout = 0.0, const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  // As programs of Kinetic call it, with a number of attempts, which counts for nothing.
  template <typename Pose>
  bool setFromIK(const JointModelGroup* group, const Pose& pose, unsigned int /*attempts*/, double timeout,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions())
  {
    return setFromIK(group, pose, timeout, constraint, options);
  }
  template <typename Pose, typename Tip>
  bool setFromIK(const JointModelGroup* group, const Pose& pose, const Tip& tip, unsigned int /*attempts*/, double timeout,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                 const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions())
  {
    return setFromIK(group, pose, tip, timeout, constraint, options);
  }
  // Of a group whose subgroups have the solvers.
  bool setFromIKSubgroups(const JointModelGroup* group, const EigenSTL::vector_Isometry3d& poses,
                          const std::vector<std::string>& tips,
                          const std::vector<std::vector<double>>& consistency_limits, double timeout = 0.0,
                          const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn(),
                          const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  // Moves the tip for dt s with a twist (v, w) in the tip's frame.
  bool setFromDiffIK(const JointModelGroup* group, const Eigen::VectorXd& twist, const std::string& tip, double dt,
                     const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());
  bool setFromDiffIK(const JointModelGroup* group, const geometry_msgs::Twist& twist, const std::string& tip, double dt,
                     const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());
  // A pose in the model frame becomes one in the frame of the solver's base.
  bool setToIKSolverFrame(Eigen::Isometry3d& pose, const kinematics::KinematicsBaseConstPtr& solver);
  bool setToIKSolverFrame(Eigen::Isometry3d& pose, const std::string& ik_frame);

  // As CartesianInterpolator, which replaces it.
  double computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& traj, const LinkModel* link,
                              const Eigen::Vector3d& direction, bool global_reference_frame, double distance,
                              double max_step, double jump_threshold_factor,
                              const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                              const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  double computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& traj, const LinkModel* link,
                              const Eigen::Isometry3d& target, bool global_reference_frame, double max_step,
                              double jump_threshold_factor,
                              const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                              const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  double computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& traj, const LinkModel* link,
                              const EigenSTL::vector_Isometry3d& waypoints, bool global_reference_frame, double max_step,
                              double jump_threshold_factor,
                              const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                              const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());

  // Of a chain: rows v, w (or v and the change of the quaternion w, x, y, z) at a point of the link, in the frame of the
  // group's base link; a column for each variable of the group (those of mimic joints are in their leaders').
  bool getJacobian(const JointModelGroup* group, const LinkModel* link, const Eigen::Vector3d& reference_point_position,
                   Eigen::MatrixXd& jacobian, bool use_quaternion_representation = false) const;
  Eigen::MatrixXd getJacobian(const JointModelGroup* group,
                              const Eigen::Vector3d& reference_point_position = Eigen::Vector3d(0.0, 0.0, 0.0)) const;
  // Velocities of the group that give the tip a twist in its own frame.
  void computeVariableVelocity(const JointModelGroup* jmg, Eigen::VectorXd& qdot, const Eigen::VectorXd& twist,
                               const LinkModel* tip) const;
  bool integrateVariableVelocity(const JointModelGroup* jmg, const Eigen::VectorXd& qdot, double dt,
                                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());

  // ------------------------------------------------------------ poses, in the model frame
  void updateCollisionBodyTransforms() { update(); }
  void updateLinkTransforms() { update(); }
  void update(bool force = false);
  // The link goes to a pose, all that it carries with it (`backward`: the whole robot). Until the next change.
  void updateStateWithLinkAt(const std::string& link_name, const Eigen::Isometry3d& transform, bool backward = false)
  {
    updateStateWithLinkAt(robot_model_->getLinkModel(link_name), transform, backward);
  }
  void updateStateWithLinkAt(const LinkModel* link, const Eigen::Isometry3d& transform, bool backward = false);
  const LinkModel* getRigidlyConnectedParentLinkModel(const std::string& frame, Eigen::Isometry3d* transform = nullptr,
                                                      const JointModelGroup* jmg = nullptr) const;
  const Eigen::Isometry3d& getGlobalLinkTransform(const std::string& link_name) const
  {
    return getGlobalLinkTransform(robot_model_->getLinkModel(link_name));
  }
  const Eigen::Isometry3d& getGlobalLinkTransform(const LinkModel* link) const;  // of null: moveit::Exception
  const Eigen::Isometry3d& getCollisionBodyTransform(const std::string& link_name, std::size_t index) const
  {
    return getCollisionBodyTransform(robot_model_->getLinkModel(link_name), index);
  }
  const Eigen::Isometry3d& getCollisionBodyTransform(const LinkModel* link, std::size_t index) const;
  const Eigen::Isometry3d& getJointTransform(const std::string& joint_name) const
  {
    return getJointTransform(robot_model_->getJointModel(joint_name));
  }
  const Eigen::Isometry3d& getJointTransform(const JointModel* joint) const;
  // Nothing is ever out of date.
  bool dirtyJointTransform(const JointModel* /*joint*/) const { return false; }
  bool dirtyLinkTransforms() const { return false; }
  bool dirtyCollisionBodyTransforms() const { return false; }
  bool dirty() const { return false; }

  // A link, an attached body or its subframe. The identity when there is none: *frame_found says so, else the log does.
  const Eigen::Isometry3d& getFrameTransform(const std::string& frame_id, bool* frame_found = nullptr) const;
  // Also the link that moves the frame.
  const Eigen::Isometry3d& getFrameInfo(const std::string& frame_id, const LinkModel*& robot_link, bool& frame_found) const;
  bool knowsFrameTransform(const std::string& frame_id) const;

  // ------------------------------------------------------------ distance, bounds
  double distance(const RobotState& other) const;
  double distance(const RobotState& other, const JointModelGroup* joint_group) const;
  double distance(const RobotState& other, const JointModel* joint) const;
  void interpolate(const RobotState& to, double t, RobotState& state) const;
  void interpolate(const RobotState& to, double t, RobotState& state, const JointModelGroup* joint_group) const;
  void interpolate(const RobotState& to, double t, RobotState& state, const JointModel* joint) const;
  void enforceBounds();
  void enforceBounds(const JointModelGroup* joint_group);
  void enforceBounds(const JointModel* joint);
  void enforcePositionBounds(const JointModel* joint);
  void enforceVelocityBounds(const JointModel* joint);
  void harmonizePositions();
  void harmonizePositions(const JointModelGroup* joint_group);
  void harmonizePosition(const JointModel* joint);
  bool satisfiesBounds(double margin = 0.0) const;
  bool satisfiesBounds(const JointModelGroup* joint_group, double margin = 0.0) const;
  bool satisfiesBounds(const JointModel* joint, double margin = 0.0) const;
  bool satisfiesPositionBounds(const JointModel* joint, double margin = 0.0) const
  {
    return joint->satisfiesPositionBounds(getJointPositions(joint), margin);
  }
  bool satisfiesVelocityBounds(const JointModel* joint, double margin = 0.0) const
  {
    return joint->satisfiesVelocityBounds(getJointVelocities(joint), margin);
  }
  std::pair<double, const JointModel*> getMinDistanceToPositionBounds() const;
  std::pair<double, const JointModel*> getMinDistanceToPositionBounds(const JointModelGroup* group) const;
  std::pair<double, const JointModel*> getMinDistanceToPositionBounds(const std::vector<const JointModel*>& joints) const;
  bool isValidVelocityMove(const RobotState& other, const JointModelGroup* group, double dt) const;

  // ------------------------------------------------------------ what it carries
  void attachBody(std::unique_ptr<AttachedBody> attached_body);
  void attachBody(AttachedBody* attached_body) { attachBody(std::unique_ptr<AttachedBody>(attached_body)); }
  void attachBody(const std::string& id, const Eigen::Isometry3d& pose, const std::vector<shapes::ShapeConstPtr>& shapes,
                  const EigenSTL::vector_Isometry3d& shape_poses, const std::set<std::string>& touch_links,
                  const std::string& link_name,
                  const trajectory_msgs::JointTrajectory& detach_posture = trajectory_msgs::JointTrajectory(),
                  const FixedTransformsMap& subframe_poses = FixedTransformsMap());
  void attachBody(const std::string& id, const Eigen::Isometry3d& pose, const std::vector<shapes::ShapeConstPtr>& shapes,
                  const EigenSTL::vector_Isometry3d& shape_poses, const std::vector<std::string>& touch_links,
                  const std::string& link_name,
                  const trajectory_msgs::JointTrajectory& detach_posture = trajectory_msgs::JointTrajectory(),
                  const FixedTransformsMap& subframe_poses = FixedTransformsMap())
  {
    attachBody(id, pose, shapes, shape_poses, std::set<std::string>(touch_links.begin(), touch_links.end()), link_name,
               detach_posture, subframe_poses);
  }
  void getAttachedBodies(std::vector<const AttachedBody*>& attached_bodies) const;
  void getAttachedBodies(std::vector<const AttachedBody*>& attached_bodies, const JointModelGroup* group) const;
  void getAttachedBodies(std::vector<const AttachedBody*>& attached_bodies, const LinkModel* link_model) const;
  bool clearAttachedBody(const std::string& id);
  void clearAttachedBodies(const LinkModel* link);
  void clearAttachedBodies(const JointModelGroup* group);
  void clearAttachedBodies();
  const AttachedBody* getAttachedBody(const std::string& name) const;
  bool hasAttachedBody(const std::string& id) const { return bodies_.count(id) > 0; }
  void setAttachedBodyUpdateCallback(const AttachedBodyCallback& callback) { attached_body_update_callback_ = callback; }

  // ------------------------------------------------------------ looking at it
  // x, x, y, y, z, z of the box around all.
  void computeAABB(std::vector<double>& aabb) const;
  void getRobotMarkers(visualization_msgs::MarkerArray& arr, const std::vector<std::string>& link_names,
                       const std_msgs::ColorRGBA& color, const std::string& ns, const ros::Duration& dur,
                       bool include_attached = false) const;
  void getRobotMarkers(visualization_msgs::MarkerArray& arr, const std::vector<std::string>& link_names,
                       bool include_attached = false) const;
  void printStatePositions(std::ostream& out = std::cout) const;
  void printStatePositionsWithJointLimits(const JointModelGroup* jmg, std::ostream& out = std::cout) const;
  void printStateInfo(std::ostream& out = std::cout) const;
  void printTransforms(std::ostream& out = std::cout) const;
  void printTransform(const Eigen::Isometry3d& transform, std::ostream& out = std::cout) const;
  void printDirtyInfo(std::ostream& out = std::cout) const;
  std::string getStateTreeString() const;

  // The state of the motion library that this one is; bodies are to be attached here, not there.
  const motion::RobotState& core() const { return *core_; }
  // What a state of the library holds, bodies too.
  void setCore(const motion::RobotState& core);

private:
  enum Kind
  {
    VELOCITY,
    ACCELERATION,
    EFFORT
  };
  std::vector<double>& values(Kind kind);
  const std::vector<double>& values(Kind kind) const { return const_cast<RobotState*>(this)->values(kind); }
  std::vector<double>& made(Kind kind);    // zeros if it was not there
  const double* read(Kind kind) const;     // zeros if it is not there
  void missing(const std::map<std::string, double>& variable_map, std::vector<std::string>& missing_variables) const;
  const double* sized(const JointModelGroup* group, const double* data, std::size_t size) const;
  void copyBodies(const RobotState& other);
  void follow();
  bool solve(const JointModelGroup* group, const JointModelGroup::KinematicsSolver& solver,
             const std::vector<geometry_msgs::Pose>& queries, const std::vector<double>& consistency, double timeout,
             const GroupStateValidityCallbackFn& constraint, const kinematics::KinematicsQueryOptions& options,
             const JointModelGroup* reported);
  bool queryFor(Eigen::Isometry3d pose, std::string tip, const kinematics::KinematicsBaseConstPtr& solver,
                std::size_t& which, geometry_msgs::Pose& query);

  RobotModelConstPtr robot_model_;
  std::unique_ptr<motion::RobotState> core_;
  std::map<std::string, std::unique_ptr<AttachedBody>> bodies_;
  AttachedBodyCallback attached_body_update_callback_;
  std::unique_ptr<random_numbers::RandomNumberGenerator> rng_;
  mutable EigenSTL::vector_Isometry3d joint_transforms_, collision_transforms_;
};

// Do both carry the same? With a prefix what differs is logged.
bool haveSameAttachedObjects(const RobotState& left, const RobotState& right, const std::string& logprefix = "");

std::ostream& operator<<(std::ostream& out, const RobotState& s);
}  // namespace core
}  // namespace moveit
