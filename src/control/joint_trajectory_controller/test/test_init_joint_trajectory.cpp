// What a message becomes beside a motion that is running.
#include <limits>

#include <gtest/gtest.h>
#include <joint_trajectory_controller/init_joint_trajectory.h>
#include <joint_trajectory_controller/stop_trajectory_builder.h>
#include <trajectory_interface/quintic_spline_segment.h>

namespace jtc = joint_trajectory_controller;

namespace
{

typedef jtc::JointTrajectorySegment<trajectory_interface::QuinticSplineSegment<double>> Segment;
typedef std::vector<std::vector<Segment>> Trajectory;
typedef jtc::InitJointTrajectoryOptions<Trajectory> Options;

/// As one that no client waits for.
Options::RealtimeGoalHandlePtr goal()
{
  actionlib::ServerGoalHandle<control_msgs::FollowJointTrajectoryAction> nobodys;
  return Options::RealtimeGoalHandlePtr(new Options::RealtimeGoalHandle(nobodys));
}

trajectory_msgs::JointTrajectoryPoint point(double time, const std::vector<double>& positions)
{
  trajectory_msgs::JointTrajectoryPoint made;
  made.time_from_start = ros::Duration(time);
  made.positions = positions;
  made.velocities.assign(positions.size(), 0.0);
  return made;
}

trajectory_msgs::JointTrajectory message(const std::vector<std::string>& joints, double stamp = 0.0)
{
  trajectory_msgs::JointTrajectory made;
  made.joint_names = joints;
  made.header.stamp = ros::Time(stamp);
  made.points = { point(1.0, std::vector<double>(joints.size(), 1.0)), point(2.0, std::vector<double>(joints.size(), 2.0)) };
  return made;
}

/// Two joints at rest at 0 since 0 s; the second turns without end.
class InitJointTrajectory : public testing::Test
{
protected:
  InitJointTrajectory() : running_(2, std::vector<Segment>(1, Segment(0.0, Segment::State(1u), 0.0, Segment::State(1u))))
  {
    options_.current_trajectory = &running_;
    options_.joint_names = &joints_;
    options_.angle_wraparound = &wraps_;
    options_.other_time_base = &uptime_;
    options_.error_string = &error_;
  }

  Trajectory make(const trajectory_msgs::JointTrajectory& msg)
  {
    return jtc::initJointTrajectory<Trajectory>(msg, now_, options_);
  }

  double at(const std::vector<Segment>& segments, double uptime)
  {
    Segment::State state(1u);
    EXPECT_NE(trajectory_interface::sample(segments, uptime, state), segments.end());
    return state.position[0];
  }

