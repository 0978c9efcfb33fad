// Capabilities as a package of its own has them, beside those of move_group.
#include <moveit/move_group/move_group_capability.h>
#include <moveit/moveit_cpp/moveit_cpp.h>
#include <moveit/plan_execution/plan_execution.h>
#include <moveit/kinematic_constraints/utils.h>
#include <pluginlib/class_list_macros.hpp>
#include <std_srvs/Trigger.h>

#include <stdexcept>

namespace moveit_capability_tests
{
using Request = std_srvs::Trigger::Request;
using Response = std_srvs::Trigger::Response;
using planning_scene_monitor::LockedPlanningSceneRO;

class Services : public move_group::MoveGroupCapability
{
public:
  Services() : MoveGroupCapability("TestServices") {}

  void initialize() override
  {
    services_ = { root_node_handle_.advertiseService("objects", &Services::objects, this),
                  node_handle_.advertiseService("add_box", &Services::addBox, this),
                  node_handle_.advertiseService("grasp_box", &Services::graspBox, this),
                  node_handle_.advertiseService("juggle", &Services::juggle, this),
                  node_handle_.advertiseService("juggle_held", &Services::juggleHeld, this),
                  node_handle_.advertiseService("go_left", &Services::goLeft, this),
                  node_handle_.advertiseService("go_left_slowly", &Services::goLeftSlowly, this),
                  node_handle_.advertiseService("crash", &Services::crash, this) };
  }

private:
  // Names of the scene's objects, and after a slash those that are attached.
  bool objects(Request&, Response& response)
  {
    const LockedPlanningSceneRO scene(context_->planning_scene_monitor_);
    for (const std::string& name : scene->getWorld()->getObjectIds())
      response.message += name + " ";
    response.message += "/";
    std::vector<const moveit::core::AttachedBody*> bodies;
    scene->getCurrentState().getAttachedBodies(bodies);
    for (const moveit::core::AttachedBody* body : bodies)
      response.message += " " + body->getName();
    return response.success = true;
  }

  bool addBox(Request&, Response& response)
  {
    moveit_msgs::PlanningScene change;
    change.is_diff = change.robot_state.is_diff = true;
    change.world.collision_objects.resize(1);
    moveit_msgs::CollisionObject& box = change.world.collision_objects[0];
    box.header.frame_id = context_->planning_scene_monitor_->getRobotModel()->getModelFrame();
    box.id = "box";
    box.pose.position.x = 2.0;
    box.pose.orientation.w = 1.0;
    box.primitives.resize(1);
    box.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
    box.primitives[0].dimensions.assign(3, 0.1);
    box.primitive_poses.resize(1);
    box.primitive_poses[0].orientation.w = 1.0;
    response.success = context_->planning_scene_monitor_->newPlanningSceneMessage(change);
    return true;
  }

  bool graspBox(Request&, Response& response)
  {
    moveit_msgs::PlanningScene change;
    change.is_diff = change.robot_state.is_diff = true;
    change.robot_state.attached_collision_objects.resize(1);
    change.robot_state.attached_collision_objects[0].link_name = "hand";
    change.robot_state.attached_collision_objects[0].object.id = "box";
    response.success = context_->planning_scene_monitor_->newPlanningSceneMessage(change);
    return true;
  }

  // Takes the box and lets it go, as fast as it can, and looks each time whether it is where it should be.
  bool juggle(Request&, Response& response) { return juggleFrom(0, response); }
  bool juggleHeld(Request&, Response& response) { return juggleFrom(1, response); }

  bool juggleFrom(int first, Response& response)
  {
    for (int i = first; i < first + 40; ++i)
    {
      moveit_msgs::PlanningScene change;
      change.is_diff = change.robot_state.is_diff = true;
      change.robot_state.attached_collision_objects.resize(1);
      moveit_msgs::AttachedCollisionObject& box = change.robot_state.attached_collision_objects[0];
      box.link_name = "hand";
      box.object.id = "box";
      const bool hold = i % 2 == 0;
      box.object.operation = hold ? moveit_msgs::CollisionObject::ADD : moveit_msgs::CollisionObject::REMOVE;
      context_->planning_scene_monitor_->newPlanningSceneMessage(change);
      for (int look = 0; look < 5; ++look)
      {
        Request request;
        Response seen;
        objects(request, seen);
        const bool held = seen.message.find("box", seen.message.find('/')) != std::string::npos;
        const bool lies = seen.message.find("box") < seen.message.find('/');
        if (held != hold || lies == hold)
        {
          response.message = "after change " + std::to_string(i) + ": " + seen.message;
          return true;
        }
        ros::WallDuration(0.002).sleep();
      }
    }
    return response.success = true;
  }

  // Plans with the default pipeline, executes, and says which code came of it.
  bool goLeft(Request&, Response& response) { return goLeftAt(1.0, response); }
  bool goLeftSlowly(Request&, Response& response) { return goLeftAt(0.1, response); }

  bool goLeftAt(double speed, Response& response)
  {
    if (!context_->plan_execution_)
      throw std::runtime_error("nothing is to be executed");
    plan_execution::PlanExecution::Options options;
    options.plan_callback_ = [=](plan_execution::ExecutableMotionPlan& plan) { return planLeft(plan, speed); };
    plan_execution::ExecutableMotionPlan plan;
    context_->plan_execution_->planAndExecute(plan, options);
    response.success = plan.error_code_.val == moveit_msgs::MoveItErrorCodes::SUCCESS;
    response.message = getActionResultString(plan.error_code_, false, false);
    return true;
  }

  bool planLeft(plan_execution::ExecutableMotionPlan& plan, double speed)
  {
    const planning_scene::PlanningScenePtr scene = plan.copyPlanningScene();
    moveit::core::RobotState goal(scene->getCurrentState());
    const moveit::core::JointModelGroup* group = goal.getJointModelGroup("manipulator");
    goal.setToDefaultValues(group, "left");
    planning_interface::MotionPlanRequest request;
    request.group_name = group->getName();
    request.allowed_planning_time = 5.0;
    request.num_planning_attempts = 1;
    request.max_velocity_scaling_factor = request.max_acceleration_scaling_factor = speed;
    request.goal_constraints.push_back(kinematic_constraints::constructGoalConstraints(goal, group));
    planning_interface::MotionPlanResponse planned;
    resolvePlanningPipeline("")->generatePlan(scene, request, planned);
    plan.error_code_ = planned.error_code_;
    plan.plan_components_.assign(1, plan_execution::ExecutableTrajectory(planned.trajectory_, "to the left"));
    return plan.error_code_.val == moveit_msgs::MoveItErrorCodes::SUCCESS;
  }

  bool crash(Request&, Response&)
  {
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
    return false;
  }

  std::vector<ros::ServiceServer> services_;
};

class Refuses : public move_group::MoveGroupCapability
{
public:
  Refuses() : MoveGroupCapability("Refuses") {}
  void initialize() override { throw std::runtime_error("its hardware is not there"); }
};
}  // namespace moveit_capability_tests

PLUGINLIB_EXPORT_CLASS(moveit_capability_tests::Services, move_group::MoveGroupCapability)
PLUGINLIB_EXPORT_CLASS(moveit_capability_tests::Refuses, move_group::MoveGroupCapability)
