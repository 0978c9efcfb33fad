// Requests to move_group: plan, move, execute, Cartesian paths, pick and place, objects in hand.
#include "impl.h"

#include <moveit/planning_scene_interface/planning_scene_interface.h>
#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/GetCartesianPath.h>
#include <moveit_msgs/GraspPlanning.h>
#include <std_msgs/String.h>

namespace moveit {
namespace planning_interface {
namespace {

moveit_msgs::PositionConstraint near(const std::string& link, const geometry_msgs::PoseStamped& target, double tolerance) {
  moveit_msgs::PositionConstraint constraint;
  constraint.header = target.header;
  constraint.link_name = link;
  constraint.weight = 1;
  shape_msgs::SolidPrimitive sphere;
  sphere.type = sphere.SPHERE;
  sphere.dimensions = {tolerance};
  geometry_msgs::Pose center;
  center.position = target.pose.position;
  center.orientation.w = 1;
  constraint.constraint_region.primitives.push_back(sphere);
  constraint.constraint_region.primitive_poses.push_back(center);
  return constraint;
}

moveit_msgs::OrientationConstraint turned(const std::string& link, const geometry_msgs::PoseStamped& target, double tolerance) {
  moveit_msgs::OrientationConstraint constraint;
  constraint.header = target.header;
  constraint.link_name = link;
  constraint.orientation = target.pose.orientation;
  constraint.absolute_x_axis_tolerance = tolerance;
  constraint.absolute_y_axis_tolerance = tolerance;
  constraint.absolute_z_axis_tolerance = tolerance;
  constraint.weight = 1;
  return constraint;
}

moveit_msgs::Constraints at(const moveit::core::RobotState& state, const moveit::core::JointModelGroup& group,
                            double tolerance) {
  moveit_msgs::Constraints goal;
  for (const std::string& name : group.getVariableNames()) {
    moveit_msgs::JointConstraint constraint;
    constraint.joint_name = name;
    constraint.position = state.getVariablePosition(name);
    constraint.tolerance_above = constraint.tolerance_below = tolerance;
    constraint.weight = 1;
    goal.joint_constraints.push_back(constraint);
  }
  return goal;
}

}  // namespace

void MoveGroupInterface::constructMotionPlanRequest(moveit_msgs::MotionPlanRequest& request) {
  request.group_name = getName();
  request.num_planning_attempts = impl_->attempts;
  request.allowed_planning_time = impl_->planning_time;
  request.max_velocity_scaling_factor = impl_->velocity_scaling;
  request.max_acceleration_scaling_factor = impl_->acceleration_scaling;
  request.cartesian_speed_limited_link = impl_->speed_limited_link;
  request.max_cartesian_speed = impl_->max_cartesian_speed;
  request.pipeline_id = impl_->pipeline_id;
  request.planner_id = impl_->planner_id;
  request.workspace_parameters = impl_->workspace;
  request.start_state = impl_->start_state;
  request.goal_constraints.clear();
  if (impl_->target == Impl::JOINT) {
    request.goal_constraints.push_back(at(*impl_->joint_target, *impl_->group, impl_->joint_tolerance));
  } else {
    // Goal i asks for the i-th pose of each link.
    for (const auto& [link, poses] : impl_->pose_targets) {
      request.goal_constraints.resize(std::max(request.goal_constraints.size(), poses.size()));
      for (std::size_t i = 0; i < poses.size(); ++i) {
        if (impl_->target != Impl::ORIENTATION)
          request.goal_constraints[i].position_constraints.push_back(near(link, poses[i], impl_->position_tolerance));
        if (impl_->target != Impl::POSITION)
          request.goal_constraints[i].orientation_constraints.push_back(turned(link, poses[i], impl_->orientation_tolerance));
      }
    }
  }
  request.path_constraints = getPathConstraints();
  request.trajectory_constraints = getTrajectoryConstraints();
}

moveit_msgs::PlanningOptions MoveGroupInterface::Impl::planningOptions(bool plan_only) const {
  moveit_msgs::PlanningOptions asked;
  asked.plan_only = plan_only;
  asked.look_around = look;
  asked.look_around_attempts = look_attempts;
  asked.replan = replan;
  asked.replan_attempts = replan_attempts;
  asked.replan_delay = replan_delay;
  asked.planning_scene_diff.is_diff = true;
  asked.planning_scene_diff.robot_state.is_diff = true;
  return asked;
}

actionlib::SimpleActionClient<moveit_msgs::MoveGroupAction>& MoveGroupInterface::getMoveGroupClient() const {
  return *impl_->move_client;
}

moveit::core::MoveItErrorCode MoveGroupInterface::plan(Plan& plan) {
  moveit_msgs::MoveGroupGoal goal;
  constructMotionPlanRequest(goal.request);
  goal.planning_options = impl_->planningOptions(true);
  goal.planning_options.look_around = goal.planning_options.replan = false;
  moveit_msgs::MoveGroupResultConstPtr result;
  const moveit::core::MoveItErrorCode code = impl_->call(impl_->move_client, goal, "MoveGroup", true, result);
  if (code.val == code.SUCCESS && result) {
    plan.trajectory_ = result->planned_trajectory;
    plan.start_state_ = result->trajectory_start;
    plan.planning_time_ = result->planning_time;
  }
  return code;
}

moveit::core::MoveItErrorCode MoveGroupInterface::requestMove(bool wait) {
  moveit_msgs::MoveGroupGoal goal;
  constructMotionPlanRequest(goal.request);
  goal.planning_options = impl_->planningOptions(false);
  moveit_msgs::MoveGroupResultConstPtr result;
  return impl_->call(impl_->move_client, goal, "MoveGroup", wait, result);
}

moveit::core::MoveItErrorCode MoveGroupInterface::requestExecution(const moveit_msgs::RobotTrajectory& trajectory, bool wait) {
  moveit_msgs::ExecuteTrajectoryGoal goal;
  goal.trajectory = trajectory;
  moveit_msgs::ExecuteTrajectoryResultConstPtr result;
  return impl_->call(impl_->execute_client, goal, "ExecuteTrajectory", wait, result);
}

moveit::core::MoveItErrorCode MoveGroupInterface::move() { return requestMove(true); }
moveit::core::MoveItErrorCode MoveGroupInterface::asyncMove() { return requestMove(false); }
moveit::core::MoveItErrorCode MoveGroupInterface::execute(const Plan& plan) { return requestExecution(plan.trajectory_, true); }
moveit::core::MoveItErrorCode MoveGroupInterface::execute(const moveit_msgs::RobotTrajectory& trajectory) {
  return requestExecution(trajectory, true);
}
moveit::core::MoveItErrorCode MoveGroupInterface::asyncExecute(const Plan& plan) {
  return requestExecution(plan.trajectory_, false);
}
moveit::core::MoveItErrorCode MoveGroupInterface::asyncExecute(const moveit_msgs::RobotTrajectory& trajectory) {
  return requestExecution(trajectory, false);
}

double MoveGroupInterface::computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                                                double jump_threshold, moveit_msgs::RobotTrajectory& trajectory,
                                                bool avoid_collisions, moveit_msgs::MoveItErrorCodes* error_code) {
  return computeCartesianPath(waypoints, eef_step, jump_threshold, trajectory, moveit_msgs::Constraints(), avoid_collisions,
                              error_code);
}
double MoveGroupInterface::computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                                                moveit_msgs::RobotTrajectory& trajectory, bool avoid_collisions,
                                                moveit_msgs::MoveItErrorCodes* error_code) {
  return computeCartesianPath(waypoints, eef_step, 0.0, trajectory, moveit_msgs::Constraints(), avoid_collisions, error_code);
}
double MoveGroupInterface::computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                                                moveit_msgs::RobotTrajectory& trajectory,
                                                const moveit_msgs::Constraints& path_constraints, bool avoid_collisions,
                                                moveit_msgs::MoveItErrorCodes* error_code) {
  return computeCartesianPath(waypoints, eef_step, 0.0, trajectory, path_constraints, avoid_collisions, error_code);
}
double MoveGroupInterface::computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                                                double jump_threshold, moveit_msgs::RobotTrajectory& trajectory,
                                                const moveit_msgs::Constraints& path_constraints, bool avoid_collisions,
                                                moveit_msgs::MoveItErrorCodes* error_code) {
  moveit_msgs::GetCartesianPath path;
  path.request.header.frame_id = impl_->pose_frame;
  path.request.header.stamp = ros::Time::now();
  path.request.start_state = impl_->start_state;
  path.request.group_name = getName();
  path.request.link_name = impl_->end_effector_link;
  path.request.waypoints = waypoints;
  path.request.max_step = eef_step;
  path.request.jump_threshold = jump_threshold;
  path.request.path_constraints = path_constraints;
  path.request.avoid_collisions = avoid_collisions;
  path.request.cartesian_speed_limited_link = impl_->speed_limited_link;
  path.request.max_cartesian_speed = impl_->max_cartesian_speed;
  if (!impl_->cartesian_service.call(path)) path.response.error_code.val = moveit_msgs::MoveItErrorCodes::FAILURE;
  if (error_code) *error_code = path.response.error_code;
  if (path.response.error_code.val != moveit_msgs::MoveItErrorCodes::SUCCESS) return -1;
  trajectory = path.response.solution;
  return path.response.fraction;
}

