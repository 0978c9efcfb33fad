// A planning group: joints and links that are planned for together. Its values are those of all its variables, mimic joints
// among them, in the order of getVariableNames().
#pragma once

#include <boost/function.hpp>
#include <memory>
#include <set>

#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_model/joint_model.h>
#include <moveit/robot_model/link_model.h>
#include <srdfdom/model.h>

namespace motion
{
struct JointModelGroup;
}

namespace moveit
{
namespace core
{
class RobotModel;
class JointModelGroup;

typedef boost::function<kinematics::KinematicsBasePtr(const JointModelGroup*)> SolverAllocatorFn;
using SolverAllocatorMapFn = std::map<const JointModelGroup*, SolverAllocatorFn>;
using JointModelGroupMap = std::map<std::string, JointModelGroup*>;
using JointModelGroupMapConst = std::map<std::string, const JointModelGroup*>;
using JointBoundsVector = std::vector<const JointModel::Bounds*>;

class JointModelGroup
{
public:
  // An inverse kinematics solver, and for each of its joints the place in the group's values.
  struct KinematicsSolver
  {
    operator bool() const { return allocator_ && !bijection_.empty() && solver_instance_; }
    void reset()
    {
      solver_instance_.reset();
      bijection_.clear();
    }
    SolverAllocatorFn allocator_;
    std::vector<unsigned int> bijection_;
    kinematics::KinematicsBasePtr solver_instance_;
    double default_ik_timeout_ = 0.5;  // s
  };
  using KinematicsSolverMap = std::map<const JointModelGroup*, KinematicsSolver>;

  // Of joints that no group of the SRDF has together. The robot does not know it by its name.
  JointModelGroup(const std::string& name, const srdf::Model::Group& config, const std::vector<const JointModel*>& joint_models,
                  const RobotModel* parent_model);
  ~JointModelGroup();
  JointModelGroup(const JointModelGroup&) = delete;
  JointModelGroup& operator=(const JointModelGroup&) = delete;

  const RobotModel& getParentModel() const { return *parent_model_; }
  const std::string& getName() const { return name_; }
  const srdf::Model::Group& getConfig() const { return config_; }

  // ------------------------------------------------------------ joints and links
  bool hasJointModel(const std::string& joint) const;
  bool hasLinkModel(const std::string& link) const;
  const JointModel* getJointModel(const std::string& joint) const;  // null, and a line in the log, if it has none
  const LinkModel* getLinkModel(const std::string& link) const;
  const std::vector<const JointModel*>& getJointModels() const { return joint_model_vector_; }
  const std::vector<std::string>& getJointModelNames() const { return joint_model_name_vector_; }
  const std::vector<const JointModel*>& getActiveJointModels() const { return active_joint_model_vector_; }
  const std::vector<std::string>& getActiveJointModelNames() const { return active_joint_model_name_vector_; }
  const std::vector<const JointModel*>& getFixedJointModels() const { return fixed_joints_; }
  const std::vector<const JointModel*>& getMimicJointModels() const { return mimic_joints_; }
  const std::vector<const JointModel*>& getContinuousJointModels() const { return continuous_joint_model_vector_; }
  const std::vector<const JointModel*>& getJointRoots() const { return joint_roots_; }
  const JointModel* getCommonRoot() const { return common_root_; }
  const std::vector<const LinkModel*>& getLinkModels() const { return link_model_vector_; }
  const std::vector<std::string>& getLinkModelNames() const { return link_model_name_vector_; }
  const std::vector<std::string>& getLinkModelNamesWithCollisionGeometry() const
  {
    return link_model_with_geometry_name_vector_;
  }
  // All links that move with the group.
  const std::vector<const LinkModel*>& getUpdatedLinkModels() const { return updated_link_model_vector_; }
  const std::set<const LinkModel*>& getUpdatedLinkModelsSet() const { return updated_link_model_set_; }
  const std::vector<std::string>& getUpdatedLinkModelNames() const { return updated_link_model_name_vector_; }
  const std::vector<const LinkModel*>& getUpdatedLinkModelsWithGeometry() const
  {
    return updated_link_model_with_geometry_vector_;
  }
  const std::set<const LinkModel*>& getUpdatedLinkModelsWithGeometrySet() const
  {
    return updated_link_model_with_geometry_set_;
  }
  const std::vector<std::string>& getUpdatedLinkModelsWithGeometryNames() const
  {
    return updated_link_model_with_geometry_name_vector_;
  }
  const std::set<std::string>& getUpdatedLinkModelsWithGeometryNamesSet() const
  {
    return updated_link_model_with_geometry_name_set_;
  }
  bool isLinkUpdated(const std::string& name) const;

