// A planner and an adapter as tutorials write them: straight to the joint goal, ten steps of equal length, a second each.
#include <class_loader/class_loader.hpp>
#include <moveit/collision_detection_fcl/collision_detector_allocator_fcl.h>
#include <moveit/planning_interface/planning_interface.h>
#include <moveit/planning_request_adapter/planning_request_adapter.h>
#include <moveit/planning_scene/planning_scene.h>
#include <moveit/robot_state/conversions.h>

#include <atomic>

namespace moveit_kinematics_tests
{
class StraightContext : public planning_interface::PlanningContext
{
public:
  StraightContext(const std::string& group, int steps) : PlanningContext("straight", group), steps_(steps) {}

  bool solve(planning_interface::MotionPlanResponse& res) override
  {
    if (request_.planner_id == "throw")
      throw std::runtime_error("thrown on purpose");
    ended_ = false;
    while (request_.planner_id == "sleep" && !ended_)
      ros::WallDuration(0.01).sleep();
    if (ended_)
    {
      res.error_code_.val = moveit_msgs::MoveItErrorCodes::PREEMPTED;
      return false;
    }
    moveit::core::RobotState state = planning_scene_->getCurrentState();
    moveit::core::robotStateMsgToRobotState(planning_scene_->getTransforms(), request_.start_state, state);
    const moveit::core::RobotState start(state);
    res.trajectory_.reset(new robot_trajectory::RobotTrajectory(planning_scene_->getRobotModel(), getGroupName()));
    for (int i = 0; i <= steps_; ++i)
    {
      for (const moveit_msgs::JointConstraint& joint : request_.goal_constraints.at(0).joint_constraints)
        state.setVariablePosition(joint.joint_name, start.getVariablePosition(joint.joint_name) * (steps_ - i) / steps_ +
                                                        joint.position * i / steps_);
      res.trajectory_->addSuffixWayPoint(state, 0.0);
    }
    res.planning_time_ = 0.001;
    res.error_code_.val = moveit_msgs::MoveItErrorCodes::SUCCESS;
    return true;
  }

  bool solve(planning_interface::MotionPlanDetailedResponse& res) override
  {
    planning_interface::MotionPlanResponse plain;
    const bool solved = solve(plain);
    res.trajectory_.push_back(plain.trajectory_);
    res.error_code_ = plain.error_code_;
    return solved;
  }

  bool terminate() override
  {
    ended_ = true;
    return true;
  }
  void clear() override {}

private:
  const int steps_;
  std::atomic<bool> ended_{ false };
};

class StraightManager : public planning_interface::PlannerManager
{
public:
  bool initialize(const moveit::core::RobotModelConstPtr& model, const std::string& ns) override
  {
    int steps = 0;
    if (!ros::NodeHandle(ns).getParam("num_steps", steps))
      return false;
    for (const std::string& group : model->getJointModelGroupNames())
      contexts_[group].reset(new StraightContext(group, steps));
    return true;
  }
  bool canServiceRequest(const moveit_msgs::MotionPlanRequest& /*req*/) const override { return true; }
  std::string getDescription() const override { return "STRAIGHT"; }
  void getPlanningAlgorithms(std::vector<std::string>& algs) const override
  {
    algs.clear();
    algs.push_back("straight");
  }
  planning_interface::PlanningContextPtr getPlanningContext(const planning_scene::PlanningSceneConstPtr& scene,
                                                            const planning_interface::MotionPlanRequest& req,
                                                            moveit_msgs::MoveItErrorCodes& error_code) const override
  {
    const auto& context = contexts_.at(req.group_name);
    context->setPlanningScene(scene);
    context->setMotionPlanRequest(req);
    error_code.val = moveit_msgs::MoveItErrorCodes::SUCCESS;
    return context;
  }

private:
  std::map<std::string, std::shared_ptr<StraightContext>> contexts_;
};

class SecondByStep : public planning_request_adapter::PlanningRequestAdapter
{
public:
  void initialize(const ros::NodeHandle& /*nh*/) override {}
  std::string getDescription() const override { return "A second for each step"; }
  bool adaptAndPlan(const PlannerFn& planner, const planning_scene::PlanningSceneConstPtr& scene,
                    const planning_interface::MotionPlanRequest& req, planning_interface::MotionPlanResponse& res,
                    std::vector<std::size_t>& /*added_path_index*/) const override
  {
    if (!planner(scene, req, res))
      return false;
    for (std::size_t i = 1; i < res.trajectory_->getWayPointCount(); ++i)
      res.trajectory_->setWayPointDurationFromPrevious(i, 1.0);
    return true;
  }
};
}  // namespace moveit_kinematics_tests

CLASS_LOADER_REGISTER_CLASS(moveit_kinematics_tests::StraightManager, planning_interface::PlannerManager)
CLASS_LOADER_REGISTER_CLASS(moveit_kinematics_tests::SecondByStep, planning_request_adapter::PlanningRequestAdapter)