void MoveGroupInterface::stop() {
  std_msgs::String event;
  event.data = "stop";
  waitForSubscriber(impl_->event_publisher);
  impl_->event_publisher.publish(event);
  Impl::noteStop();
}

moveit_msgs::PickupGoal MoveGroupInterface::constructPickupGoal(const std::string& object,
                                                                std::vector<moveit_msgs::Grasp> grasps, bool plan_only) const {
  moveit_msgs::PickupGoal goal;
  goal.target_name = object;
  goal.group_name = getName();
  goal.end_effector = getEndEffector();
  goal.possible_grasps = std::move(grasps);
  goal.support_surface_name = impl_->support_surface;
  goal.allow_gripper_support_collision = !impl_->support_surface.empty();
  goal.path_constraints = getPathConstraints();
  goal.planner_id = impl_->planner_id;
  goal.allowed_planning_time = impl_->planning_time;
  goal.planning_options = impl_->planningOptions(plan_only);
  return goal;
}

moveit_msgs::PlaceGoal MoveGroupInterface::constructPlaceGoal(const std::string& object,
                                                              std::vector<moveit_msgs::PlaceLocation> locations,
                                                              bool plan_only) const {
  moveit_msgs::PlaceGoal goal;
  goal.group_name = getName();
  goal.attached_object_name = object;
  goal.place_locations = std::move(locations);
  goal.support_surface_name = impl_->support_surface;
  goal.allow_gripper_support_collision = !impl_->support_surface.empty();
  goal.path_constraints = getPathConstraints();
  goal.planner_id = impl_->planner_id;
  goal.allowed_planning_time = impl_->planning_time;
  goal.planning_options = impl_->planningOptions(plan_only);
  return goal;
}

