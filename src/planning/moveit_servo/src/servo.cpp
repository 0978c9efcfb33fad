#include <moveit_servo/servo.h>

#include "read_parameters.hpp"
#include "say.hpp"

namespace moveit_servo
{
namespace
{
const char* const LOGNAME = "servo_node";
constexpr double ROBOT_STATE_WAIT_TIME = 10.0;  // s

[[noreturn]] void fail(const std::string& line)
{
  ROS_FATAL_NAMED(LOGNAME, "%s", line.c_str());
  endProgram();
}

std::string quoted(const std::vector<std::string>& names)
{
  std::string all;
  for (const std::string& name : names)
    all += (all.empty() ? "" : ", ") + name;
  return all;
}
}  // namespace

Servo::Servo(ros::NodeHandle& nh, const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor)
  : nh_(nh)
  , planning_scene_monitor_(planning_scene_monitor)
{
  if (!readParameters(parameters_))
    endProgram();
  const auto& model = planning_scene_monitor_->getRobotModel();
  if (!model)
    fail("There is no robot: robot_description or robot_description_semantic is missing");
  if (!model->hasJointModelGroup(parameters_.move_group_name))
    fail("Parameter move_group_name: robot '" + model->getName() + "' has no group '" + parameters_.move_group_name +
         "'; it has " + quoted(model->getJointModelGroupNames()));
  if (!planning_scene_monitor_->getStateMonitor())
    planning_scene_monitor_->startStateMonitor(parameters_.joint_topic);
  const auto states = planning_scene_monitor_->getStateMonitor();
  states->enableCopyDynamics(true);
  try
  {
    servo_calcs_ = std::make_unique<ServoCalcs>(nh_, parameters_, planning_scene_monitor_);
  }
  catch (const std::invalid_argument& error)
  {
    fail(error.what());
  }
  if (!states->waitForCompleteState(parameters_.move_group_name, ROBOT_STATE_WAIT_TIME))
  {
    std::vector<std::string> missing;
    states->haveCompleteState(missing, parameters_.move_group_name);
    fail("Timeout waiting for current state: nobody publishes " + quoted(missing) + " on " + states->getMonitoredTopic());
  }
  collision_checker_ = std::make_unique<CollisionCheck>(nh_, parameters_, planning_scene_monitor_);
}

Servo::~Servo() { setPaused(true); }

void Servo::start()
{
  setPaused(false);
  servo_calcs_->start();
  if (parameters_.check_collisions)
    collision_checker_->start();
}

void Servo::setPaused(bool paused)
{
  servo_calcs_->setPaused(paused);
  collision_checker_->setPaused(paused);
}
}  // namespace moveit_servo
