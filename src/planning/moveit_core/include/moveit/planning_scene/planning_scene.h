// A robot among objects: MoveIt's names for a scene of the motion library.
#pragma once

#include <moveit_msgs/Constraints.h>
#include <moveit_msgs/PlanningScene.h>
#include <moveit_msgs/PlanningSceneComponents.h>
#include <moveit_msgs/RobotTrajectory.h>
#include <object_recognition_msgs/ObjectType.h>
#include <octomap_msgs/OctomapWithPose.h>
#include <std_msgs/ColorRGBA.h>

#include <boost/function.hpp>
#include <boost/noncopyable.hpp>
#include <memory>
#include <mutex>

#include <moveit/collision_detection/collision_detector_allocator.h>
#include <moveit/collision_detection/collision_env.h>
#include <moveit/collision_detection/collision_matrix.h>
#include <moveit/collision_detection/world.h>
#include <moveit/kinematic_constraints/kinematic_constraint.h>
#include <moveit/macros/class_forward.h>
#include <moveit/robot_model/robot_model.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/robot_trajectory/robot_trajectory.h>
#include <moveit/transforms/transforms.h>

namespace motion
{
class PlanningScene;
}

namespace planning_scene
{
MOVEIT_CLASS_FORWARD(PlanningScene);

typedef boost::function<bool(const moveit::core::RobotState&, bool)> StateFeasibilityFn;
using MotionFeasibilityFn = boost::function<bool(const moveit::core::RobotState&, const moveit::core::RobotState&, bool)>;
using ObjectColorMap = std::map<std::string, std_msgs::ColorRGBA>;
using ObjectTypeMap = std::map<std::string, object_recognition_msgs::ObjectType>;

class PlanningScene : private boost::noncopyable, public std::enable_shared_from_this<PlanningScene>
{
public:
  static const std::string OCTOMAP_NS;          // "<octomap>"
  static const std::string DEFAULT_SCENE_NAME;  // "(noname)"

  PlanningScene(const moveit::core::RobotModelConstPtr& robot_model,
                const collision_detection::WorldPtr& world = std::make_shared<collision_detection::World>());
  PlanningScene(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model,
                const collision_detection::WorldPtr& world = std::make_shared<collision_detection::World>());
  ~PlanningScene();

  const std::string& getName() const { return name_; }
  void setName(const std::string& name) { name_ = name; }

  // A copy that knows what it comes from; cheap.
  PlanningScenePtr diff() const;
  PlanningScenePtr diff(const moveit_msgs::PlanningScene& msg) const;
  static PlanningScenePtr clone(const PlanningSceneConstPtr& scene);
  const PlanningSceneConstPtr& getParent() const { return parent_; }
  void clearDiffs();                              // as the parent again
  void pushDiffs(const PlanningScenePtr& scene);  // what differs from the parent into another scene
  void decoupleParent() { parent_.reset(); }

  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  const moveit::core::RobotState& getCurrentState() const { return *robot_state_; }
  moveit::core::RobotState& getCurrentStateNonConst() { return *robot_state_; }
  moveit::core::RobotStatePtr getCurrentStateUpdated(const moveit_msgs::RobotState& update) const;
  void setCurrentState(const moveit_msgs::RobotState& state);
  void setCurrentState(const moveit::core::RobotState& state);

  // ------------------------------------------------------------ frames
  const std::string& getPlanningFrame() const { return robot_model_->getModelFrame(); }
  const moveit::core::Transforms& getTransforms() const { return *transforms_; }
  moveit::core::Transforms& getTransformsNonConst() { return *transforms_; }
  // A link, attached body, object, subframe of one, or known transform; the identity, and a line in the log, else.
  const Eigen::Isometry3d& getFrameTransform(const std::string& id) const { return getFrameTransform(*robot_state_, id); }
  const Eigen::Isometry3d& getFrameTransform(const moveit::core::RobotState& state, const std::string& id) const;
  bool knowsFrameTransform(const std::string& id) const { return knowsFrameTransform(*robot_state_, id); }
  bool knowsFrameTransform(const moveit::core::RobotState& state, const std::string& id) const;