  std::vector<std::string> joints_ = { "a", "b" };
  std::vector<bool> wraps_ = { false, true };
  Trajectory running_;
  ros::Time now_ = ros::Time(100.0), uptime_ = ros::Time(10.0);
  Options options_;
  std::string error_;
};

TEST_F(InitJointTrajectory, a_message_without_a_stamp_begins_at_once_by_a_bridge)
{
  const Trajectory made = make(message(joints_));
  ASSERT_EQ(made.size(), 2u);
  ASSERT_EQ(made[0].size(), 3u);  // the rest before, the bridge, between the points
  EXPECT_DOUBLE_EQ(made[0][1].startTime(), 10.0);
  EXPECT_DOUBLE_EQ(made[0][1].endTime(), 11.0);
  EXPECT_DOUBLE_EQ(made[0][1].timeFromStart(), 0.0);
  EXPECT_DOUBLE_EQ(made[0][2].timeFromStart(), 1.0);
  EXPECT_DOUBLE_EQ(at(made[0], 10.5), 0.5);
  EXPECT_DOUBLE_EQ(at(made[1], 20.0), 2.0);
}

TEST_F(InitJointTrajectory, a_message_for_later_leaves_the_motion_until_then)
{
  const Trajectory made = make(message(joints_, 103.0));
  EXPECT_DOUBLE_EQ(made[0][1].startTime(), 13.0);
  EXPECT_DOUBLE_EQ(at(made[0], 12.9), 0.0);
  EXPECT_DOUBLE_EQ(at(made[0], 14.0), 1.0);
}

TEST_F(InitJointTrajectory, points_of_the_past_are_dropped_even_from_before_the_controller_was_started)
{
  uptime_ = ros::Time(0.1);
  const Trajectory made = make(message(joints_, 98.5));
  ASSERT_EQ(made[0].size(), 2u);
  EXPECT_DOUBLE_EQ(made[0][1].startTime(), 0.1);
  EXPECT_DOUBLE_EQ(made[0][1].endTime(), 0.6);
  EXPECT_TRUE(make(message(joints_, 98.0)).empty());
  EXPECT_NE(error_.find("Dropping all 2 trajectory points"), std::string::npos) << error_;
}

TEST_F(InitJointTrajectory, names_give_the_order)
{
  trajectory_msgs::JointTrajectory msg = message({ "b", "a" });
  msg.points.assign(1, point(1.0, { 0.5, -0.5 }));
  const Trajectory made = make(msg);
  EXPECT_DOUBLE_EQ(at(made[0], 11.0), -0.5);
  EXPECT_DOUBLE_EQ(at(made[1], 11.0), 0.5);
}

TEST_F(InitJointTrajectory, a_joint_that_is_not_named_keeps_its_motion)
{
  EXPECT_TRUE(make(message({ "b" })).empty());
  EXPECT_NE(error_.find("missing: a"), std::string::npos) << error_;
  options_.allow_partial_joints_goal = true;
  const Trajectory made = make(message({ "b" }));
  EXPECT_EQ(made[0].size(), 1u);
  EXPECT_DOUBLE_EQ(at(made[0], 12.0), 0.0);
  EXPECT_DOUBLE_EQ(at(made[1], 12.0), 2.0);
}

// As in upstream's: a goal is not watched before it begins.
TEST_F(InitJointTrajectory, what_is_kept_until_the_message_begins_belongs_to_whom_it_did)
{
  options_.rt_goal_handle = goal();
  options_.allow_partial_joints_goal = true;
  const Trajectory made = make(message({ "b" }, 103.0));
  ASSERT_EQ(made[1].size(), 3u);
  EXPECT_FALSE(made[1][0].getGoalHandle());
  EXPECT_EQ(made[1][1].getGoalHandle(), options_.rt_goal_handle);
  EXPECT_EQ(made[1][2].getGoalHandle(), options_.rt_goal_handle);
  ASSERT_EQ(made[0].size(), 1u) << "not named";
  EXPECT_EQ(made[0][0].getGoalHandle(), options_.rt_goal_handle);
}

TEST(Builders, leave_the_life_of_a_goal_to_others)
{
  Options::RealtimeGoalHandlePtr handle = goal();
  const Segment::State rest(1u);
  Trajectory made(1, std::vector<Segment>(1, Segment(0.0, rest, 0.0, rest)));
  jtc::StopTrajectoryBuilder<trajectory_interface::QuinticSplineSegment<double>> builder(1.0, rest);
  builder.setStartTime(0.0)->setGoalHandle(handle);
  EXPECT_EQ(handle.use_count(), 1);
  ASSERT_TRUE(builder.buildTrajectory(&made));
  EXPECT_EQ(made[0][0].getGoalHandle(), handle);
  EXPECT_EQ(handle.use_count(), 2) << "the segment's";
  builder.reset();
  ASSERT_TRUE(builder.setStartTime(0.0)->buildTrajectory(&made));
  EXPECT_FALSE(made[0][0].getGoalHandle());
  EXPECT_EQ(handle.use_count(), 1);
}

TEST_F(InitJointTrajectory, joints_without_end_take_the_short_way)
{
  trajectory_msgs::JointTrajectory msg = message(joints_);
  msg.points.assign(1, point(1.0, { 4.5 * M_PI, 4.5 * M_PI }));
  const Trajectory made = make(msg);
  EXPECT_NEAR(at(made[0], 11.0), 4.5 * M_PI, 1e-12);
  EXPECT_NEAR(at(made[1], 11.0), 0.5 * M_PI, 1e-12);
}

TEST_F(InitJointTrajectory, what_cannot_be_executed_is_empty_and_says_why)
{
  struct Case
  {
    const char* why;
    trajectory_msgs::JointTrajectory msg;
  };
  std::vector<Case> cases = {
    { "unknown: elbow", message({ "a", "elbow" }) },  { "named more than once: a", message({ "a", "a" }) },
    { "joint_names is empty", message({}) },          { "strictly increasing", message(joints_) },
    { "1 positions for 2 joints", message(joints_) }, { "1 velocities for 2 joints", message(joints_) },
    { "positions that are not", message(joints_) },   { "velocities beyond", message(joints_) }
  };
  cases[3].msg.points[1].time_from_start = cases[3].msg.points[0].time_from_start;
  cases[4].msg.points[0].positions.pop_back();
  cases[5].msg.points[0].velocities.pop_back();
  cases[6].msg.points[1].positions[1] = std::numeric_limits<double>::quiet_NaN();
  cases[7].msg.points[1].velocities[0] = 1e13;
  for (const Case& one : cases)
  {
    EXPECT_TRUE(make(one.msg).empty()) << one.why;
    EXPECT_NE(error_.find(one.why), std::string::npos) << one.why << " is not in: " << error_;
  }
}

TEST_F(InitJointTrajectory, without_a_running_motion_there_is_no_bridge)
{
  const Trajectory made = jtc::initJointTrajectory<Trajectory>(message({ "x" }), now_);
  ASSERT_EQ(made.size(), 1u);
  ASSERT_EQ(made[0].size(), 1u);
  EXPECT_DOUBLE_EQ(made[0][0].startTime(), 101.0);
}

TEST(Tolerances, an_error_that_is_not_a_number_is_over_any_limit_and_under_none)
{
  Segment::State error(1u);
  error.position[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(checkStateTolerancePerJoint(error, jtc::StateTolerances<double>(0.1)));
  EXPECT_TRUE(checkStateTolerancePerJoint(error, jtc::StateTolerances<double>()));
  error.position[0] = -0.1;
  EXPECT_TRUE(checkStateTolerance(error, { jtc::StateTolerances<double>(0.1) }));
  EXPECT_FALSE(checkStateTolerance(error, { jtc::StateTolerances<double>(0.09) }));
}

TEST(Tolerances, a_goal_replaces_switches_off_or_leaves_them)
{
  control_msgs::FollowJointTrajectoryGoal goal;
  control_msgs::JointTolerance asked;
  asked.name = "b";
  asked.position = 0.5;
  asked.velocity = -1.0;
  goal.path_tolerance.push_back(asked);
  goal.goal_time_tolerance = ros::Duration(-1.0);
  jtc::SegmentTolerances<double> limits(2);
  limits.state_tolerance.assign(2, jtc::StateTolerances<double>(0.1, 0.2, 0.3));
  limits.goal_time_tolerance = 1.0;
  jtc::updateSegmentTolerances(goal, { "a", "b" }, limits);
  EXPECT_EQ(limits.state_tolerance[0].position, 0.1);
  EXPECT_EQ(limits.state_tolerance[1].position, 0.5);
  EXPECT_EQ(limits.state_tolerance[1].velocity, 0.0);
  EXPECT_EQ(limits.state_tolerance[1].acceleration, 0.3);
  EXPECT_EQ(limits.goal_time_tolerance, 0.0);
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
