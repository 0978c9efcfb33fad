#include <moveit_servo/collision_check.h>
#include <moveit_servo/make_shared_from_pool.h>

#include "laws.hpp"
#include "say.hpp"

namespace moveit_servo
{
namespace
{
const char* const LOGNAME = "collision_check";
constexpr double MIN_RECOMMENDED_COLLISION_RATE = 10.0;  // Hz
constexpr double ROS_LOG_THROTTLE_PERIOD = 30.0;         // s
}  // namespace

CollisionCheck::CollisionCheck(ros::NodeHandle& nh, const moveit_servo::ServoParameters& parameters,
                               const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor)
  : nh_(nh)
  , parameters_(parameters)
  , planning_scene_monitor_(planning_scene_monitor)
  , type_(parameters.collision_check_type == "threshold_distance" ? K_THRESHOLD_DISTANCE : K_STOP_DISTANCE)
  , period_(1.0 / parameters.collision_check_rate)
{
  if (parameters_.check_collisions && parameters_.collision_check_rate < MIN_RECOMMENDED_COLLISION_RATE)
    ROS_WARN_NAMED(LOGNAME, "collision_check_rate is %g Hz: the arm goes far between two looks",
                   parameters_.collision_check_rate);
  ros::NodeHandle internal(nh_, "internal");
  collision_velocity_scale_pub_ = internal.advertise<std_msgs::Float64>("collision_velocity_scale", ROS_QUEUE_SIZE);
  const boost::function<void(const std_msgs::Float64ConstPtr&)> take = [this](const std_msgs::Float64ConstPtr& time) {
    worst_case_stop_time_ = time->data;
  };
  worst_case_stop_time_sub_ = internal.subscribe<std_msgs::Float64>("worst_case_stop_time", ROS_QUEUE_SIZE, take);
}

void CollisionCheck::start() { timer_ = nh_.createTimer(period_, &CollisionCheck::run, this); }

void CollisionCheck::run(const ros::TimerEvent& timer_event)
{
  if (timer_event.profile.last_duration.toSec() > period_.toSec())
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME,
              "Collision checking took %.3f s and is to be done every %.3f s: lower collision_check_rate",
              timer_event.profile.last_duration.toSec(), period_.toSec());
  if (paused_)
    return;
  const auto scale = moveit::util::make_shared_from_pool<std_msgs::Float64>();
  try
  {
    scale->data = velocityScale(look());
  }
  catch (const std::exception& error)
  {
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_ERROR_NAMED, LOGNAME, "Collisions cannot be checked, the arm halts: %s",
              error.what());
    scale->data = 0.0;
  }
  collision_velocity_scale_pub_.publish(scale);
}

CollisionCheck::Distances CollisionCheck::look() const
{
  const planning_scene_monitor::LockedPlanningSceneRO scene(planning_scene_monitor_);
  // The scene's state has what the arm holds.
  moveit::core::RobotState state = scene->getCurrentState();
  planning_scene_monitor_->getStateMonitor()->setToCurrentState(state);
  const auto& allowed = scene->getAllowedCollisionMatrix();
  collision_detection::CollisionRequest request;
  request.group_name = parameters_.move_group_name;

  Distances found;
  collision_detection::CollisionResult world, self;
  scene->getCollisionEnv()->checkRobotCollision(request, world, state, allowed);
  scene->getCollisionEnvUnpadded()->checkSelfCollision(request, self, state, allowed);
  found.collision = world.collision || self.collision;
  // Asked for apart: a check's own distance is the least of both kinds.
  found.to_scene = scene->getCollisionEnv()->distanceRobot(state, allowed);
  found.to_self = scene->getCollisionEnvUnpadded()->distanceSelf(state, allowed);
  return found;
}

double CollisionCheck::velocityScale(const Distances& found)
{
  const double distance = std::min(found.to_scene, found.to_self);
  const double rate = (distance - last_distance_) / period_.toSec();
  const bool first = last_distance_ == std::numeric_limits<double>::max();
  last_distance_ = distance;
  if (found.collision)
    return 0.0;
  if (type_ == K_THRESHOLD_DISTANCE)
    return std::min(laws::thresholdScale(found.to_scene, parameters_.scene_collision_proximity_threshold),
                    laws::thresholdScale(found.to_self, parameters_.self_collision_proximity_threshold));
  return laws::stopDistanceScale(distance, first ? 0.0 : rate, parameters_.min_allowable_collision_distance,
                                 parameters_.collision_distance_safety_factor * worst_case_stop_time_);
}
}  // namespace moveit_servo
