// While a thread of roscpp joins a trajectory, which takes as long as the trajectory is long, the control loop goes on.
#include <atomic>
#include <condition_variable>
#include <future>
#include <thread>

#include <actionlib/client/simple_action_client.h>
#include <gtest/gtest.h>
#include <hardware_interface/robot_hw.h>
#include <joint_trajectory_controller/joint_trajectory_controller.h>
#include <trajectory_interface/quintic_spline_segment.h>

namespace
{

/// Holds up whoever makes a piece of a trajectory outside of the control loop.
class Gate
{
public:
  void close()
  {
    const std::lock_guard<std::mutex> locked(mutex_);
    closed_ = true;
    loop_ = std::this_thread::get_id();
  }
  void open()
  {
    const std::lock_guard<std::mutex> locked(mutex_);
    closed_ = held_ = false;
    changed_.notify_all();
  }
  void pass()
  {
    std::unique_lock<std::mutex> locked(mutex_);
    if (std::this_thread::get_id() == loop_ || !closed_)
      return;
    held_ = true;
    changed_.notify_all();
    changed_.wait(locked, [this] { return !closed_; });
  }
  bool holdsSomebody()
  {
    std::unique_lock<std::mutex> locked(mutex_);
    return changed_.wait_for(locked, std::chrono::seconds(20), [this] { return held_; });
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false, held_ = false;
  std::thread::id loop_;
};
Gate gate;

class HeldSpline : public trajectory_interface::QuinticSplineSegment<double>
{
public:
  void init(double start_time, const State& start_state, double end_time, const State& end_state)
  {
    gate.pass();
    QuinticSplineSegment::init(start_time, start_state, end_time, end_state);
  }
};

class Controller
  : public joint_trajectory_controller::JointTrajectoryController<HeldSpline, hardware_interface::PositionJointInterface>
{
public:
  bool begin(hardware_interface::PositionJointInterface* hw, ros::NodeHandle& root, ros::NodeHandle& own)
  {
    if (!init(hw, root, own))
      return false;
    state_ = ControllerState::INITIALIZED;
    return startRequest(ros::Time(100.0));
  }
};

typedef actionlib::SimpleActionClient<control_msgs::FollowJointTrajectoryAction> Client;
typedef control_msgs::FollowJointTrajectoryResult Result;

/// Joint p1 is where it is commanded to be, but where it is stuck.
class UpdateWaits : public testing::Test
{
protected:
  UpdateWaits() : own_("held"), client_("held/follow_joint_trajectory", false), spinner_(3)
  {
    states_.registerHandle(hardware_interface::JointStateHandle("p1", &position_, &velocity_, &effort_));
    joints_.registerHandle(hardware_interface::JointHandle(states_.getHandle("p1"), &command_));
    own_.setParam("joints", std::vector<std::string>{ "p1" });
    own_.setParam("constraints/p1/trajectory", 0.2);
    own_.setParam("constraints/p1/goal", 0.01);
  }

  void SetUp() override
  {
    ASSERT_TRUE(controller_.begin(&joints_, root_, own_));
    spinner_.start();
    ASSERT_TRUE(client_.waitForServer(ros::Duration(20.0)));
  }

  void TearDown() override
  {
    gate.open();
    spinner_.stop();
  }

  void cycles(int count)
  {
    const ros::Duration period(0.01);
    for (int i = 0; i < count; ++i)
    {
      now_ += period;
      controller_.updateRequest(now_, period);
      if (!stuck_)
        position_ = command_;
    }
  }

  /// To `position` within `seconds`.
  control_msgs::FollowJointTrajectoryGoal goal(double position, double seconds)
  {
    control_msgs::FollowJointTrajectoryGoal made;
    made.trajectory.joint_names = { "p1" };
    made.trajectory.points.resize(1);
    made.trajectory.points[0].positions = { position };
    made.trajectory.points[0].velocities = { 0.0 };
    made.trajectory.points[0].time_from_start = ros::Duration(seconds);
    return made;
  }

