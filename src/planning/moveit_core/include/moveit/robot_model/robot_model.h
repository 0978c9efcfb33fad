// A robot as its URDF and SRDF describe it: MoveIt's names for a robot of the motion library. Joints, links and variables
// are those of the library, in its order (depth first, siblings by name).
#pragma once

#include <ros/console.h>

#include <Eigen/Geometry>
#include <iostream>

#include <moveit/exceptions/exceptions.h>
#include <moveit/macros/class_forward.h>
#include <moveit/robot_model/fixed_joint_model.h>
#include <moveit/robot_model/floating_joint_model.h>
#include <moveit/robot_model/joint_model_group.h>
#include <moveit/robot_model/planar_joint_model.h>
#include <moveit/robot_model/prismatic_joint_model.h>
#include <moveit/robot_model/revolute_joint_model.h>
#include <moveit/utils/lexical_casts.h>
#include <srdfdom/model.h>
#include <urdf/model.h>

namespace motion
{
class RobotModel;
}

namespace moveit
{
namespace core
{
MOVEIT_CLASS_FORWARD(RobotModel);

class RobotModel
{
public:
  // Throws moveit::ConstructException when these make no robot. What is only left out is warned of.
  RobotModel(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model);
  // Names for a robot that the library has made already, of this URDF and SRDF.
  RobotModel(const std::shared_ptr<motion::RobotModel>& core, const urdf::ModelInterfaceSharedPtr& urdf_model,
             const srdf::ModelConstSharedPtr& srdf_model);
  ~RobotModel();
  RobotModel(const RobotModel&) = delete;
  RobotModel& operator=(const RobotModel&) = delete;

  const std::string& getName() const { return model_name_; }
  const std::string& getModelFrame() const { return model_frame_; }
  bool isEmpty() const { return link_model_vector_.empty(); }
  const urdf::ModelInterfaceSharedPtr& getURDF() const { return urdf_; }
  const srdf::ModelConstSharedPtr& getSRDF() const { return srdf_; }
  void printModelInfo(std::ostream& out) const;

  // ------------------------------------------------------------ joints. What there is none of is null, and logged
  const JointModel* getRootJoint() const { return joint_model_vector_[0]; }
  const std::string& getRootJointName() const { return getRootJoint()->getName(); }
  bool hasJointModel(const std::string& name) const;
  const JointModel* getJointModel(const std::string& joint) const;
  const JointModel* getJointModel(int index) const;
  JointModel* getJointModel(const std::string& joint);
  const std::vector<const JointModel*>& getJointModels() const { return joint_model_vector_const_; }
  const std::vector<JointModel*>& getJointModels() { return joint_model_vector_; }
  const std::vector<std::string>& getJointModelNames() const { return joint_model_names_vector_; }
  const std::vector<const JointModel*>& getActiveJointModels() const { return active_joint_model_vector_const_; }
  const std::vector<std::string>& getActiveJointModelNames() const { return active_joint_model_names_vector_; }
  const std::vector<JointModel*>& getActiveJointModels() { return active_joint_model_vector_; }
  const std::vector<const JointModel*>& getSingleDOFJointModels() const { return single_dof_joints_; }
  const std::vector<const JointModel*>& getMultiDOFJointModels() const { return multi_dof_joints_; }
  const std::vector<const JointModel*>& getContinuousJointModels() const { return continuous_joint_model_vector_; }
  const std::vector<const JointModel*>& getMimicJointModels() const { return mimic_joints_; }
  const JointModel* getJointOfVariable(int variable_index) const { return joints_of_variable_[variable_index]; }
  const JointModel* getJointOfVariable(const std::string& variable) const
  {
    return joints_of_variable_[getVariableIndex(variable)];
  }
  std::size_t getJointModelCount() const { return joint_model_vector_.size(); }
  // The joint that moves both.
  const JointModel* getCommonRoot(const JointModel* a, const JointModel* b) const;

