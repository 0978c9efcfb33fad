// Robot states, trajectories and end effectors.
#include <moveit_visual_tools/moveit_visual_tools.h>

#include <iomanip>
#include <iostream>

#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/robot_trajectory/robot_trajectory.h>

#include "log_name.hpp"

namespace moveit_visual_tools {
namespace {

const char VIRTUAL_JOINT[] = "virtual_joint";
const double LINE_RADIUS = 0.005;   // m
const double UNTIMED_PERIOD = 2.0;  // s between way points that carry no times
const double UNTIMED_POINT = 0.05;  // s to wait per way point of those

using rviz_visual_tools::colors;

std::vector<const moveit::core::LinkModel*> tips(const moveit::core::JointModelGroup* group) {
  std::vector<const moveit::core::LinkModel*> links;
  if (!group) ROS_FATAL_STREAM_NAMED(LOGNAME, "arm_jmg is NULL");
  else if (!group->getEndEffectorTips(links) || links.empty())
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Unable to get end effector tips from jmg");
  return links;
}

}  // namespace

MoveItVisualTools::MoveItVisualTools() : RvizVisualTools("", rviz_visual_tools::RVIZ_MARKER_TOPIC) {
  setBaseFrame(getRobotModel()->getModelFrame());
}

MoveItVisualTools::MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic,
                                     planning_scene_monitor::PlanningSceneMonitorPtr psm)
    : RvizVisualTools(base_frame, marker_topic), psm_(std::move(psm)) {}

MoveItVisualTools::MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic,
                                     moveit::core::RobotModelConstPtr robot_model)
    : RvizVisualTools(base_frame, marker_topic), robot_model_(std::move(robot_model)) {}

bool MoveItVisualTools::loadSharedRobotState() {
  if (shared_robot_state_) return true;
  if (!robot_model_ && psm_) robot_model_ = psm_->getRobotModel();
  if (!robot_model_) {
    rm_loader_ = std::make_shared<robot_model_loader::RobotModelLoader>(ROBOT_DESCRIPTION);
    robot_model_ = rm_loader_->getModel();
  }
  if (!robot_model_)
    throw std::runtime_error("There is no robot in the parameter " + ROBOT_DESCRIPTION + " that could be shown");
  shared_robot_state_ = std::make_shared<moveit::core::RobotState>(robot_model_);
  shared_robot_state_->setToDefaultValues();
  shared_robot_state_->update(true);
  hidden_robot_state_ = std::make_shared<moveit::core::RobotState>(*shared_robot_state_);
  root_robot_state_ = std::make_shared<moveit::core::RobotState>(*shared_robot_state_);
  return true;
}

moveit::core::RobotStatePtr& MoveItVisualTools::getSharedRobotState() {
  loadSharedRobotState();
  return shared_robot_state_;
}

moveit::core::RobotModelConstPtr MoveItVisualTools::getRobotModel() {
  loadSharedRobotState();
  return robot_model_;
}

void MoveItVisualTools::loadTrajectoryPub(const std::string& topic, bool blocking) {
  if (pub_display_path_) return;
  pub_display_path_ = nh_.advertise<moveit_msgs::DisplayTrajectory>(topic, 10);
  if (blocking) waitForSubscriber(pub_display_path_);
}

void MoveItVisualTools::loadRobotStatePub(const std::string& topic, bool blocking) {
  if (pub_robot_state_) return;
  if (!topic.empty()) robot_state_topic_ = topic;
  pub_robot_state_ = nh_.advertise<moveit_msgs::DisplayRobotState>(robot_state_topic_, 1);
  if (blocking) waitForSubscriber(pub_robot_state_);
}

