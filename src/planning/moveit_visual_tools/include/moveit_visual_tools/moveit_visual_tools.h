// Robot states, trajectories, grasps and collision objects in RViz and in the planning scene, a function call each.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <moveit/planning_scene/planning_scene.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/robot_trajectory/robot_trajectory.h>
#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/CollisionObject.h>
#include <moveit_msgs/DisplayRobotState.h>
#include <moveit_msgs/DisplayTrajectory.h>
#include <moveit_msgs/Grasp.h>
#include <moveit_msgs/PlanningScene.h>
#include <moveit_msgs/WorkspaceParameters.h>
#include <rviz_visual_tools/deprecation.h>
#include <rviz_visual_tools/rviz_visual_tools.h>
#include <trajectory_msgs/JointTrajectory.h>

namespace moveit_visual_tools {

static const std::string ROBOT_DESCRIPTION = "robot_description";
static const std::string DISPLAY_PLANNED_PATH_TOPIC = "/move_group/display_planned_path";
static const std::string DISPLAY_ROBOT_STATE_TOPIC = "display_robot_state";  // below the node's name
static const std::string PLANNING_SCENE_TOPIC = "planning_scene";

/// Poses and points are in the base frame, lengths in m. Collision objects go into the scene of the monitor that was given,
/// else to move_group. A function that publishes answers whether it did.
class MoveItVisualTools : public rviz_visual_tools::RvizVisualTools {
 public:
  /// The robot of the parameter robot_description, in its planning frame.
  MoveItVisualTools();
  MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic,
                    planning_scene_monitor::PlanningSceneMonitorPtr psm);
  MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic = rviz_visual_tools::RVIZ_MARKER_TOPIC,
                    moveit::core::RobotModelConstPtr robot_model = moveit::core::RobotModelConstPtr());

  void setRobotStateTopic(const std::string& robot_state_topic) { robot_state_topic_ = robot_state_topic; }
  void setPlanningSceneTopic(const std::string& planning_scene_topic) { planning_scene_topic_ = planning_scene_topic; }

  void setPlanningSceneMonitor(planning_scene_monitor::PlanningSceneMonitorPtr psm) { psm_ = std::move(psm); }
  /// A monitor of the tools' own, which publishes its scene; false when there is one already, or no robot.
  bool loadPlanningSceneMonitor();
  planning_scene_monitor::PlanningSceneMonitorPtr getPlanningSceneMonitor();

  /// Collect changes of the scene until triggerPlanningSceneUpdate().
  void setManualSceneUpdating(bool enable_manual = true) { mannual_trigger_update_ = enable_manual; }
  bool triggerPlanningSceneUpdate();

  bool processCollisionObjectMsg(const moveit_msgs::CollisionObject& msg,
                                 const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool processAttachedCollisionObjectMsg(const moveit_msgs::AttachedCollisionObject& msg);
  bool moveCollisionObject(const Eigen::Isometry3d& pose, const std::string& name, const rviz_visual_tools::colors& color);
  bool moveCollisionObject(const geometry_msgs::Pose& pose, const std::string& name, const rviz_visual_tools::colors& color);

  bool loadSharedRobotState();
  /// A state to work with; at the default values to begin with.
  moveit::core::RobotStatePtr& getSharedRobotState();
  moveit::core::RobotStatePtr& getRootRobotState() { return root_robot_state_; }
  moveit::core::RobotModelConstPtr getRobotModel();

  bool loadEEMarker(const moveit::core::JointModelGroup* ee_jmg, const std::vector<double>& ee_joint_pos = {});
  void loadTrajectoryPub(const std::string& display_planned_path_topic = DISPLAY_PLANNED_PATH_TOPIC, bool blocking = true);
  void loadRobotStatePub(const std::string& robot_state_topic = "", bool blocking = true);

  /// The end effector with its parent link at the pose.
  bool publishEEMarkers(const Eigen::Isometry3d& pose, const moveit::core::JointModelGroup* ee_jmg,
                        const std::vector<double>& ee_joint_pos,
                        const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT,
                        const std::string& ns = "end_effector") {
    return publishEEMarkers(convertPose(pose), ee_jmg, ee_joint_pos, color, ns);
  }
  bool publishEEMarkers(const Eigen::Isometry3d& pose, const moveit::core::JointModelGroup* ee_jmg,
                        const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT,
                        const std::string& ns = "end_effector") {
    return publishEEMarkers(convertPose(pose), ee_jmg, std::vector<double>(), color, ns);
  }
  bool publishEEMarkers(const geometry_msgs::Pose& pose, const moveit::core::JointModelGroup* ee_jmg,
                        const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT,
                        const std::string& ns = "end_effector") {
    return publishEEMarkers(pose, ee_jmg, std::vector<double>(), color, ns);
  }
  bool publishEEMarkers(const geometry_msgs::Pose& pose, const moveit::core::JointModelGroup* ee_jmg,
                        const std::vector<double>& ee_joint_pos,
                        const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT,
                        const std::string& ns = "end_effector");

  /// @param animate_speed s between two pictures
  bool publishGrasps(const std::vector<moveit_msgs::Grasp>& possible_grasps, const moveit::core::JointModelGroup* ee_jmg,
                     double animate_speed = 0.1);
  bool publishAnimatedGrasps(const std::vector<moveit_msgs::Grasp>& possible_grasps,
                             const moveit::core::JointModelGroup* ee_jmg, double animate_speed = 0.01);
  bool publishAnimatedGrasp(const moveit_msgs::Grasp& grasp, const moveit::core::JointModelGroup* ee_jmg, double animate_speed);
  bool publishIKSolutions(const std::vector<trajectory_msgs::JointTrajectoryPoint>& ik_solutions,
                          const moveit::core::JointModelGroup* arm_jmg, double display_time = 0.4);

  bool removeAllCollisionObjects();
  bool cleanupCO(const std::string& name);
  /// All attached objects, as ever, whatever the name.
  bool cleanupACO(const std::string& name);
  bool attachCO(const std::string& name, const std::string& ee_parent_link);

  bool publishCollisionFloor(double z = 0.0, const std::string& plane_name = "Floor",
                             const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionBlock(const geometry_msgs::Pose& block_pose, const std::string& block_name = "block",
                             double block_size = 0.1, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionCuboid(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, const std::string& name,
                              const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionCuboid(const geometry_msgs::Point& point1, const geometry_msgs::Point& point2, const std::string& name,
                              const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  /// width along x, depth along y, height along z
  bool publishCollisionCuboid(const Eigen::Isometry3d& pose, double width, double depth, double height, const std::string& name,
                              const rviz_visual_tools::colors& color);
  bool publishCollisionCuboid(const geometry_msgs::Pose& pose, double width, double depth, double height,
                              const std::string& name, const rviz_visual_tools::colors& color);
  bool publishCollisionCuboid(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size, const std::string& name,
                              const rviz_visual_tools::colors& color) {
    return publishCollisionCuboid(pose, size.x(), size.y(), size.z(), name, color);
  }
  bool publishCollisionCuboid(const geometry_msgs::Pose& pose, const geometry_msgs::Vector3& size, const std::string& name,
                              const rviz_visual_tools::colors& color) {
    return publishCollisionCuboid(pose, size.x, size.y, size.z, name, color);
  }
  bool publishCollisionCylinder(const geometry_msgs::Point& a, const geometry_msgs::Point& b, const std::string& object_name,
                                double radius, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionCylinder(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const std::string& object_name,
                                double radius, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionCylinder(const Eigen::Isometry3d& object_pose, const std::string& object_name, double radius,
                                double height, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionCylinder(const geometry_msgs::Pose& object_pose, const std::string& object_name, double radius,
                                double height, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionMesh(const geometry_msgs::Pose& object_pose, const std::string& object_name,
                            const std::string& mesh_path, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionMesh(const Eigen::Isometry3d& object_pose, const std::string& object_name, const std::string& mesh_path,
                            const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionMesh(const Eigen::Isometry3d& object_pose, const std::string& object_name,
                            const shape_msgs::Mesh& mesh_msg,
                            const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionMesh(const geometry_msgs::Pose& object_pose, const std::string& object_name,
                            const shape_msgs::Mesh& mesh_msg,
                            const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionGraph(const graph_msgs::GeometryGraph& graph, const std::string& object_name, double radius,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  /// 0.1 m thick, standing on z, turned by angle about the vertical.
  void getCollisionWallMsg(double x, double y, double z, double angle, double width, double height, const std::string& name,
                           moveit_msgs::CollisionObject& collision_obj);
  bool publishCollisionWall(double x, double y, double angle = 0.0, double width = 2.0, double height = 1.5,
                            const std::string& name = "wall",
                            const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionWall(double x, double y, double z, double angle = 0.0, double width = 2.0, double height = 1.5,
                            const std::string& name = "wall",
                            const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishCollisionTable(double x, double y, double z, double angle, double width, double height, double depth,
                             const std::string& name, const rviz_visual_tools::colors& color = rviz_visual_tools::GREEN);
  bool publishWorkspaceParameters(const moveit_msgs::WorkspaceParameters& params);

  /// @return whether the state collides
  /// Objects of a text file (.scene), in the planning frame, all moved by the offset. False when there is no such file.
  bool loadCollisionSceneFromFile(const std::string& path);
  bool loadCollisionSceneFromFile(const std::string& path, const Eigen::Isometry3d& offset);

  bool checkAndPublishCollision(const moveit::core::RobotState& robot_state,
                                const planning_scene::PlanningScene* planning_scene,
                                const rviz_visual_tools::colors& highlight_link_color = rviz_visual_tools::RED,
                                const rviz_visual_tools::colors& contact_point_color = rviz_visual_tools::PURPLE);
  bool publishContactPoints(const moveit::core::RobotState& robot_state, const planning_scene::PlanningScene* planning_scene,
                            const rviz_visual_tools::colors& color = rviz_visual_tools::RED);
  bool publishContactPoints(const collision_detection::CollisionResult::ContactMap& contacts,
                            const planning_scene::PlanningScene* planning_scene,
                            const rviz_visual_tools::colors& color = rviz_visual_tools::RED);

  bool publishTrajectoryPoint(const trajectory_msgs::JointTrajectoryPoint& trajectory_pt, const std::string& planning_group,
                              double display_time = 0.1);
  /// @param blocking wait as long as the animation lasts
  bool publishTrajectoryPath(const std::vector<moveit::core::RobotStatePtr>& trajectory,
                             const moveit::core::JointModelGroup* jmg, double speed = 0.01, bool blocking = false);
  bool publishTrajectoryPath(const robot_trajectory::RobotTrajectoryPtr& trajectory, bool blocking = false);
  bool publishTrajectoryPath(const robot_trajectory::RobotTrajectory& trajectory, bool blocking = false);
  bool publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory_msg,
                             const moveit::core::RobotStateConstPtr& robot_state, bool blocking = false);
  bool publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory_msg, const moveit::core::RobotState& robot_state,
                             bool blocking = false);
  bool publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory_msg, const moveit_msgs::RobotState& robot_state,
                             bool blocking = false);
  void publishTrajectoryPath(const moveit_msgs::DisplayTrajectory& display_trajectory_msg);

  /// The way of a link, of the tips of the group when none is given.
  bool publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory_msg, const moveit::core::LinkModel* ee_parent_link,
                             const moveit::core::JointModelGroup* arm_jmg,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectoryPtr& robot_trajectory,
                             const moveit::core::LinkModel* ee_parent_link,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectory& robot_trajectory,
                             const moveit::core::LinkModel* ee_parent_link,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::LIME_GREEN);
  bool publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory_msg, const moveit::core::JointModelGroup* arm_jmg,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectoryPtr& robot_trajectory,
                             const moveit::core::JointModelGroup* arm_jmg,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectory& robot_trajectory,
                             const moveit::core::JointModelGroup* arm_jmg,
                             const rviz_visual_tools::colors& color = rviz_visual_tools::LIME_GREEN);
  bool publishTrajectoryPoints(const std::vector<moveit::core::RobotStatePtr>& robot_state_trajectory,
                               const moveit::core::LinkModel* ee_parent_link,
                               const rviz_visual_tools::colors& color = rviz_visual_tools::YELLOW);

  /// Show states with the joint virtual_joint, which has to be a floating one, at the offset.
  void enableRobotStateRootOffet(const Eigen::Isometry3d& offset);
  void disableRobotStateRootOffet();
  bool publishRobotState(const trajectory_msgs::JointTrajectoryPoint& trajectory_pt, const moveit::core::JointModelGroup* jmg,
                         const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT);
  bool publishRobotState(const std::vector<double>& joint_positions, const moveit::core::JointModelGroup* jmg,
                         const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT);
  /// Only the highlighted links in color, when there are some.
  bool publishRobotState(const moveit::core::RobotState& robot_state,
                         const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT,
                         const std::vector<std::string>& highlight_links = {});
  bool publishRobotState(const moveit::core::RobotStatePtr& robot_state,
                         const rviz_visual_tools::colors& color = rviz_visual_tools::DEFAULT,
                         const std::vector<std::string>& highlight_links = {});
  void publishRobotState(const moveit_msgs::DisplayRobotState& display_robot_state_msg);
  bool hideRobot();
  static bool applyVirtualJointTransform(moveit::core::RobotState& robot_state, const Eigen::Isometry3d& offset);
  /// Where each joint stands between its limits, on the terminal.
  void showJointLimits(const moveit::core::RobotStatePtr& robot_state);

 private:
  struct EndEffector {
    visualization_msgs::MarkerArray markers;
    EigenSTL::vector_Isometry3d poses;  // of the markers, in the parent link
    std::vector<double> joint_positions;
  };

  bool applyScene(const moveit_msgs::PlanningScene& diff);
  moveit_msgs::CollisionObject object(const std::string& name, int8_t operation) const;
  bool addPrimitive(const std::string& name, uint8_t type, const std::vector<double>& dimensions,
                    const geometry_msgs::Pose& pose, const rviz_visual_tools::colors& color);
  Eigen::Isometry3d between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 protected:
  planning_scene_monitor::PlanningSceneMonitorPtr psm_;
  bool mannual_trigger_update_ = false;
  std::string robot_state_topic_ = DISPLAY_ROBOT_STATE_TOPIC;
  std::string planning_scene_topic_ = PLANNING_SCENE_TOPIC;
  ros::Publisher pub_display_path_;
  ros::Publisher pub_robot_state_;
  ros::Publisher pub_planning_scene_;
  moveit_msgs::PlanningScene pending_;  // changes that wait for triggerPlanningSceneUpdate()
  robot_model_loader::RobotModelLoaderPtr rm_loader_;
  std::map<const moveit::core::JointModelGroup*, EndEffector> end_effectors_;
  moveit::core::RobotModelConstPtr robot_model_;
  moveit::core::RobotStatePtr shared_robot_state_;
  moveit::core::RobotStatePtr hidden_robot_state_;
  moveit::core::RobotStatePtr root_robot_state_;
  bool robot_state_root_offset_enabled_ = false;
  Eigen::Isometry3d robot_state_root_offset_ = Eigen::Isometry3d::Identity();

 public:
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

typedef std::shared_ptr<MoveItVisualTools> MoveItVisualToolsPtr;
typedef std::shared_ptr<const MoveItVisualTools> MoveItVisualToolsConstPtr;

}  // namespace moveit_visual_tools
