// What the buttons of PlanningTab do: move_group's actions and services, asked in threads of their own.
#include <moveit/kinematic_constraints/utils.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/robot_trajectory/robot_trajectory.h>
#include <moveit/trajectory_processing/iterative_time_parameterization.h>
#include <moveit/utils/moveit_error_code.h>
#include <moveit_msgs/GetCartesianPath.h>
#include <ros/node_handle.h>
#include <ros/service.h>
#include <std_msgs/Empty.h>
#include <std_msgs/String.h>
#include <std_srvs/Empty.h>
#include <tf2_eigen/tf2_eigen.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

#include "context_tab.hpp"
#include "objects_tab.hpp"
#include "planning_tab.hpp"

namespace moveit_rviz_plugin {
namespace {
constexpr double GOAL_TOLERANCE = 1e-4;  // rad, m
constexpr double LINE_STEP = 0.01;       // m

std::string reason(const moveit_msgs::MoveItErrorCodes& code) { return moveit::core::MoveItErrorCode::toString(code); }
}  // namespace

// All that a straight line of the hand needs.
struct PlanningTab::Line {
  moveit_msgs::GetCartesianPath call;
  std::string service;
  moveit::core::RobotModelConstPtr model;
  moveit::core::RobotStatePtr start;
  double velocity, acceleration;
};

moveit_msgs::MotionPlanRequest PlanningTab::request() const {
  MotionPlanningDisplay& display = dock_->display();
  moveit_msgs::MotionPlanRequest request;
  request.group_name = display.group();
  request.pipeline_id = dock_->context().pipeline();
  request.planner_id = dock_->context().planner();
  request.num_planning_attempts = attempts_->value();
  request.allowed_planning_time = time_->value();
  request.max_velocity_scaling_factor = velocity_->value();
  request.max_acceleration_scaling_factor = acceleration_->value();
  request.workspace_parameters = dock_->context().workspace();
  request.path_constraints = path_constraints_;
  moveit::core::robotStateToRobotStateMsg(*display.query(START), request.start_state);
  const moveit::core::RobotStatePtr goal = display.query(GOAL);
  request.goal_constraints.push_back(
      kinematic_constraints::constructGoalConstraints(*goal, goal->getJointModelGroup(display.group()), GOAL_TOLERANCE));
  return request;
}

moveit_msgs::MoveGroupGoal PlanningTab::goal(bool plan_only) const {
  moveit_msgs::MoveGroupGoal goal;
  goal.request = request();
  if (!plan_only) {  // from where the robot is
    goal.request.start_state = moveit_msgs::RobotState();
    goal.request.start_state.is_diff = true;
  }
  goal.planning_options.plan_only = plan_only;
  goal.planning_options.look_around = looking_->isChecked();
  goal.planning_options.replan = replanning_->isChecked();
  goal.planning_options.planning_scene_diff.is_diff = true;
  goal.planning_options.planning_scene_diff.robot_state.is_diff = true;
  return goal;
}

bool PlanningTab::wantsLine() const { return cartesian_->isEnabled() && cartesian_->isChecked(); }

PlanningTab::Line PlanningTab::line() const {
  MotionPlanningDisplay& display = dock_->display();
  const moveit_msgs::MotionPlanRequest asked = request();
  const moveit::core::RobotStatePtr goal = display.query(GOAL);
  Line line;
  line.service = display.named("compute_cartesian_path");
  line.model = display.model();
  line.start = display.query(START);
  line.velocity = asked.max_velocity_scaling_factor;
  line.acceleration = asked.max_acceleration_scaling_factor;
  auto& request = line.call.request;
  request.header.frame_id = line.model->getModelFrame();
  request.start_state = asked.start_state;
  request.group_name = asked.group_name;
  request.link_name = display.tips().front().link;
  request.waypoints.push_back(tf2::toMsg(goal->getGlobalLinkTransform(request.link_name)));
  request.max_step = LINE_STEP;
  request.avoid_collisions = true;
  request.path_constraints = asked.path_constraints;
  return line;
}

// ---------------------------------------------------------------- buttons

void PlanningTab::show(const QString& text, const QString& why) {
  result_->setText(text);
  result_->setToolTip(why);
}

void PlanningTab::inThread(std::function<void()> job) {
  ++busy_;
  dock_->display().jobs().spawn([this, job]() {
    try {
      job();
    } catch (const std::exception& error) {
      failed("Failed", error.what());
    }
    --busy_;
  });
}

void PlanningTab::begin() {
  dock_->objects().publishIfEdited();
  dock_->display().dropPath();
  dock_->display().rememberStart();
  plan_.reset();
  stopped_ = false;
  plan_button_->setEnabled(false);
  execute_button_->setEnabled(false);
  plan_and_execute_button_->setEnabled(false);
  show("Planning...");
}

void PlanningTab::plan() {
  if (!plan_button_->isEnabled() || !dock_->display().query(START)) return;
  if (dock_->display().group().empty()) return dock_->say("choose a planning group first", true);
  begin();
  if (wantsLine()) inThread([this, wanted = line()]() { runLine(wanted, false); });
  else inThread([this, wanted = goal(true)]() { runPlan(wanted, false); });
}

void PlanningTab::execute() {
  if (!plan_ || !execute_button_->isEnabled()) return;
  execute_button_->setEnabled(false);
  plan_and_execute_button_->setEnabled(false);
  stop_button_->setEnabled(true);
  stopped_ = false;
  show("Executing...");
  inThread([this, plan = plan_]() {
    std::string why;
    const bool good = runTrajectory(plan->trajectory, why);
    executed(good, why);
  });
}

void PlanningTab::planAndExecute() {
  if (!plan_and_execute_button_->isEnabled() || !dock_->display().query(START)) return;
  if (dock_->display().group().empty()) return dock_->say("choose a planning group first", true);
  if (wantsLine()) {  // a line begins where the robot is
    if (const moveit::core::RobotStatePtr now = dock_->display().currentState()) dock_->display().setQuery(START, *now);
  }
  begin();
  stop_button_->setEnabled(true);
  if (wantsLine()) inThread([this, wanted = line()]() { runLine(wanted, true); });
  else inThread([this, wanted = goal(false)]() { runPlan(wanted, true); });
}

void PlanningTab::stop() {
  stopped_ = true;
  stop_button_->setEnabled(false);
  std_msgs::String event;
  event.data = "stop";
  if (stop_publisher_) stop_publisher_.publish(event);
}

void PlanningTab::clearOctomap() {
  const std::string service = dock_->display().named("clear_octomap");
  dock_->inBackground([service]() {
    std_srvs::Empty call;
    if (!ros::service::call(service, call)) throw std::runtime_error("nobody answers " + service);
  });
}

// ---------------------------------------------------------------- in threads

// The client that has the result of a success, or null.
template <typename Action>
std::shared_ptr<typename ActionCall<Action>::Client> PlanningTab::run(ActionCall<Action>& call, const char* name,
                                                                      const typename ActionCall<Action>::Goal& goal,
                                                                      std::string& why) {
  const auto client = call.run(dock_->display().jobs(), dock_->display().named(name), goal, "is move_group running?", why);
  if (!client) return nullptr;
  const moveit_msgs::MoveItErrorCodes code = client->getResult()->error_code;
  why = reason(code);
  return code.val == moveit_msgs::MoveItErrorCodes::SUCCESS ? client : nullptr;
}

void PlanningTab::runPlan(const moveit_msgs::MoveGroupGoal& goal, bool then_execute) {
  std::string why;
  const auto client = run(move_group_, "move_group", goal, why);
  if (then_execute) return executed(client != nullptr, why);
  if (!client) return failed("Failed", why);
  const auto result = client->getResult();
  planned({result->trajectory_start, result->planned_trajectory}, result->planning_time);
}

bool PlanningTab::runTrajectory(const moveit_msgs::RobotTrajectory& trajectory, std::string& why) {
  moveit_msgs::ExecuteTrajectoryGoal goal;
  goal.trajectory = trajectory;
  return run(executor_, "execute_trajectory", goal, why) != nullptr;
}

bool PlanningTab::runCartesian(const Line& line, Planned& plan, std::string& why) {
  moveit_msgs::GetCartesianPath call = line.call;
  if (!ros::service::call(line.service, call)) {
    why = "nobody answers " + ros::names::resolve(line.service);
    return false;
  }
  if (call.response.error_code.val != moveit_msgs::MoveItErrorCodes::SUCCESS) {
    why = reason(call.response.error_code);
    return false;
  }
  if (call.response.fraction < 1.0 - 1e-6) {
    why = "only " + std::to_string(static_cast<int>(100.0 * call.response.fraction)) + " % of the straight line can be reached";
    return false;
  }
  robot_trajectory::RobotTrajectory path(line.model, call.request.group_name);
  path.setRobotTrajectoryMsg(*line.start, call.response.solution);
  const trajectory_processing::IterativeParabolicTimeParameterization times;
  if (!times.computeTimeStamps(path, line.velocity, line.acceleration)) {
    why = "no times fit the straight line";
    return false;
  }
  plan.start = call.response.start_state;
  path.getRobotTrajectoryMsg(plan.trajectory);
  return true;
}

void PlanningTab::runLine(const Line& line, bool then_execute) {
  const ros::WallTime start = ros::WallTime::now();
  Planned plan;
  std::string why;
  if (!runCartesian(line, plan, why)) return then_execute ? executed(false, why) : failed("Failed", why);
  if (!then_execute) return planned(plan, (ros::WallTime::now() - start).toSec());
  const bool good = !stopped_ && runTrajectory(plan.trajectory, why);
  executed(good, why);
}

// ---------------------------------------------------------------- results

void PlanningTab::planned(const Planned& plan, double seconds) {
  dock_->later([this, plan, seconds]() {
    plan_ = std::make_shared<Planned>(plan);
    plan_button_->setEnabled(true);
    plan_and_execute_button_->setEnabled(true);
    execute_button_->setEnabled(!plan.trajectory.joint_trajectory.points.empty() ||
                                !plan.trajectory.multi_dof_joint_trajectory.points.empty());
    show(QString("Time: %1").arg(seconds, 0, 'f', 3));
  });
}

void PlanningTab::failed(const std::string& what, const std::string& why) {
  dock_->say(what + ": " + why, true);
  dock_->later([this, what, why]() {
    plan_button_->setEnabled(true);
    plan_and_execute_button_->setEnabled(true);
    stop_button_->setEnabled(false);
    show(QString::fromStdString(why.empty() ? what : what + ": " + why), QString::fromStdString(why));
  });
}

void PlanningTab::executed(bool good, const std::string& why) {
  if (!good) return failed(stopped_ ? "Stopped" : "Failed", why);
  dock_->later([this]() {
    plan_button_->setEnabled(true);
    plan_and_execute_button_->setEnabled(true);
    stop_button_->setEnabled(false);
    show("Executed");
  });
}

// ---------------------------------------------------------------- other nodes

void PlanningTab::setExternal(bool on) {
  external_topics_.clear();
  dock_->display().setMarkerTopics(on);
  if (!on) return;
  ros::NodeHandle nh;
  const auto command = [this, &nh](const std::string& topic, std::function<void()> what) {
    external_topics_.push_back(
        nh.subscribe<std_msgs::Empty>("/rviz/moveit/" + topic, 1, [what](const std_msgs::Empty::ConstPtr&) { what(); }));
  };
  const auto custom = [this, &nh](const std::string& topic, Which which) {
    external_topics_.push_back(nh.subscribe<moveit_msgs::RobotState>(
        "/rviz/moveit/" + topic, 1, [this, which](const moveit_msgs::RobotState::ConstPtr& message) {
          const moveit::core::RobotStatePtr state = dock_->display().currentState();
          if (!state || !moveit::core::robotStateMsgToRobotState(*message, *state, false)) return;
          states_[which]->setCurrentIndex(-1);
          dock_->display().setQuery(which, *state);
        }));
  };
  command("plan", [this]() { plan(); });
  command("execute", [this]() { execute(); });
  command("stop", [this]() { stop(); });
  command("update_start_state", [this]() { setQueryTo(START, "<current>"); });
  command("update_goal_state", [this]() { setQueryTo(GOAL, "<current>"); });
  custom("update_custom_start_state", START);
  custom("update_custom_goal_state", GOAL);
  external_topics_.push_back(nh.subscribe<std_msgs::String>(
      "/rviz/moveit/select_planning_group", 1,
      [this](const std_msgs::String::ConstPtr& message) { dock_->display().setGroup(message->data); }));
}

}  // namespace moveit_rviz_plugin
