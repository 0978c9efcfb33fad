// Trajectories through controllers behind actions, and the settings that tools change while a robot runs.
#include <actionlib/server/simple_action_server.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>

#include <moveit/plan_execution/plan_execution.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/planning_scene_monitor/trajectory_monitor.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit/trajectory_execution_manager/trajectory_execution_manager.h>

namespace
{
const robot_model_loader::RobotModelLoader& loader()
{
  static const robot_model_loader::RobotModelLoader made("robot_description");
  return made;
}
}  // namespace

// A controller that moves as long as the trajectory says, and fails for one that ends beyond 1 rad.
class Controller
{
public:
  using Server = actionlib::SimpleActionServer<control_msgs::FollowJointTrajectoryAction>;
  Controller()
    : server_(
          ros::NodeHandle(), "late_controller/follow_joint_trajectory",
          [this](const control_msgs::FollowJointTrajectoryGoalConstPtr& goal) { move(*goal); }, false)
  {
    server_.start();
  }
  ~Controller() { over_ = true; }
  int goals() const { return goals_; }
  double velocity() const { return velocity_; }
  control_msgs::FollowJointTrajectoryGoal last() const
  {
    std::lock_guard<std::mutex> lock(lock_);
    return last_;
  }

private:
  void move(const control_msgs::FollowJointTrajectoryGoal& goal)
  {
    const auto& last = goal.trajectory.points.back();
    velocity_ = last.velocities.empty() ? 0.0 : last.velocities[0];
    {
      std::lock_guard<std::mutex> lock(lock_);
      last_ = goal;
    }
    ++goals_;
    const ros::Time end = ros::Time::now() + last.time_from_start;
    while (ros::Time::now() < end)
    {
      if (over_)
        return;
      if (server_.isPreemptRequested())
        return server_.setPreempted();
      ros::WallDuration(0.01).sleep();
    }
    if (last.positions[0] > 1.0)
      server_.setAborted();
    else
      server_.setSucceeded();
  }
  mutable std::mutex lock_;
  control_msgs::FollowJointTrajectoryGoal last_;
  std::atomic<bool> over_{ false };
  std::atomic<int> goals_{ 0 };          // that it has begun
  std::atomic<double> velocity_{ 0.0 };  // at the end of the last one
  Server server_;
};

bool comesTrue(const std::function<bool()>& condition)
{
  for (int i = 0; i < 6000 && !condition(); ++i)
    ros::WallDuration(0.01).sleep();
  return condition();
}

using ExecutionStatus = moveit_controller_manager::ExecutionStatus;
using trajectory_execution_manager::TrajectoryExecutionManager;

// The parameters of one controller of the first joints behind an action; `own` numbers are of its entry.
void useLateController(const std::map<std::string, double>& own = {}, int joints = 1)
{
  ros::param::set("~moveit_controller_manager", "moveit_simple_controller_manager/MoveItSimpleControllerManager");
  XmlRpc::XmlRpcValue list;
  list[0]["name"] = "late_controller";
  list[0]["action_ns"] = "follow_joint_trajectory";
  list[0]["type"] = "FollowJointTrajectory";
  for (int i = 0; i < joints; ++i)
    list[0]["joints"][i] = "joint_" + std::to_string(i + 1);
  for (const auto& [key, value] : own)
    list[0][key] = value;
  ros::param::set("~controller_list", list);
}

void pushMotion(TrajectoryExecutionManager& execution, double position, double duration)
{
  moveit_msgs::RobotTrajectory trajectory;
  trajectory.joint_trajectory.joint_names = { "joint_1" };
  trajectory.joint_trajectory.points.resize(2);
  trajectory.joint_trajectory.points[0].positions = { 0.0 };
  trajectory.joint_trajectory.points[0].velocities = trajectory.joint_trajectory.points[1].velocities = { 0.2 };
  trajectory.joint_trajectory.points[1].positions = { position };
  trajectory.joint_trajectory.points[1].time_from_start = ros::Duration(duration);
  EXPECT_TRUE(execution.push(trajectory));
}

