// A link along straight lines, step by step with inverse kinematics. Answers are the share of the way that was reached.
#pragma once

#include <moveit/robot_state/robot_state.h>

namespace moveit
{
namespace core
{
// How far the link may be off the line half-way between two states, when all joints go evenly from one to the other.
struct CartesianPrecision
{
  double translational = 0.001;  // m
  double rotational = 0.01;      // rad
  double max_resolution = 1e-5;  // the shortest step that is tried, as a share of the way
};

// How far joints may jump between two steps; 0: any. `factor` is times the mean step, the others are rad and m.
struct JumpThreshold
{
  double factor = 0.0, revolute = 0.0, prismatic = 0.0;

  explicit JumpThreshold() {}
  explicit JumpThreshold(double jt_factor) : factor(jt_factor) {}
  explicit JumpThreshold(double jt_revolute, double jt_prismatic) : revolute(jt_revolute), prismatic(jt_prismatic) {}
};

// The longest step, in m and rad.
struct MaxEEFStep
{
  MaxEEFStep(double translation, double rotation) : translation(translation), rotation(rotation) {}
  MaxEEFStep(double step_size) : translation(step_size), rotation(3.5 * step_size) {}
  double translation, rotation;
};

class CartesianInterpolator
{
public:
  // ------------------------------------------------------------ with a precision: steps are halved until they are near the line
  // By a translation; the answer is the distance reached, in m.
  static double computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                     std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                     const Eigen::Vector3d& translation, bool global_reference_frame,
                                     const MaxEEFStep& max_step, const CartesianPrecision& precision,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  static double computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                     std::vector<RobotStatePtr>& traj, const LinkModel* link, const Eigen::Vector3d& direction,
                                     bool global_reference_frame, double distance, const MaxEEFStep& max_step,
                                     const CartesianPrecision& precision,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions())
  {
    return computeCartesianPath(start_state, group, traj, link, Eigen::Vector3d(distance * direction), global_reference_frame,
                                max_step, precision, validCallback, options);
  }
  // To a pose, and through poses; of a frame `link_offset` away from the link.
  static double computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                     std::vector<RobotStatePtr>& traj, const LinkModel* link, const Eigen::Isometry3d& target,
                                     bool global_reference_frame, const MaxEEFStep& max_step,
                                     const CartesianPrecision& precision,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions(),
                                     const Eigen::Isometry3d& link_offset = Eigen::Isometry3d::Identity());
  static double computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                     std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                     const EigenSTL::vector_Isometry3d& waypoints, bool global_reference_frame,
                                     const MaxEEFStep& max_step, const CartesianPrecision& precision,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions(),
                                     const Eigen::Isometry3d& link_offset = Eigen::Isometry3d::Identity());

  // ------------------------------------------------------------ with a threshold of jumps; `start_state` is left where they got to
  // By a translation; the answer is the distance reached, in m.
  static double computeCartesianPath(RobotState* start_state, const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                     const LinkModel* link, const Eigen::Vector3d& translation, bool global_reference_frame,
                                     const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions());
  static double computeCartesianPath(RobotState* start_state, const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                     const LinkModel* link, const Eigen::Vector3d& direction, bool global_reference_frame,
                                     double distance, const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions())
  {
    return computeCartesianPath(start_state, group, traj, link, Eigen::Vector3d(distance * direction), global_reference_frame,
                                max_step, jump_threshold, validCallback, options);
  }
  // To a pose, and through poses; of a frame `link_offset` away from the link.
  static double computeCartesianPath(RobotState* start_state, const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                     const LinkModel* link, const Eigen::Isometry3d& target, bool global_reference_frame,
                                     const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions(),
                                     const Eigen::Isometry3d& link_offset = Eigen::Isometry3d::Identity());
  static double computeCartesianPath(RobotState* start_state, const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                     const LinkModel* link, const EigenSTL::vector_Isometry3d& waypoints,
                                     bool global_reference_frame, const MaxEEFStep& max_step,
                                     const JumpThreshold& jump_threshold,
                                     const GroupStateValidityCallbackFn& validCallback = GroupStateValidityCallbackFn(),
                                     const kinematics::KinematicsQueryOptions& options = kinematics::KinematicsQueryOptions(),
                                     const Eigen::Isometry3d& link_offset = Eigen::Isometry3d::Identity());

  // Cut a path before its first jump; the share that is left.
  static double checkJointSpaceJump(const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                    const JumpThreshold& jump_threshold);
  static double checkRelativeJointSpaceJump(const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                            double jump_threshold_factor);
  static double checkAbsoluteJointSpaceJump(const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                            double revolute_jump_threshold, double prismatic_jump_threshold);
};
}  // namespace core
}  // namespace moveit