  // ------------------------------------------------------------ objects
  collision_detection::WorldConstPtr getWorld() const { return world_; }
  const collision_detection::WorldPtr& getWorldNonConst() { return world_; }
  bool processCollisionObjectMsg(const moveit_msgs::CollisionObject& object);
  bool processAttachedCollisionObjectMsg(const moveit_msgs::AttachedCollisionObject& object);
  bool processPlanningSceneWorldMsg(const moveit_msgs::PlanningSceneWorld& world);
  void processOctomapMsg(const octomap_msgs::OctomapWithPose& map);
  void processOctomapMsg(const octomap_msgs::Octomap& map);
  void processOctomapPtr(const std::shared_ptr<const octomap::OcTree>& octree, const Eigen::Isometry3d& t);
  void removeAllCollisionObjects();  // all but the octomap
  bool shapesAndPosesFromCollisionObjectMessage(const moveit_msgs::CollisionObject& object,
                                                Eigen::Isometry3d& object_pose_in_header_frame,
                                                std::vector<shapes::ShapeConstPtr>& shapes,
                                                EigenSTL::vector_Isometry3d& shape_poses);
  void setAttachedBodyUpdateCallback(const moveit::core::AttachedBodyCallback& callback);
  void setCollisionObjectUpdateCallback(const collision_detection::World::ObserverCallbackFn& callback);

  bool hasObjectColor(const std::string& id) const { return colors_.count(id) > 0; }
  const std_msgs::ColorRGBA& getObjectColor(const std::string& id) const;
  void setObjectColor(const std::string& id, const std_msgs::ColorRGBA& color) { colors_[id] = color; }
  void removeObjectColor(const std::string& id) { colors_.erase(id); }
  void getKnownObjectColors(ObjectColorMap& kc) const { kc = colors_; }
  bool hasObjectType(const std::string& id) const { return types_.count(id) > 0; }
  const object_recognition_msgs::ObjectType& getObjectType(const std::string& id) const;
  void setObjectType(const std::string& id, const object_recognition_msgs::ObjectType& type) { types_[id] = type; }
  void removeObjectType(const std::string& id) { types_.erase(id); }
  void getKnownObjectTypes(ObjectTypeMap& kc) const { kc = types_; }
  void printKnownObjects(std::ostream& out = std::cout) const;

  // ------------------------------------------------------------ messages
  void getPlanningSceneDiffMsg(moveit_msgs::PlanningScene& scene) const;
  void getPlanningSceneMsg(moveit_msgs::PlanningScene& scene) const;
  void getPlanningSceneMsg(moveit_msgs::PlanningScene& scene, const moveit_msgs::PlanningSceneComponents& comp) const;
  bool getCollisionObjectMsg(moveit_msgs::CollisionObject& collision_obj, const std::string& ns) const;
  void getCollisionObjectMsgs(std::vector<moveit_msgs::CollisionObject>& collision_objs) const;
  bool getAttachedCollisionObjectMsg(moveit_msgs::AttachedCollisionObject& attached_collision_obj, const std::string& ns) const;
  void getAttachedCollisionObjectMsgs(std::vector<moveit_msgs::AttachedCollisionObject>& attached_collision_objs) const;
  bool getOctomapMsg(octomap_msgs::OctomapWithPose& octomap) const;
  void getObjectColorMsgs(std::vector<moveit_msgs::ObjectColor>& object_colors) const;
  bool setPlanningSceneDiffMsg(const moveit_msgs::PlanningScene& scene);
  bool setPlanningSceneMsg(const moveit_msgs::PlanningScene& scene);
  bool usePlanningSceneMsg(const moveit_msgs::PlanningScene& scene);  // either, as the message says

  // ------------------------------------------------------------ text files of objects (.scene)
  void saveGeometryToStream(std::ostream& out) const;  // all but the octomap and what is attached
  // Adds the objects up to the line ".", each moved by the offset, and takes the name; one of the same id is replaced. False, with the
  // line in the log and nothing changed, when that is no such text.
  bool loadGeometryFromStream(std::istream& in) { return loadGeometryFromStream(in, Eigen::Isometry3d::Identity()); }
  bool loadGeometryFromStream(std::istream& in, const Eigen::Isometry3d& offset);

  // ------------------------------------------------------------ collisions
  const collision_detection::AllowedCollisionMatrix& getAllowedCollisionMatrix() const { return acm_; }
  collision_detection::AllowedCollisionMatrix& getAllowedCollisionMatrixNonConst() { return acm_; }
  void setAllowedCollisionMatrix(const collision_detection::AllowedCollisionMatrix& acm) { acm_ = acm; }
  collision_detection::CollisionEnvConstPtr getCollisionEnv() const { return env_; }
  collision_detection::CollisionEnvConstPtr getCollisionEnvUnpadded() const { return env_unpadded_; }
  const collision_detection::CollisionEnvPtr& getCollisionEnvNonConst() { return env_; }
  void propogateRobotPadding() {}
  const std::string& getActiveCollisionDetectorName() const;  // "FCL"
  void getCollisionDetectorNames(std::vector<std::string>& names) const;
  // FCL checks, whichever is asked for; the log says so.
  void setActiveCollisionDetector(const collision_detection::CollisionDetectorAllocatorPtr& allocator, bool exclusive = false);
  bool setActiveCollisionDetector(const std::string& collision_detector_name);
  void addCollisionDetector(const collision_detection::CollisionDetectorAllocatorPtr& allocator);