  // ------------------------------------------------------------ variables
  const std::vector<std::string>& getVariableNames() const { return variable_names_; }
  const std::vector<int>& getVariableIndexList() const { return variable_index_list_; }  // in the robot's values
  int getVariableGroupIndex(const std::string& variable) const;
  unsigned int getVariableCount() const { return variable_names_.size(); }
  unsigned int getActiveVariableCount() const { return active_variable_count_; }
  bool isContiguousWithinState() const { return is_contiguous_index_list_; }

  const std::vector<std::string>& getDefaultStateNames() const { return default_states_names_; }
  void addDefaultState(const std::string& name, const std::map<std::string, double>& default_state);
  bool getVariableDefaultPositions(const std::string& name, std::map<std::string, double>& values) const;
  void getVariableDefaultPositions(std::map<std::string, double>& values) const;
  void getVariableDefaultPositions(std::vector<double>& values) const;
  void getVariableDefaultPositions(double* values) const;

  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values) const
  {
    getVariableRandomPositions(rng, values, active_joint_models_bounds_);
  }
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values) const;
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values,
                                  const JointBoundsVector& active_joint_bounds) const;
  // Near the seed: one distance for all, by type of joint, or by active joint.
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values, const double* seed,
                                        const double distance) const
  {
    getVariableRandomPositionsNearBy(rng, values, active_joint_models_bounds_, seed, distance);
  }
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values,
                                        const std::vector<double>& seed, double distance) const;
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values,
                                        const std::vector<double>& seed,
                                        const std::map<JointModel::JointType, double>& distance_map) const;
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values, const double* seed,
                                        const std::vector<double>& distances) const
  {
    getVariableRandomPositionsNearBy(rng, values, active_joint_models_bounds_, seed, distances);
  }
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values,
                                        const std::vector<double>& seed, const std::vector<double>& distances) const;
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                        const JointBoundsVector& active_joint_bounds, const double* seed,
                                        const double distance) const;
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                        const JointBoundsVector& active_joint_bounds, const double* seed,
                                        const std::map<JointModel::JointType, double>& distance_map) const;
  void getVariableRandomPositionsNearBy(random_numbers::RandomNumberGenerator& rng, double* values,
                                        const JointBoundsVector& active_joint_bounds, const double* seed,
                                        const std::vector<double>& distances) const;

  bool enforcePositionBounds(double* state) const { return enforcePositionBounds(state, active_joint_models_bounds_); }
  bool enforcePositionBounds(double* state, const JointBoundsVector& active_joint_bounds) const;
  bool satisfiesPositionBounds(const double* state, double margin = 0.0) const
  {
    return satisfiesPositionBounds(state, active_joint_models_bounds_, margin);
  }
  bool satisfiesPositionBounds(const double* state, const JointBoundsVector& active_joint_bounds, double margin = 0.0) const;
  double getMaximumExtent() const { return getMaximumExtent(active_joint_models_bounds_); }
  double getMaximumExtent(const JointBoundsVector& active_joint_bounds) const;
  double distance(const double* state1, const double* state2) const;
  void interpolate(const double* from, const double* to, double t, double* state) const;
  const JointBoundsVector& getActiveJointModelsBounds() const { return active_joint_models_bounds_; }
  // Can each joint go from the one to the other within dt (s)?
  bool isValidVelocityMove(const std::vector<double>& from_joint_pose, const std::vector<double>& to_joint_pose,
                           double dt) const;
  bool isValidVelocityMove(const double* from_joint_pose, const double* to_joint_pose, std::size_t array_size, double dt) const;

  // ------------------------------------------------------------ what kind of group
  const std::vector<std::string>& getSubgroupNames() const { return subgroup_names_; }
  void getSubgroups(std::vector<const JointModelGroup*>& sub_groups) const;
  bool isSubgroup(const std::string& group) const;
  bool isChain() const { return is_chain_; }
  bool isSingleDOFJoints() const { return is_single_dof_; }
  bool isEndEffector() const { return !end_effector_name_.empty(); }
  const std::string& getEndEffectorName() const { return end_effector_name_; }
  // Group and link that this end effector is mounted on.
  const std::pair<std::string, std::string>& getEndEffectorParentGroup() const { return end_effector_parent_; }
  const std::vector<std::string>& getAttachedEndEffectorNames() const { return attached_end_effector_names_; }
  // The links that end effectors are mounted on; without any the tip of a chain.
  bool getEndEffectorTips(std::vector<const LinkModel*>& tips) const;
  bool getEndEffectorTips(std::vector<std::string>& tips) const;
  const LinkModel* getOnlyOneEndEffectorTip() const;  // null, and a line in the log, if there are several or none

  // ------------------------------------------------------------ inverse kinematics
  const std::pair<KinematicsSolver, KinematicsSolverMap>& getGroupKinematics() const { return group_kinematics_; }
  void setSolverAllocators(const SolverAllocatorFn& solver, const SolverAllocatorMapFn& solver_map = SolverAllocatorMapFn())
  {
    setSolverAllocators(std::make_pair(solver, solver_map));
  }
  void setSolverAllocators(const std::pair<SolverAllocatorFn, SolverAllocatorMapFn>& solvers);
  const kinematics::KinematicsBaseConstPtr getSolverInstance() const { return group_kinematics_.first.solver_instance_; }
  const kinematics::KinematicsBasePtr& getSolverInstance() { return group_kinematics_.first.solver_instance_; }
  bool canSetStateFromIK(const std::string& tip) const;
  bool setRedundantJoints(const std::vector<std::string>& joints);
  double getDefaultIKTimeout() const { return group_kinematics_.first.default_ik_timeout_; }
  void setDefaultIKTimeout(double ik_timeout);
  const std::vector<unsigned int>& getKinematicsSolverJointBijection() const { return group_kinematics_.first.bijection_; }

  void printGroupInfo(std::ostream& out = std::cout) const;

  const motion::JointModelGroup& core() const { return *core_; }