  // ------------------------------------------------------------ links
  const LinkModel* getRootLink() const { return link_model_vector_[0]; }
  const std::string& getRootLinkName() const { return getRootLink()->getName(); }
  bool hasLinkModel(const std::string& name) const;
  // With `has_link` nothing is logged.
  const LinkModel* getLinkModel(const std::string& link, bool* has_link = nullptr) const;
  const LinkModel* getLinkModel(int index) const;
  LinkModel* getLinkModel(const std::string& link, bool* has_link = nullptr);
  // The topmost link that `link` is bolted to by fixed joints (with a group: by joints outside of it), and its pose in that.
  static const LinkModel* getRigidlyConnectedParentLinkModel(const LinkModel* link, Eigen::Isometry3d& transform,
                                                             const JointModelGroup* jmg = nullptr);
  static const LinkModel* getRigidlyConnectedParentLinkModel(const LinkModel* link, const JointModelGroup* jmg = nullptr)
  {
    Eigen::Isometry3d unused;
    return getRigidlyConnectedParentLinkModel(link, unused, jmg);
  }
  const std::vector<const LinkModel*>& getLinkModels() const { return link_model_vector_const_; }
  const std::vector<LinkModel*>& getLinkModels() { return link_model_vector_; }
  const std::vector<std::string>& getLinkModelNames() const { return link_model_names_vector_; }
  const std::vector<const LinkModel*>& getLinkModelsWithCollisionGeometry() const
  {
    return link_models_with_collision_geometry_vector_;
  }
  const std::vector<std::string>& getLinkModelNamesWithCollisionGeometry() const
  {
    return link_model_names_with_collision_geometry_vector_;
  }
  std::size_t getLinkModelCount() const { return link_model_vector_.size(); }
  std::size_t getLinkGeometryCount() const { return link_geometry_count_; }

  // ------------------------------------------------------------ values of all variables
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, double* values) const;
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, std::vector<double>& values) const;
  void getVariableRandomPositions(random_numbers::RandomNumberGenerator& rng, std::map<std::string, double>& values) const;
  void getVariableDefaultPositions(double* values) const;
  void getVariableDefaultPositions(std::vector<double>& values) const;
  void getVariableDefaultPositions(std::map<std::string, double>& values) const;
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

  std::size_t getVariableCount() const { return variable_names_.size(); }
  const std::vector<std::string>& getVariableNames() const { return variable_names_; }
  const VariableBounds& getVariableBounds(const std::string& variable) const
  {
    return getJointOfVariable(variable)->getVariableBounds(variable);
  }
  const JointBoundsVector& getActiveJointModelsBounds() const { return active_joint_models_bounds_; }
  void getMissingVariableNames(const std::vector<std::string>& variables, std::vector<std::string>& missing_variables) const;
  int getVariableIndex(const std::string& variable) const;  // of a joint: of its first one; throws moveit::Exception

  // ------------------------------------------------------------ groups
  bool hasJointModelGroup(const std::string& group) const;
  const JointModelGroup* getJointModelGroup(const std::string& name) const;
  JointModelGroup* getJointModelGroup(const std::string& name);
  const std::vector<const JointModelGroup*>& getJointModelGroups() const { return joint_model_groups_const_; }
  const std::vector<JointModelGroup*>& getJointModelGroups() { return joint_model_groups_; }
  const std::vector<std::string>& getJointModelGroupNames() const { return joint_model_group_names_; }
  bool hasEndEffector(const std::string& eef) const;
  const JointModelGroup* getEndEffector(const std::string& name) const;  // by its own name or that of its group
  JointModelGroup* getEndEffector(const std::string& name);
  const std::vector<const JointModelGroup*>& getEndEffectors() const { return end_effectors_; }
  // Solvers by group; groups without one take those of their subgroups.
  void setKinematicsAllocators(const std::map<std::string, SolverAllocatorFn>& allocators);

  const std::shared_ptr<motion::RobotModel>& core() const { return core_; }

private:
  void build();
  void buildLinks();
  void buildJoints();
  void connect();
  void buildGroups();

  std::shared_ptr<motion::RobotModel> core_;
  urdf::ModelInterfaceSharedPtr urdf_;
  srdf::ModelConstSharedPtr srdf_;
  std::string model_name_, model_frame_;
  std::vector<std::unique_ptr<JointModel>> joints_;
  std::vector<std::unique_ptr<LinkModel>> links_;
  std::vector<std::unique_ptr<JointModelGroup>> groups_;

  std::vector<LinkModel*> link_model_vector_;
  std::vector<const LinkModel*> link_model_vector_const_, link_models_with_collision_geometry_vector_;
  std::vector<std::string> link_model_names_vector_, link_model_names_with_collision_geometry_vector_;
  std::size_t link_geometry_count_ = 0;
  std::vector<JointModel*> joint_model_vector_, active_joint_model_vector_;
  std::vector<const JointModel*> joint_model_vector_const_, active_joint_model_vector_const_, joints_of_variable_;
  std::vector<const JointModel*> continuous_joint_model_vector_, mimic_joints_, single_dof_joints_, multi_dof_joints_;
  std::vector<std::string> joint_model_names_vector_, active_joint_model_names_vector_, variable_names_;
  JointBoundsVector active_joint_models_bounds_;
  std::vector<JointModelGroup*> joint_model_groups_;
  std::vector<const JointModelGroup*> joint_model_groups_const_, end_effectors_;
  std::vector<std::string> joint_model_group_names_;
  JointModelGroupMap end_effectors_map_;
};
}  // namespace core
}  // namespace moveit

namespace robot_model = moveit::core;
namespace robot_state = moveit::core;