  using Request = collision_detection::CollisionRequest;
  using Result = collision_detection::CollisionResult;
  using Matrix = collision_detection::AllowedCollisionMatrix;
  using State = moveit::core::RobotState;
  // With itself unpadded, with the world padded.
  void checkCollision(const Request& req, Result& res) const { checkCollision(req, res, *robot_state_); }
  void checkCollision(const Request& req, Result& res, const State& state) const { checkCollision(req, res, state, acm_); }
  void checkCollision(const Request& req, Result& res, const State& state, const Matrix& acm) const;
  void checkCollisionUnpadded(const Request& req, Result& res) const { checkCollisionUnpadded(req, res, *robot_state_); }
  void checkCollisionUnpadded(const Request& req, Result& res, const State& state) const
  {
    checkCollisionUnpadded(req, res, state, acm_);
  }
  void checkCollisionUnpadded(const Request& req, Result& res, const State& state, const Matrix& acm) const;
  void checkSelfCollision(const Request& req, Result& res) const { checkSelfCollision(req, res, *robot_state_); }
  void checkSelfCollision(const Request& req, Result& res, const State& state) const
  {
    checkSelfCollision(req, res, state, acm_);
  }
  void checkSelfCollision(const Request& req, Result& res, const State& state, const Matrix& acm) const;

  bool isStateColliding(const std::string& group = "", bool verbose = false) const
  {
    return isStateColliding(*robot_state_, group, verbose);
  }
  bool isStateColliding(const State& state, const std::string& group = "", bool verbose = false) const;
  bool isStateColliding(const moveit_msgs::RobotState& state, const std::string& group = "", bool verbose = false) const;
  void getCollidingLinks(std::vector<std::string>& links) const { getCollidingLinks(links, *robot_state_); }
  void getCollidingLinks(std::vector<std::string>& links, const State& state) const { getCollidingLinks(links, state, acm_); }
  void getCollidingLinks(std::vector<std::string>& links, const State& state, const Matrix& acm) const;
  void getCollidingPairs(Result::ContactMap& contacts) const { getCollidingPairs(contacts, *robot_state_); }
  void getCollidingPairs(Result::ContactMap& contacts, const State& state, const std::string& group_name = "") const
  {
    getCollidingPairs(contacts, state, acm_, group_name);
  }
  void getCollidingPairs(Result::ContactMap& contacts, const State& state, const Matrix& acm,
                         const std::string& group_name = "") const;
  // Between the robot and the world, m.
  double distanceToCollision(const State& state) const { return env_->distanceRobot(state, acm_); }
  double distanceToCollision(const State& state, const Matrix& acm) const { return env_->distanceRobot(state, acm); }
  double distanceToCollisionUnpadded(const State& state) const { return env_unpadded_->distanceRobot(state, acm_); }
  double distanceToCollisionUnpadded(const State& state, const Matrix& acm) const
  {
    return env_unpadded_->distanceRobot(state, acm);
  }