private:
  friend class RobotModel;
  JointModelGroup(const motion::JointModelGroup& core, const srdf::Model::Group& config, const RobotModel* parent_model);
  JointModelGroup(const std::shared_ptr<const motion::JointModelGroup>& core, const srdf::Model::Group& config,
                  const RobotModel* parent_model);
  void addJoint(const JointModel* joint);
  void addLinks();
  bool computeIKIndexBijection(const std::vector<std::string>& ik_jnames, std::vector<unsigned int>& joint_bijection) const;
  void updateMimicJoints(double* values) const;

  const motion::JointModelGroup* core_;
  const RobotModel* parent_model_;
  std::string name_;
  srdf::Model::Group config_;
  std::vector<const JointModel*> joint_model_vector_, active_joint_model_vector_, fixed_joints_, mimic_joints_;
  std::vector<const JointModel*> continuous_joint_model_vector_, joint_roots_;
  std::vector<std::string> joint_model_name_vector_, active_joint_model_name_vector_, variable_names_;
  const JointModel* common_root_ = nullptr;
  VariableIndexMap joint_variables_index_map_;  // variables and joints
  JointBoundsVector active_joint_models_bounds_;
  std::vector<int> variable_index_list_, active_joint_model_start_index_;
  std::vector<const LinkModel*> link_model_vector_, updated_link_model_vector_, updated_link_model_with_geometry_vector_;
  std::vector<std::string> link_model_name_vector_, link_model_with_geometry_name_vector_;
  std::vector<std::string> updated_link_model_name_vector_, updated_link_model_with_geometry_name_vector_;
  std::set<const LinkModel*> updated_link_model_set_, updated_link_model_with_geometry_set_;
  std::set<std::string> updated_link_model_with_geometry_name_set_;
  unsigned int active_variable_count_ = 0;
  bool is_contiguous_index_list_ = true, is_chain_ = false, is_single_dof_ = true;
  std::vector<std::string> subgroup_names_, attached_end_effector_names_;
  std::pair<std::string, std::string> end_effector_parent_;
  std::string end_effector_name_;
  std::pair<KinematicsSolver, KinematicsSolverMap> group_kinematics_;
  std::map<std::string, std::map<std::string, double>> default_states_;
  std::vector<std::string> default_states_names_;
  std::shared_ptr<const motion::JointModelGroup> own_core_;  // of a group that the robot does not know
};
}  // namespace core
}  // namespace moveit
