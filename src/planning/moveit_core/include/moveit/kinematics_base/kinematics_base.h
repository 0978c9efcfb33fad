// The base class of compiled inverse kinematics: vendors' analytical solvers and generated IKFast packages derive from it.
// Poses are those of the tip in the solver's base frame, joint values in the order of getJointNames().
#pragma once

#include <geometry_msgs/Pose.h>
#include <moveit_msgs/MoveItErrorCodes.h>
#include <ros/node_handle.h>

#include <boost/function.hpp>
#include <map>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/moveit_kinematics_base_export.h>

namespace moveit
{
namespace core
{
MOVEIT_CLASS_FORWARD(JointModelGroup);
MOVEIT_CLASS_FORWARD(RobotState);
MOVEIT_CLASS_FORWARD(RobotModel);
}  // namespace core
}  // namespace moveit

namespace kinematics
{
// How redundant joints are walked through.
namespace DiscretizationMethods
{
enum DiscretizationMethod
{
  NO_DISCRETIZATION = 1,
  ALL_DISCRETIZED,
  SOME_DISCRETIZED,
  ALL_RANDOM_SAMPLED,
  SOME_RANDOM_SAMPLED
};
}
using DiscretizationMethod = DiscretizationMethods::DiscretizationMethod;

namespace KinematicErrors
{
enum KinematicError
{
  OK = 1,
  UNSUPORTED_DISCRETIZATION_REQUESTED,
  DISCRETIZATION_NOT_INITIALIZED,
  MULTIPLE_TIPS_NOT_SUPPORTED,
  EMPTY_TIP_POSES,
  IK_SEED_OUTSIDE_LIMITS,
  SOLVER_NOT_ACTIVE,
  NO_SOLUTION
};
}
using KinematicError = KinematicErrors::KinematicError;

struct KinematicsQueryOptions
{
  bool lock_redundant_joints = false;
  bool return_approximate_solution = false;
  DiscretizationMethod discretization_method = DiscretizationMethods::NO_DISCRETIZATION;
  KinematicsQueryOptions() {}
};

struct KinematicsResult
{
  KinematicError kinematic_error;
  double solution_percentage;  // of the attempts that were made
};

namespace detail
{
// Where lookupParam looks for a node's own parameters. A process with two nodes, rospy's and roscpp's, has the names of one.
ros::NodeHandle& privateParameters();
void setPrivateParameters(const std::string& node_name);
}  // namespace detail

MOVEIT_CLASS_FORWARD(KinematicsBase);

class KinematicsBase
{
public:
  static MOVEIT_KINEMATICS_BASE_EXPORT const double DEFAULT_SEARCH_DISCRETIZATION;  // rad or m
  static MOVEIT_KINEMATICS_BASE_EXPORT const double DEFAULT_TIMEOUT;                // s

  // Asked for each solution; sets the error code to SUCCESS when it will do.
  using IKCallbackFn =
      boost::function<void(const geometry_msgs::Pose&, const std::vector<double>&, moveit_msgs::MoveItErrorCodes&)>;

  // One step from the seed, without a search.
  virtual bool getPositionIK(const geometry_msgs::Pose& ik_pose, const std::vector<double>& ik_seed_state,
                             std::vector<double>& solution, moveit_msgs::MoveItErrorCodes& error_code,
                             const KinematicsQueryOptions& options = KinematicsQueryOptions()) const = 0;

  // All solutions that the solver has; by default the one of the function above.
  virtual bool getPositionIK(const std::vector<geometry_msgs::Pose>& ik_poses, const std::vector<double>& ik_seed_state,
                             std::vector<std::vector<double>>& solutions, KinematicsResult& result,
                             const KinematicsQueryOptions& options) const;

  // A search of `timeout` s.
  virtual bool searchPositionIK(const geometry_msgs::Pose& ik_pose, const std::vector<double>& ik_seed_state, double timeout,
                                std::vector<double>& solution, moveit_msgs::MoveItErrorCodes& error_code,
                                const KinematicsQueryOptions& options = KinematicsQueryOptions()) const = 0;
  virtual bool searchPositionIK(const geometry_msgs::Pose& ik_pose, const std::vector<double>& ik_seed_state, double timeout,
                                const std::vector<double>& consistency_limits, std::vector<double>& solution,
                                moveit_msgs::MoveItErrorCodes& error_code,
                                const KinematicsQueryOptions& options = KinematicsQueryOptions()) const = 0;
  virtual bool searchPositionIK(const geometry_msgs::Pose& ik_pose, const std::vector<double>& ik_seed_state, double timeout,
                                std::vector<double>& solution, const IKCallbackFn& solution_callback,
                                moveit_msgs::MoveItErrorCodes& error_code,
                                const KinematicsQueryOptions& options = KinematicsQueryOptions()) const = 0;
  virtual bool searchPositionIK(const geometry_msgs::Pose& ik_pose, const std::vector<double>& ik_seed_state, double timeout,
                                const std::vector<double>& consistency_limits, std::vector<double>& solution,
                                const IKCallbackFn& solution_callback, moveit_msgs::MoveItErrorCodes& error_code,
                                const KinematicsQueryOptions& options = KinematicsQueryOptions()) const = 0;
  // Of several tips at once; by default of one.
  virtual bool searchPositionIK(const std::vector<geometry_msgs::Pose>& ik_poses, const std::vector<double>& ik_seed_state,
                                double timeout, const std::vector<double>& consistency_limits, std::vector<double>& solution,
                                const IKCallbackFn& solution_callback, moveit_msgs::MoveItErrorCodes& error_code,
                                const KinematicsQueryOptions& options = KinematicsQueryOptions(),
                                const moveit::core::RobotState* context_state = nullptr) const;