std::vector<moveit_msgs::PlaceLocation> MoveGroupInterface::posesToPlaceLocations(
    const std::vector<geometry_msgs::PoseStamped>& poses) const {
  moveit_msgs::PlaceLocation location;
  location.pre_place_approach.direction.header.frame_id = getPlanningFrame();
  location.pre_place_approach.direction.vector.z = -1;
  location.pre_place_approach.min_distance = 0.1;
  location.pre_place_approach.desired_distance = 0.2;
  location.post_place_retreat.direction.header.frame_id = impl_->end_effector_link;
  location.post_place_retreat.direction.vector.x = -1;
  location.post_place_retreat.min_distance = 0;
  location.post_place_retreat.desired_distance = 0.2;
  std::vector<moveit_msgs::PlaceLocation> locations;
  for (const geometry_msgs::PoseStamped& pose : poses) {
    location.place_pose = pose;
    locations.push_back(location);
  }
  return locations;
}

moveit::core::MoveItErrorCode MoveGroupInterface::pick(const moveit_msgs::PickupGoal& goal) {
  moveit_msgs::PickupResultConstPtr result;
  return impl_->call(impl_->pick_client, goal, "Pickup", true, result);
}

moveit::core::MoveItErrorCode MoveGroupInterface::place(const moveit_msgs::PlaceGoal& goal) {
  moveit_msgs::PlaceResultConstPtr result;
  return impl_->call(impl_->place_client, goal, "Place", true, result);
}