bool MoveItVisualTools::loadEEMarker(const moveit::core::JointModelGroup* ee_jmg, const std::vector<double>& ee_joint_pos) {
  if (!ee_jmg) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Unable to find joint model group: it is NULL");
    return false;
  }
  loadSharedRobotState();
  moveit::core::RobotState& state = *shared_robot_state_;
  state.setToDefaultValues();
  const std::size_t active = ee_jmg->getActiveJointModels().size();
  if (!ee_joint_pos.empty() && ee_joint_pos.size() != active) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "The number of joint positions given ("
                                        << ee_joint_pos.size() << ") does not match the number of active joints in "
                                        << ee_jmg->getName() << "(" << active << ")");
    return false;
  }
  if (!ee_joint_pos.empty()) state.setJointGroupActivePositions(ee_jmg, ee_joint_pos);
  state.update(true);

  EndEffector made;
  made.joint_positions = ee_joint_pos;
  state.getRobotMarkers(made.markers, ee_jmg->getLinkModelNames(), getColor(rviz_visual_tools::GREY), ee_jmg->getName(),
                        ros::Duration());
  if (made.markers.markers.empty()) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "No links found to visualize in end effector for joint model group: " << ee_jmg->getName());
    return false;
  }
  const Eigen::Isometry3d X_PW = state.getGlobalLinkTransform(ee_jmg->getEndEffectorParentGroup().second).inverse();
  static int offset = 0;  // markers of two end effectors have different ids
  for (visualization_msgs::Marker& marker : made.markers.markers) {
    marker.header.frame_id = base_frame_;
    marker.mesh_use_embedded_materials = marker.type == visualization_msgs::Marker::MESH_RESOURCE;
    marker.id += offset;
    made.poses.push_back(X_PW * convertPose(marker.pose));
  }
  offset += made.markers.markers.size();
  end_effectors_[ee_jmg] = made;
  return true;
}

bool MoveItVisualTools::publishEEMarkers(const geometry_msgs::Pose& pose, const moveit::core::JointModelGroup* ee_jmg,
                                         const std::vector<double>& ee_joint_pos, const colors& color, const std::string& ns) {
  const auto known = end_effectors_.find(ee_jmg);
  if ((known == end_effectors_.end() || known->second.joint_positions != ee_joint_pos) && !loadEEMarker(ee_jmg, ee_joint_pos))
    return false;
  EndEffector& shown = end_effectors_[ee_jmg];
  const Eigen::Isometry3d X_BP = convertPose(pose);
  for (std::size_t i = 0; i < shown.poses.size(); ++i) {
    visualization_msgs::Marker& marker = shown.markers.markers[i];
    marker.header.stamp = ros::Time::now();
    marker.ns = ns;
    marker.lifetime = marker_lifetime_;
    if (color != rviz_visual_tools::DEFAULT) marker.color = getColor(color);
    marker.pose = convertPose(X_BP * shown.poses[i]);
  }
  return publishMarkers(shown.markers);
}

bool MoveItVisualTools::publishGrasps(const std::vector<moveit_msgs::Grasp>& possible_grasps,
                                      const moveit::core::JointModelGroup* ee_jmg, double animate_speed) {
  for (const moveit_msgs::Grasp& grasp : possible_grasps) {
    if (!ros::ok()) break;
    publishEEMarkers(grasp.grasp_pose.pose, ee_jmg);
    ros::Duration(animate_speed).sleep();
  }
  return true;
}

bool MoveItVisualTools::publishAnimatedGrasps(const std::vector<moveit_msgs::Grasp>& possible_grasps,
                                              const moveit::core::JointModelGroup* ee_jmg, double animate_speed) {
  for (const moveit_msgs::Grasp& grasp : possible_grasps) {
    if (!ros::ok()) break;
    publishAnimatedGrasp(grasp, ee_jmg, animate_speed);
    ros::Duration(animate_speed).sleep();
  }
  return true;
}

bool MoveItVisualTools::publishAnimatedGrasp(const moveit_msgs::Grasp& grasp, const moveit::core::JointModelGroup* ee_jmg,
                                             double animate_speed) {
  const int pictures = 10;
  const Eigen::Isometry3d X_BG = convertPose(grasp.grasp_pose.pose);
  const auto& direction = grasp.pre_grasp_approach.direction;
  Eigen::Vector3d approach(direction.vector.x, direction.vector.y, direction.vector.z);
  if (direction.header.frame_id == ee_jmg->getEndEffectorParentGroup().second) approach = X_BG.linear() * approach;
  for (int picture = 0; picture < pictures && ros::ok(); ++picture) {
    const double left = grasp.pre_grasp_approach.min_distance * (pictures - picture) / pictures;
    publishEEMarkers(Eigen::Isometry3d(Eigen::Translation3d(-left * approach) * X_BG), ee_jmg);
    ros::Duration(picture == 0 ? 3 * animate_speed : animate_speed).sleep();
  }
  return true;
}