  template <class Done>
  bool cyclesUntil(Done done)
  {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
    while (!done() && ros::WallTime::now() < end)
    {
      cycles(1);
      std::this_thread::yield();
    }
    return done();
  }

  bool ends()
  {
    return cyclesUntil([this] { return client_.getState().isDone(); });
  }

  ros::NodeHandle root_, own_;
  hardware_interface::JointStateInterface states_;
  hardware_interface::PositionJointInterface joints_;
  double position_ = 0.0, velocity_ = 0.0, effort_ = 0.0, command_ = 0.0;
  bool stuck_ = false;
  ros::Time now_ = ros::Time(100.0);
  Controller controller_;
  Client client_;
  ros::AsyncSpinner spinner_;
};

TEST_F(UpdateWaits, forNoGoalThatIsBeingJoined)
{
  gate.close();
  client_.sendGoal(goal(1.0, 1.0));
  ASSERT_TRUE(gate.holdsSomebody());
  // In a thread of its own, so that a loop that waits fails here and does not hang.
  std::future<void> loop = std::async(std::launch::async, [this] { cycles(10); });
  const bool went_on = loop.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
  gate.open();
  loop.wait();
  EXPECT_TRUE(went_on) << "update() waited for the thread that joins a trajectory";
  ASSERT_TRUE(ends());
  EXPECT_EQ(client_.getResult()->error_code, int(Result::SUCCESSFUL));
  EXPECT_NEAR(position_, 1.0, 1e-9);
}

TEST_F(UpdateWaits, andAGoalIsFollowedThoughTheOneBeforeFailedMeanwhile)
{
  client_.sendGoal(goal(1.0, 1.0));
  ASSERT_TRUE(cyclesUntil([this] { return position_ > 0.1; }));
  Client other("held/follow_joint_trajectory", false);
  ASSERT_TRUE(other.waitForServer(ros::Duration(20.0)));
  gate.close();
  other.sendGoal(goal(-0.5, 2.0));
  ASSERT_TRUE(gate.holdsSomebody());
  stuck_ = true;  // the first goal leaves its tolerance: the joint is to stay where it is
  ASSERT_TRUE(ends());
  EXPECT_EQ(client_.getResult()->error_code, int(Result::PATH_TOLERANCE_VIOLATED));
  stuck_ = false;
  gate.open();
  ASSERT_TRUE(cyclesUntil([&other] { return other.getState().isDone(); }));
  EXPECT_EQ(other.getResult()->error_code, int(Result::SUCCESSFUL)) << other.getResult()->error_string;
  EXPECT_NEAR(position_, -0.5, 1e-9);
}

TEST_F(UpdateWaits, andAStoppedControllerTakesNoGoalThatWasBeingJoined)
{
  gate.close();
  client_.sendGoal(goal(1.0, 1.0));
  ASSERT_TRUE(gate.holdsSomebody());
  ASSERT_TRUE(controller_.stopRequest(now_));
  gate.open();
  ASSERT_TRUE(client_.waitForResult(ros::Duration(20.0)));
  EXPECT_NE(client_.getState(), actionlib::SimpleClientGoalState::SUCCEEDED);
  ASSERT_TRUE(controller_.startRequest(now_));
  cycles(300);
  EXPECT_NEAR(position_, 0.0, 1e-9);
}

TEST_F(UpdateWaits, forNoAnswerAboutALongTrajectory)
{
  ros::ServiceClient query = own_.serviceClient<control_msgs::QueryTrajectoryState>("query_state");
  client_.sendGoal(goal(1.0, 1.0));
  ASSERT_TRUE(cyclesUntil([this] { return position_ > 0.5; }));
  control_msgs::QueryTrajectoryState asked;
  asked.request.time = now_;
  ASSERT_TRUE(query.call(asked));
  ASSERT_EQ(asked.response.position.size(), 1u);
  EXPECT_NEAR(asked.response.position[0], position_, 1e-9);  // of the last cycle
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "update_waits");
  ros::NodeHandle alive;
  return RUN_ALL_TESTS();
}