moveit::core::MoveItErrorCode MoveGroupInterface::planGraspsAndPick(const std::string& object, bool plan_only) {
  if (object.empty()) return planGraspsAndPick(moveit_msgs::CollisionObject(), plan_only);
  PlanningSceneInterface scene(getNodeHandle().getNamespace());
  const std::map<std::string, moveit_msgs::CollisionObject> objects = scene.getObjects({object});
  if (!objects.empty()) return planGraspsAndPick(objects.at(object), plan_only);
  ROS_ERROR_STREAM_NAMED(LOGNAME, "Asked for grasps for the object '" << object << "', but the object could not be found");
  return moveit_msgs::MoveItErrorCodes::INVALID_OBJECT_NAME;
}

moveit::core::MoveItErrorCode MoveGroupInterface::planGraspsAndPick(const moveit_msgs::CollisionObject& object,
                                                                    bool plan_only) {
  if (!impl_->grasps_service.exists()) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Grasp planning service '" << impl_->grasps_service.getService()
                                                               << "' is not available. This has to be implemented and "
                                                                  "started separately.");
    return moveit_msgs::MoveItErrorCodes::COMMUNICATION_FAILURE;
  }
  moveit_msgs::GraspPlanning planning;
  planning.request.group_name = getName();
  planning.request.target = object;
  planning.request.support_surfaces.push_back(impl_->support_surface);
  if (!impl_->grasps_service.call(planning) || planning.response.error_code.val != moveit_msgs::MoveItErrorCodes::SUCCESS) {
    ROS_ERROR_NAMED(LOGNAME, "Grasp planning failed. Unable to pick.");
    return moveit_msgs::MoveItErrorCodes::FAILURE;
  }
  return pick(constructPickupGoal(object.id, std::move(planning.response.grasps), plan_only));
}

bool MoveGroupInterface::attachObject(const std::string& object, const std::string& link) {
  return attachObject(object, link, {});
}

bool MoveGroupInterface::attachObject(const std::string& object, const std::string& named,
                                      const std::vector<std::string>& touch_links) {
  const std::vector<std::string>& links = getLinkNames();
  std::string link = impl_->link(named);
  if (link.empty() && !links.empty()) link = links.front();
  if (link.empty()) {
    ROS_ERROR_NAMED(LOGNAME, "No known link to attach object '%s' to", object.c_str());
    return false;
  }
  moveit_msgs::AttachedCollisionObject attached;
  attached.link_name = link;
  attached.object.id = object;
  attached.object.operation = moveit_msgs::CollisionObject::ADD;
  waitForSubscriber(impl_->attached_publisher);
  attached.touch_links = touch_links.empty() ? std::vector<std::string>{link} : touch_links;
  impl_->attached_publisher.publish(attached);
  return true;
}

bool MoveGroupInterface::detachObject(const std::string& name) {
  moveit_msgs::AttachedCollisionObject detached;
  detached.object.operation = moveit_msgs::CollisionObject::REMOVE;
  std::vector<std::string> links = getLinkNames();
  if (!name.empty()) {
    links.clear();
    if (impl_->group->hasLinkModel(name)) links.push_back(name);
    else detached.object.id = name;
  }
  waitForSubscriber(impl_->attached_publisher);
  if (links.empty()) impl_->attached_publisher.publish(detached);
  for (const std::string& link : links) {
    detached.link_name = link;
    impl_->attached_publisher.publish(detached);
  }
  return true;
}

}  // namespace planning_interface
}  // namespace moveit