bool MoveItVisualTools::publishIKSolutions(const std::vector<trajectory_msgs::JointTrajectoryPoint>& ik_solutions,
                                           const moveit::core::JointModelGroup* arm_jmg, double display_time) {
  if (ik_solutions.empty()) {
    ROS_WARN_STREAM_NAMED(LOGNAME, "Empty ik_solutions vector passed into publishIKSolutions()");
    return false;
  }
  moveit_msgs::RobotTrajectory trajectory;
  trajectory.joint_trajectory.header.frame_id = base_frame_;
  trajectory.joint_trajectory.joint_names = arm_jmg->getActiveJointModelNames();
  trajectory.joint_trajectory.points = ik_solutions;
  trajectory.joint_trajectory.points.push_back(ik_solutions.back());
  for (std::size_t i = 0; i < trajectory.joint_trajectory.points.size(); ++i)
    trajectory.joint_trajectory.points[i].time_from_start = ros::Duration(i * display_time);
  return publishTrajectoryPath(trajectory, *getSharedRobotState(), true);
}

bool MoveItVisualTools::publishTrajectoryPoint(const trajectory_msgs::JointTrajectoryPoint& trajectory_pt,
                                               const std::string& planning_group, double display_time) {
  const moveit::core::JointModelGroup* group = getRobotModel()->getJointModelGroup(planning_group);
  if (!group) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Could not find joint model group " << planning_group);
    return false;
  }
  moveit_msgs::RobotTrajectory trajectory;
  trajectory.joint_trajectory.header.frame_id = base_frame_;
  trajectory.joint_trajectory.joint_names = group->getJointModelNames();
  trajectory.joint_trajectory.points = {trajectory_pt, trajectory_pt};
  trajectory.joint_trajectory.points.back().time_from_start = ros::Duration(display_time);
  return publishTrajectoryPath(trajectory, *getSharedRobotState(), true);
}