TEST(Execution, controllersBehindActions)
{
  using Status = ExecutionStatus;
  useLateController();
  TrajectoryExecutionManager execution(loader().getModel(), nullptr);
  const auto moved = [&execution](double position, double duration) { pushMotion(execution, position, duration); };
  moved(0.5, 0.1);
  EXPECT_EQ(execution.executeAndWait(), Status::ABORTED);  // the controller is not there yet
  auto controller = std::make_unique<Controller>();
  moved(0.5, 0.1);
  EXPECT_EQ(execution.executeAndWait(), Status::SUCCEEDED);
  moved(1.5, 0.1);
  moved(0.5, 0.1);  // is not reached
  EXPECT_EQ(execution.executeAndWait(), Status::ABORTED);
  EXPECT_TRUE(execution.getTrajectories().empty());
  moved(0.5, 20.0);
  int goals = controller->goals();
  execution.execute();
  EXPECT_EQ(execution.getLastExecutionStatus(), Status::RUNNING);
  EXPECT_TRUE(comesTrue([&] { return controller->goals() > goals; }));
  EXPECT_EQ(execution.getCurrentExpectedTrajectoryIndex().first, 0);
  execution.processEvent("stop");
  EXPECT_EQ(execution.getLastExecutionStatus(), Status::PREEMPTED);
  // A controller that ends in motion.
  moved(0.5, 60.0);
  goals = controller->goals();
  execution.execute();
  EXPECT_TRUE(comesTrue([&] { return controller->goals() > goals; }));
  controller.reset();
  EXPECT_EQ(execution.waitForExecution(), Status::ABORTED);
}

// As upstream: an entry of controller_list may say how long its own controller may take.
// As the manager in Python: test_entries.py of moveit_simple_controller_manager reads the same cases.
TEST(Execution, tolerancesAreThoseOfTheEntry)
{
  XmlRpc::XmlRpcValue cases;
  ASSERT_TRUE(ros::param::get("/tolerances", cases));
  Controller controller;
  for (int i = 0; i < cases.size(); ++i)
  {
    const std::string name = cases[i]["case"];
    XmlRpc::XmlRpcValue list;
    useLateController({ { "goal_time_tolerance", -1.0 } });
    ros::param::get("~controller_list", list);
    list[0]["joints"] = cases[i]["joints"];
    list[0]["goal_tolerance"] = list[0]["path_tolerance"] = cases[i]["given"];
    ros::param::set("~controller_list", list);
    TrajectoryExecutionManager execution(loader().getModel(), nullptr);
    pushMotion(execution, 0.5, 0.01);
    ASSERT_EQ(execution.executeAndWait(), ExecutionStatus::SUCCEEDED) << name;
    const control_msgs::FollowJointTrajectoryGoal goal = controller.last();
    EXPECT_EQ(goal.goal_time_tolerance.toSec(), -1.0);
    XmlRpc::XmlRpcValue& rows = cases[i]["rows"];
    for (const auto& found : { goal.goal_tolerance, goal.path_tolerance })
    {
      ASSERT_EQ(static_cast<int>(found.size()), rows.size()) << name;
      for (int k = 0; k < rows.size(); ++k)
      {
        EXPECT_EQ(found[k].name, static_cast<std::string>(rows[k][0])) << name;
        EXPECT_EQ(found[k].position, static_cast<double>(rows[k][1])) << name;
        EXPECT_EQ(found[k].velocity, static_cast<double>(rows[k][2])) << name;
        EXPECT_EQ(found[k].acceleration, static_cast<double>(rows[k][3])) << name;
      }
    }
  }
}

TEST(Execution, aControllerMayHaveItsOwnAllowedDuration)
{
  const Controller controller;
  const double more = 30.0, less = -0.5;
  for (const bool own : { true, false })
  {
    useLateController({ { "allowed_execution_duration_scaling", 1.0 }, { "allowed_goal_duration_margin", own ? more : less } });
    TrajectoryExecutionManager execution(loader().getModel(), nullptr);
    execution.setAllowedGoalDurationMargin(own ? less : more);
    pushMotion(execution, 0.5, 1.0);
    EXPECT_EQ(execution.executeAndWait(), own ? ExecutionStatus::SUCCEEDED : ExecutionStatus::TIMED_OUT);
  }
}