  virtual bool getPositionFK(const std::vector<std::string>& link_names, const std::vector<double>& joint_angles,
                             std::vector<geometry_msgs::Pose>& poses) const = 0;

  virtual void setValues(const std::string& robot_description, const std::string& group_name, const std::string& base_frame,
                         const std::string& tip_frame, double search_discretization);
  virtual void setValues(const std::string& robot_description, const std::string& group_name, const std::string& base_frame,
                         const std::vector<std::string>& tip_frames, double search_discretization);

  // A solver overrides one of these. They are tried from the last to the first.
  virtual bool initialize(const std::string& robot_description, const std::string& group_name, const std::string& base_frame,
                          const std::string& tip_frame, double search_discretization);
  virtual bool initialize(const std::string& robot_description, const std::string& group_name, const std::string& base_frame,
                          const std::vector<std::string>& tip_frames, double search_discretization);
  virtual bool initialize(const moveit::core::RobotModel& robot_model, const std::string& group_name,
                          const std::string& base_frame, const std::vector<std::string>& tip_frames,
                          double search_discretization);

  virtual const std::string& getGroupName() const { return group_name_; }
  virtual const std::string& getBaseFrame() const { return base_frame_; }
  virtual const std::string& getTipFrame() const;  // of the only one
  virtual const std::vector<std::string>& getTipFrames() const { return tip_frames_; }

  virtual bool setRedundantJoints(const std::vector<unsigned int>& redundant_joint_indices);
  bool setRedundantJoints(const std::vector<std::string>& redundant_joint_names);
  virtual void getRedundantJoints(std::vector<unsigned int>& redundant_joint_indices) const
  {
    redundant_joint_indices = redundant_joint_indices_;
  }

  virtual const std::vector<std::string>& getJointNames() const = 0;
  virtual const std::vector<std::string>& getLinkNames() const = 0;

  // By default chains without loops and branches.
  virtual bool supportsGroup(const moveit::core::JointModelGroup* jmg, std::string* error_text_out = nullptr) const;

  void setSearchDiscretization(double sd);
  void setSearchDiscretization(const std::map<int, double>& discretization);  // by redundant joint
  double getSearchDiscretization(int joint_index = 0) const;
  std::vector<DiscretizationMethod> getSupportedDiscretizationMethods() const { return supported_methods_; }
  void setDefaultTimeout(double timeout) { default_timeout_ = timeout; }
  double getDefaultTimeout() const { return default_timeout_; }

  virtual ~KinematicsBase();
  KinematicsBase();

protected:
  moveit::core::RobotModelConstPtr robot_model_;  // not owned: whoever made the solver holds it
  std::string robot_description_, group_name_, base_frame_;
  std::vector<std::string> tip_frames_;
  std::string tip_frame_;         // the only one, of solvers older than tip_frames_
  double search_discretization_;  // likewise
  double default_timeout_;
  std::vector<unsigned int> redundant_joint_indices_;
  std::map<int, double> redundant_joint_discretization_;
  std::vector<DiscretizationMethod> supported_methods_;

  // A parameter of the solver: ~<group>/param, ~param, then both below robot_description_kinematics. True if it is set.
  template <typename T>
  bool lookupParam(const std::string& param, T& val, const T& default_val) const
  {
    ros::NodeHandle& own = detail::privateParameters();
    ros::NodeHandle shared("robot_description_kinematics");
    for (ros::NodeHandle* place : { &own, &shared })
      for (const std::string& name : { group_name_ + "/" + param, param })
        if (place->hasParam(name))
        {
          val = place->param(name, default_val);
          return true;
        }
    val = default_val;
    return false;
  }

  void storeValues(const moveit::core::RobotModel& robot_model, const std::string& group_name, const std::string& base_frame,
                   const std::vector<std::string>& tip_frames, double search_discretization);
};
}  // namespace kinematics