  // ------------------------------------------------------------ validity
  void setStateFeasibilityPredicate(const StateFeasibilityFn& fn) { state_feasibility_ = fn; }
  const StateFeasibilityFn& getStateFeasibilityPredicate() const { return state_feasibility_; }
  void setMotionFeasibilityPredicate(const MotionFeasibilityFn& fn) { motion_feasibility_ = fn; }
  const MotionFeasibilityFn& getMotionFeasibilityPredicate() const { return motion_feasibility_; }
  bool isStateFeasible(const moveit_msgs::RobotState& state, bool verbose = false) const;
  bool isStateFeasible(const State& state, bool verbose = false) const;
  using ConstraintSet = kinematic_constraints::KinematicConstraintSet;
  bool isStateConstrained(const moveit_msgs::RobotState& state, const moveit_msgs::Constraints& constr,
                          bool verbose = false) const;
  bool isStateConstrained(const State& state, const moveit_msgs::Constraints& constr, bool verbose = false) const;
  bool isStateConstrained(const moveit_msgs::RobotState& state, const ConstraintSet& constr, bool verbose = false) const;
  bool isStateConstrained(const State& state, const ConstraintSet& constr, bool verbose = false) const;
  // No collision, feasible, and the constraints are met.
  bool isStateValid(const moveit_msgs::RobotState& state, const std::string& group = "", bool verbose = false) const;
  bool isStateValid(const State& state, const std::string& group = "", bool verbose = false) const;
  bool isStateValid(const moveit_msgs::RobotState& state, const moveit_msgs::Constraints& constr, const std::string& group = "",
                    bool verbose = false) const;
  bool isStateValid(const State& state, const moveit_msgs::Constraints& constr, const std::string& group = "",
                    bool verbose = false) const;
  bool isStateValid(const State& state, const ConstraintSet& constr, const std::string& group = "", bool verbose = false) const;
  // All states of a path; those that are not are listed.
  bool isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                   const std::string& group = "", bool verbose = false,
                   std::vector<std::size_t>* invalid_index = nullptr) const;
  bool isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                   const moveit_msgs::Constraints& path_constraints, const std::string& group = "", bool verbose = false,
                   std::vector<std::size_t>* invalid_index = nullptr) const;
  // The last state meets one of the goal constraints as well.
  bool isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                   const moveit_msgs::Constraints& path_constraints, const moveit_msgs::Constraints& goal_constraints,
                   const std::string& group = "", bool verbose = false,
                   std::vector<std::size_t>* invalid_index = nullptr) const;
  bool isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                   const moveit_msgs::Constraints& path_constraints,
                   const std::vector<moveit_msgs::Constraints>& goal_constraints, const std::string& group = "",
                   bool verbose = false, std::vector<std::size_t>* invalid_index = nullptr) const;
  bool isPathValid(const robot_trajectory::RobotTrajectory& trajectory, const moveit_msgs::Constraints& path_constraints,
                   const moveit_msgs::Constraints& goal_constraints, const std::string& group = "", bool verbose = false,
                   std::vector<std::size_t>* invalid_index = nullptr) const;
  bool isPathValid(const robot_trajectory::RobotTrajectory& trajectory, const moveit_msgs::Constraints& path_constraints,
                   const std::vector<moveit_msgs::Constraints>& goal_constraints, const std::string& group = "",
                   bool verbose = false, std::vector<std::size_t>* invalid_index = nullptr) const;
  bool isPathValid(const robot_trajectory::RobotTrajectory& trajectory, const moveit_msgs::Constraints& path_constraints,
                   const std::string& group = "", bool verbose = false,
                   std::vector<std::size_t>* invalid_index = nullptr) const;
  bool isPathValid(const robot_trajectory::RobotTrajectory& trajectory, const std::string& group = "", bool verbose = false,
                   std::vector<std::size_t>* invalid_index = nullptr) const;

  // The dearest places that bodies share, of a state or of all states of a path; there those of its first state are left out, and of
  // two that overlap by more than the fraction one is kept.
  void getCostSources(const State& state, std::size_t max_costs, std::set<collision_detection::CostSource>& costs) const
  {
    getCostSources(state, max_costs, std::string(), costs);
  }
  void getCostSources(const State& state, std::size_t max_costs, const std::string& group_name,
                      std::set<collision_detection::CostSource>& costs) const;
  void getCostSources(const robot_trajectory::RobotTrajectory& trajectory, std::size_t max_costs,
                      std::set<collision_detection::CostSource>& costs, double overlap_fraction = 0.9) const
  {
    getCostSources(trajectory, max_costs, std::string(), costs, overlap_fraction);
  }
  void getCostSources(const robot_trajectory::RobotTrajectory& trajectory, std::size_t max_costs, const std::string& group_name,
                      std::set<collision_detection::CostSource>& costs, double overlap_fraction = 0.9) const;

  // The scene of the motion library that this one is, with the objects as they are now.
  const motion::PlanningScene& core() const;

private:
  friend class collision_detection::CollisionEnv;
  explicit PlanningScene(const PlanningSceneConstPtr& parent);
  enum Part
  {
    SELF = 1,
    WORLD = 2
  };
  void check(int parts, bool padded, const Request& req, Result& res, const State& state, const Matrix& acm) const;
  void useTransforms();
  bool addObject(const moveit_msgs::CollisionObject& object);
  bool moveObject(const moveit_msgs::CollisionObject& object);
  void forget(const std::string& id);

  class SceneTransforms;
  std::string name_;
  PlanningSceneConstPtr parent_;
  moveit::core::RobotModelConstPtr robot_model_;
  moveit::core::RobotStatePtr robot_state_;
  std::shared_ptr<moveit::core::Transforms> transforms_;
  collision_detection::WorldPtr world_;
  collision_detection::AllowedCollisionMatrix acm_;
  collision_detection::CollisionEnvPtr env_, env_unpadded_;
  collision_detection::World::ObserverHandle observer_;
  bool observed_ = false;
  ObjectColorMap colors_;
  ObjectTypeMap types_;
  StateFeasibilityFn state_feasibility_;
  MotionFeasibilityFn motion_feasibility_;

  std::unique_ptr<motion::PlanningScene> core_;
  mutable std::mutex core_lock_;
  mutable std::map<std::string, collision_detection::World::ObjectConstPtr> in_core_;
  mutable std::uint64_t acm_in_core_ = 0;
};
}  // namespace planning_scene