// As upstream's dynamic_reconfigure does: scaling of velocities is at most 10.
TEST(Execution, aParameterOutsideItsBoundsIsTheBoundAndOneOfAnotherKindIsIgnored)
{
  const Controller controller;
  useLateController();
  const std::string scaling = "~trajectory_execution/execution_velocity_scaling";
  const auto velocity = [&controller] {
    TrajectoryExecutionManager execution(loader().getModel(), nullptr);
    pushMotion(execution, 0.5, 0.1);
    EXPECT_EQ(execution.executeAndWait(), ExecutionStatus::SUCCEEDED);
    return controller.velocity();
  };
  EXPECT_DOUBLE_EQ(velocity(), 0.2);
  ros::param::set(scaling, 100.0);
  EXPECT_DOUBLE_EQ(velocity(), 2.0);
  ros::param::set(scaling, 3);
  EXPECT_DOUBLE_EQ(velocity(), 3 * 0.2);
  ros::param::set(scaling, "fast");
  EXPECT_DOUBLE_EQ(velocity(), 0.2);
  ros::param::del(scaling);
}

// As upstream: a trajectory begins where the robot is, so the robot must be heard of.
TEST(Execution, nothingMovesFromWhereNobodyHasHeardTheRobotIs)
{
  const Controller controller;
  useLateController();
  const auto deaf = std::make_shared<planning_scene_monitor::CurrentStateMonitor>(loader().getModel(), nullptr);
  deaf->startStateMonitor("joint_states_of_nobody");
  TrajectoryExecutionManager execution(loader().getModel(), deaf);
  pushMotion(execution, 0.5, 0.1);
  EXPECT_EQ(execution.executeAndWait(), ExecutionStatus::ABORTED);
  EXPECT_EQ(controller.goals(), 0);
  execution.setAllowedStartTolerance(0.0);  // then nobody asks
  pushMotion(execution, 0.5, 0.1);
  EXPECT_EQ(execution.executeAndWait(), ExecutionStatus::SUCCEEDED);
}

// ---------------------------------------------------------------- settings

// A client as dynparam and rqt_reconfigure are: what the server says of itself, and its service.
class Client
{
public:
  explicit Client(const std::string& server) : server_(ros::names::resolve(server)) {}
  template <typename Message>
  boost::shared_ptr<const Message> latched(const std::string& topic) const
  {
    return ros::topic::waitForMessage<Message>(server_ + "/" + topic, ros::Duration(20.0));
  }
  bool set(const dynamic_reconfigure::Config& config)
  {
    dynamic_reconfigure::Reconfigure call;
    call.request.config = config;
    const bool answered = ros::service::call(server_ + "/set_parameters", call);
    now = call.response.config;
    return answered;
  }
  template <typename Value>
  bool set(const std::string& name, Value value)
  {
    dynamic_reconfigure::Config config;
    dynamic_reconfigure::ConfigTools::appendParameter(config, name, value);
    return set(config);
  }
  dynamic_reconfigure::Config now;

private:
  std::string server_;
};

// What the parameter server has, as tools read it.
template <typename T>
T stored(const std::string& name)
{
  T value{};
  EXPECT_TRUE(ros::param::get("~" + name, value)) << name;
  return value;
}