bool MoveItVisualTools::publishTrajectoryPath(const std::vector<moveit::core::RobotStatePtr>& trajectory,
                                              const moveit::core::JointModelGroup* jmg, double speed, bool blocking) {
  robot_trajectory::RobotTrajectory timed(getRobotModel(), jmg->getName());
  for (const moveit::core::RobotStatePtr& state : trajectory) timed.addSuffixWayPoint(state, speed);
  return publishTrajectoryPath(timed, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const robot_trajectory::RobotTrajectoryPtr& trajectory, bool blocking) {
  return publishTrajectoryPath(*trajectory, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const robot_trajectory::RobotTrajectory& trajectory, bool blocking) {
  moveit_msgs::RobotTrajectory message;
  trajectory.getRobotTrajectoryMsg(message);
  auto& points = message.joint_trajectory.points;
  if (points.size() > 1 && points[1].time_from_start.isZero())
    for (std::size_t i = 0; i < points.size(); ++i) points[i].time_from_start = ros::Duration(i * UNTIMED_PERIOD);
  moveit_msgs::RobotState start;
  if (!trajectory.empty()) moveit::core::robotStateToRobotStateMsg(trajectory.getFirstWayPoint(), start);
  return publishTrajectoryPath(message, start, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory_msg,
                                              const moveit::core::RobotStateConstPtr& robot_state, bool blocking) {
  return publishTrajectoryPath(trajectory_msg, *robot_state, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory_msg,
                                              const moveit::core::RobotState& robot_state, bool blocking) {
  moveit_msgs::RobotState start;
  moveit::core::robotStateToRobotStateMsg(robot_state, start);
  return publishTrajectoryPath(trajectory_msg, start, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory_msg,
                                              const moveit_msgs::RobotState& robot_state, bool blocking) {
  const auto& points = trajectory_msg.joint_trajectory.points;
  if (points.empty()) {
    ROS_WARN_STREAM_NAMED(LOGNAME, "Unable to publish trajectory path because trajectory has zero points");
    return false;
  }
  moveit_msgs::DisplayTrajectory shown;
  shown.model_id = getRobotModel()->getName();
  shown.trajectory.push_back(trajectory_msg);
  shown.trajectory_start = robot_state;
  publishTrajectoryPath(shown);
  if (blocking) {
    const double duration = points.back().time_from_start.toSec();
    ros::Duration(duration > 0 ? duration : UNTIMED_POINT * points.size()).sleep();
  }
  return true;
}

void MoveItVisualTools::publishTrajectoryPath(const moveit_msgs::DisplayTrajectory& display_trajectory_msg) {
  loadTrajectoryPub();
  pub_display_path_.publish(display_trajectory_msg);
  ros::spinOnce();
}

bool MoveItVisualTools::publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory_msg,
                                              const moveit::core::LinkModel* ee_parent_link,
                                              const moveit::core::JointModelGroup* arm_jmg, const colors& color) {
  if (!arm_jmg) {
    ROS_FATAL_STREAM_NAMED(LOGNAME, "arm_jmg is NULL");
    return false;
  }
  robot_trajectory::RobotTrajectory trajectory(getRobotModel(), arm_jmg->getName());
  trajectory.setRobotTrajectoryMsg(*shared_robot_state_, trajectory_msg);
  return publishTrajectoryLine(trajectory, ee_parent_link, color);
}

bool MoveItVisualTools::publishTrajectoryLine(const robot_trajectory::RobotTrajectoryPtr& robot_trajectory,
                                              const moveit::core::LinkModel* ee_parent_link, const colors& color) {
  return publishTrajectoryLine(*robot_trajectory, ee_parent_link, color);
}

bool MoveItVisualTools::publishTrajectoryLine(const robot_trajectory::RobotTrajectory& robot_trajectory,
                                              const moveit::core::LinkModel* ee_parent_link, const colors& color) {
  if (!ee_parent_link) {
    ROS_FATAL_STREAM_NAMED(LOGNAME, "ee_parent_link is NULL");
    return false;
  }
  EigenSTL::vector_Vector3d path;
  for (std::size_t i = 0; i < robot_trajectory.getWayPointCount(); ++i) {
    const Eigen::Isometry3d X_BL = robot_trajectory.getWayPoint(i).getGlobalLinkTransform(ee_parent_link);
    if (X_BL.translation().hasNaN()) {
      ROS_ERROR_STREAM_NAMED(LOGNAME, "NAN DETECTED AT TRAJECTORY POINT i=" << i);
      return false;
    }
    path.push_back(X_BL.translation());
    publishSphere(X_BL, color, rviz_visual_tools::MEDIUM);
  }
  publishPath(path, color, LINE_RADIUS);
  return true;
}

bool MoveItVisualTools::publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory_msg,
                                              const moveit::core::JointModelGroup* arm_jmg, const colors& color) {
  const auto links = tips(arm_jmg);
  for (const moveit::core::LinkModel* link : links)
    if (!publishTrajectoryLine(trajectory_msg, link, arm_jmg, color)) return false;
  return !links.empty();
}

bool MoveItVisualTools::publishTrajectoryLine(const robot_trajectory::RobotTrajectoryPtr& robot_trajectory,
                                              const moveit::core::JointModelGroup* arm_jmg, const colors& color) {
  return publishTrajectoryLine(*robot_trajectory, arm_jmg, color);
}

bool MoveItVisualTools::publishTrajectoryLine(const robot_trajectory::RobotTrajectory& robot_trajectory,
                                              const moveit::core::JointModelGroup* arm_jmg, const colors& color) {
  const auto links = tips(arm_jmg);
  for (const moveit::core::LinkModel* link : links)
    if (!publishTrajectoryLine(robot_trajectory, link, color)) return false;
  return !links.empty();
}

bool MoveItVisualTools::publishTrajectoryPoints(const std::vector<moveit::core::RobotStatePtr>& trajectory,
                                                const moveit::core::LinkModel* ee_parent_link, const colors& color) {
  for (const moveit::core::RobotStatePtr& state : trajectory)
    publishSphere(state->getGlobalLinkTransform(ee_parent_link), color);
  return true;
}

void MoveItVisualTools::enableRobotStateRootOffet(const Eigen::Isometry3d& offset) {
  robot_state_root_offset_enabled_ = true;
  robot_state_root_offset_ = offset;
}

void MoveItVisualTools::disableRobotStateRootOffet() { robot_state_root_offset_enabled_ = false; }

bool MoveItVisualTools::publishRobotState(const trajectory_msgs::JointTrajectoryPoint& trajectory_pt,
                                          const moveit::core::JointModelGroup* jmg, const colors& color) {
  return publishRobotState(trajectory_pt.positions, jmg, color);
}

bool MoveItVisualTools::publishRobotState(const std::vector<double>& joint_positions, const moveit::core::JointModelGroup* jmg,
                                          const colors& color) {
  getSharedRobotState()->setToDefaultValues();
  shared_robot_state_->setJointGroupPositions(jmg, joint_positions);
  return publishRobotState(*shared_robot_state_, color);
}

bool MoveItVisualTools::publishRobotState(const moveit::core::RobotStatePtr& robot_state, const colors& color,
                                          const std::vector<std::string>& highlight_links) {
  return publishRobotState(*robot_state, color, highlight_links);
}

bool MoveItVisualTools::publishRobotState(const moveit::core::RobotState& robot_state, const colors& color,
                                          const std::vector<std::string>& highlight_links) {
  moveit_msgs::DisplayRobotState shown;
  if (color != rviz_visual_tools::DEFAULT) {
    for (const std::string& link :
         highlight_links.empty() ? robot_state.getRobotModel()->getLinkModelNamesWithCollisionGeometry() : highlight_links) {
      shown.highlight_links.emplace_back();
      shown.highlight_links.back().id = link;
      shown.highlight_links.back().color = getColor(color);
    }
  }
  moveit::core::RobotState state = robot_state;
  if (robot_state_root_offset_enabled_) applyVirtualJointTransform(state, robot_state_root_offset_);
  moveit::core::robotStateToRobotStateMsg(state, shown.state);
  publishRobotState(shown);
  return true;
}

void MoveItVisualTools::publishRobotState(const moveit_msgs::DisplayRobotState& display_robot_state_msg) {
  loadRobotStatePub();
  pub_robot_state_.publish(display_robot_state_msg);
  ros::spinOnce();
}

bool MoveItVisualTools::hideRobot() {
  moveit_msgs::DisplayRobotState hidden;
  hidden.hide = true;
  publishRobotState(hidden);
  return true;
}

bool MoveItVisualTools::applyVirtualJointTransform(moveit::core::RobotState& robot_state, const Eigen::Isometry3d& offset) {
  const moveit::core::RobotModel& model = *robot_state.getRobotModel();
  const moveit::core::JointModel* joint = model.hasJointModel(VIRTUAL_JOINT) ? model.getJointModel(VIRTUAL_JOINT) : nullptr;
  if (!joint || joint->getType() != moveit::core::JointModel::FLOATING) {
    ROS_WARN_STREAM_NAMED(LOGNAME, "Joint '" << VIRTUAL_JOINT << "' " << (joint ? "is not floating" : "does not exist")
                                             << ": unable to apply virtual joint transform");
    return false;
  }
  robot_state.setJointPositions(joint, offset);
  return true;
}

void MoveItVisualTools::showJointLimits(const moveit::core::RobotStatePtr& robot_state) {
  const int marks = 20;
  for (const moveit::core::JointModel* joint : robot_state->getRobotModel()->getActiveJointModels()) {
    if (joint->getVariableCount() != 1) continue;
    const double position = robot_state->getVariablePosition(joint->getVariableNames()[0]);
    const moveit::core::VariableBounds& bounds = joint->getVariableBounds()[0];
    const double span = bounds.max_position_ - bounds.min_position_;
    std::string scale(marks, '-');
    const int at = static_cast<int>(marks * (position - bounds.min_position_) / span);
    scale[std::min(marks - 1, std::max(0, at))] = '|';
    const bool outside = !robot_state->satisfiesBounds(joint);
    std::cout << (outside ? "\033[31m" : "") << "   " << std::fixed << std::setprecision(5) << bounds.min_position_ << "\t"
              << scale << " \t" << bounds.max_position_ << "  \t" << joint->getName() << " current: " << position
              << (outside ? "\033[0m" : "") << std::endl;
  }
}

}  // namespace moveit_visual_tools