// MoveIt 1's TrajectoryExecutionDynamicReconfigure.cfg: six parameters, their types, bounds and defaults.
TEST(Settings, aClientSeesTheParametersOfUpstream)
{
  const Controller controller;
  useLateController();
  const TrajectoryExecutionManager execution(loader().getModel(), nullptr);
  const auto description =
      Client("~/trajectory_execution").latched<dynamic_reconfigure::ConfigDescription>("parameter_descriptions");
  ASSERT_TRUE(description);
  ASSERT_EQ(description->groups.size(), 1u);
  std::vector<std::string> names, types;
  for (const auto& one : description->groups[0].parameters)
  {
    names.push_back(one.name);
    types.push_back(one.type);
    EXPECT_EQ(one.level, names.size());
  }
  EXPECT_EQ(names, (std::vector<std::string>{ "execution_duration_monitoring", "allowed_execution_duration_scaling",
                                              "allowed_goal_duration_margin", "execution_velocity_scaling",
                                              "allowed_start_tolerance", "wait_for_trajectory_completion" }));
  EXPECT_EQ(types, (std::vector<std::string>{ "bool", "double", "double", "double", "double", "bool" }));
  ASSERT_EQ(description->max.doubles.size(), 4u);
  EXPECT_EQ(description->max.doubles[3].value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(description->min.doubles[1].value, 0.1);
  EXPECT_EQ(description->dflt.doubles[0].value, 1.1);
  ASSERT_EQ(description->max.bools.size(), 2u);
  EXPECT_TRUE(description->max.bools[0].value && !description->min.bools[0].value && description->dflt.bools[0].value);
}

TEST(Settings, executionObeysThemFromTheNextTrajectoryOn)
{
  const Controller controller;
  useLateController();
  TrajectoryExecutionManager execution(loader().getModel(), nullptr);
  Client client("~/trajectory_execution");
  const auto run = [&execution](double duration) {
    pushMotion(execution, 0.5, duration);
    return execution.executeAndWait();
  };
  ASSERT_TRUE(client.set("execution_velocity_scaling", 4.0));
  EXPECT_EQ(stored<double>("trajectory_execution/execution_velocity_scaling"), 4.0);
  EXPECT_EQ(client.latched<dynamic_reconfigure::Config>("parameter_updates")->doubles[2].value, 4.0);
  EXPECT_EQ(run(0.1), ExecutionStatus::SUCCEEDED);
  EXPECT_DOUBLE_EQ(controller.velocity(), 4 * 0.2);
  ASSERT_TRUE(client.set("execution_velocity_scaling", 99.0));  // the bound beside it
  EXPECT_EQ(client.now.doubles[2].value, 10.0);
  ASSERT_TRUE(client.set("execution_velocity_scaling", std::nan("")));
  EXPECT_EQ(client.now.doubles[2].value, 10.0);
  ASSERT_TRUE(client.set("execution_velocity_scaling", 1.0));
  ASSERT_TRUE(client.set("no_such_parameter", 1.0));  // upstream's server answers, too
  EXPECT_EQ(client.now.doubles.size(), 4u);
  ASSERT_TRUE(client.set("execution_duration_monitoring", false));
  execution.setAllowedGoalDurationMargin(-0.5);  // too little for what follows
  EXPECT_EQ(run(1.0), ExecutionStatus::SUCCEEDED);
  ASSERT_TRUE(client.set("execution_duration_monitoring", true));
  execution.setAllowedGoalDurationMargin(-0.5);
  EXPECT_EQ(run(1.0), ExecutionStatus::TIMED_OUT);
  ASSERT_TRUE(client.set("allowed_goal_duration_margin", 0.5));
  EXPECT_EQ(run(1.0), ExecutionStatus::SUCCEEDED);
}

// A robot whose first joint turns by 0.01 rad/s, whatever its controller is told, and who executes plans on it.
struct TurningRobot
{
  TurningRobot()
  {
    useLateController({}, 6);
    state.name = { "joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6", "finger_joint" };
    state.position.assign(7, 0.0);
    timer = nh.createTimer(ros::Duration(0.01), [this](const ros::TimerEvent&) {
      state.header.stamp = ros::Time::now();
      state.position[0] = (state.header.stamp - start).toSec() * 0.01;
      joints.publish(state);
    });
    monitor->startStateMonitor("turning_joint_states");
    manager = std::make_shared<TrajectoryExecutionManager>(loader().getModel(), monitor->getStateMonitor());
    manager->setAllowedStartTolerance(0.0);
    execution = std::make_unique<plan_execution::PlanExecution>(monitor, manager);
  }

  // What was recorded of a plan of 1 s.
  robot_trajectory::RobotTrajectoryPtr run()
  {
    plan_execution::ExecutableMotionPlan plan;
    const auto path = std::make_shared<robot_trajectory::RobotTrajectory>(loader().getModel(), "manipulator");
    moveit_msgs::RobotTrajectory message;
    message.joint_trajectory.joint_names = { "joint_1" };
    message.joint_trajectory.points.resize(2);
    message.joint_trajectory.points[0].positions = message.joint_trajectory.points[1].positions = { 0.0 };
    message.joint_trajectory.points[1].time_from_start = ros::Duration(1.0);
    path->setRobotTrajectoryMsg(*monitor->getStateMonitor()->getCurrentState(), message);
    plan.plan_components_.emplace_back(path, "wave", std::vector<std::string>{ "late_controller" });
    EXPECT_EQ(execution->executeAndMonitor(plan).val, moveit_msgs::MoveItErrorCodes::SUCCESS);
    return plan.executed_trajectory_;
  }

  const Controller controller;
  ros::NodeHandle nh;
  ros::Publisher joints = nh.advertise<sensor_msgs::JointState>("turning_joint_states", 1, true);
  sensor_msgs::JointState state;
  ros::Time start = ros::Time::now();
  ros::Timer timer;
  const planning_scene_monitor::PlanningSceneMonitorPtr monitor =
      std::make_shared<planning_scene_monitor::PlanningSceneMonitor>("robot_description");
  std::shared_ptr<TrajectoryExecutionManager> manager;
  std::unique_ptr<plan_execution::PlanExecution> execution;
};

TEST(Settings, aPlanIsMadeAnewAsOftenAsTheySay)
{
  TurningRobot robot;
  EXPECT_EQ(robot.execution->getMaxReplanAttempts(), 5u);
  Client client("~/plan_execution");
  ASSERT_TRUE(client.set("max_replan_attempts", 2));
  EXPECT_EQ(stored<int>("plan_execution/max_replan_attempts"), 2);
  int attempts = 0;
  plan_execution::PlanExecution::Options options;
  options.replan_ = true;
  options.plan_callback_ = [&attempts](plan_execution::ExecutableMotionPlan& plan) {
    ++attempts;
    plan.error_code_.val = moveit_msgs::MoveItErrorCodes::MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE;
    return true;
  };
  plan_execution::ExecutableMotionPlan failing;
  robot.execution->planAndExecute(failing, options);
  EXPECT_EQ(attempts, 2);
}

TEST(Settings, whatIsExecutedIsRecordedAsTheySay)
{
  TurningRobot robot;
  EXPECT_TRUE(robot.run()->empty());
  ASSERT_TRUE(Client("~/plan_execution").set("record_trajectory_state_frequency", 20.0));
  const robot_trajectory::RobotTrajectoryPtr recorded = robot.run();
  ASSERT_GE(recorded->getWayPointCount(), 10u);  // of 20
  EXPECT_LE(recorded->getWayPointCount(), 25u);
  EXPECT_NEAR(recorded->getDuration(), 1.0, 0.3);
  const double gone =
      recorded->getLastWayPoint().getVariablePosition("joint_1") - recorded->getFirstWayPoint().getVariablePosition("joint_1");
  EXPECT_NEAR(gone, 0.01 * recorded->getDuration(), 1e-4);
}

TEST(Settings, aScenesMonitorPublishesAsTheySay)
{
  const auto monitor = std::make_shared<planning_scene_monitor::PlanningSceneMonitor>("robot_description");
  const auto other =
      std::make_shared<planning_scene_monitor::PlanningSceneMonitor>("robot_description");  // has a name of its own
  ASSERT_TRUE(ros::service::exists("~planning_scene_monitor1/set_parameters", false));
  const auto publishes = [] {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    return std::any_of(topics.begin(), topics.end(), [](const auto& topic) {
      return topic.name == ros::names::resolve(planning_scene_monitor::PlanningSceneMonitor::MONITORED_PLANNING_SCENE_TOPIC);
    });
  };
  EXPECT_FALSE(publishes());
  Client client("~/planning_scene_monitor");
  ASSERT_TRUE(client.set("publish_planning_scene", true));
  EXPECT_TRUE(publishes());
  EXPECT_EQ(monitor->getPlanningScenePublishingFrequency(), 4.0);
  ASSERT_TRUE(client.set("publish_planning_scene_hz", 1000.0));
  EXPECT_EQ(monitor->getPlanningScenePublishingFrequency(), 100.0);
  EXPECT_EQ(other->getPlanningScenePublishingFrequency(), 2.0);
  ASSERT_TRUE(client.set("publish_planning_scene", false));
  EXPECT_FALSE(publishes());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "execution");
  ros::AsyncSpinner spinner(4);
  spinner.start();
  return RUN_ALL_TESTS();
}
