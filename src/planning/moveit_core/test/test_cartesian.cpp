// Lines of a link that are followed to a precision. What is expected is worked out by hand for a gantry with a wrist of three
// axes: R = Rz(yaw) Ry(pitch) Rx(roll), and the tool 0.2 m along R's x axis from where the gantry is.
#include <gtest/gtest.h>
#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_state/cartesian_interpolator.h>
#include <ros/time.h>
#include <tf2_eigen/tf2_eigen.h>

using namespace moveit::core;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
const Isometry3d TOOL(Eigen::Translation3d(0.2, 0.0, 0.0));
const Vector3d AXIS = Vector3d(1.0, 1.0, 1.0).normalized();
const MaxEEFStep ONE_STEP(10.0, 10.0);

Isometry3d forward(const std::vector<double>& q)
{
  return Eigen::Translation3d(q[0], q[1], q[2]) * Eigen::AngleAxisd(q[3], Vector3d::UnitZ()) *
         Eigen::AngleAxisd(q[4], Vector3d::UnitY()) * Eigen::AngleAxisd(q[5], Vector3d::UnitX()) * TOOL;
}

std::vector<double> inverse(const Isometry3d& tool)
{
  const Isometry3d wrist = tool * TOOL.inverse();
  const Eigen::Matrix3d R = wrist.linear();
  const Vector3d p = wrist.translation();
  return { p.x(), p.y(), p.z(), std::atan2(R(1, 0), R(0, 0)), -std::asin(R(2, 0)), std::atan2(R(2, 1), R(2, 2)) };
}

class Solver : public kinematics::KinematicsBase
{
public:
  using Options = kinematics::KinematicsQueryOptions;
  using Values = std::vector<double>;
  using Pose = geometry_msgs::Pose;
  using Code = moveit_msgs::MoveItErrorCodes;

  explicit Solver(const RobotModel& robot) { storeValues(robot, "gantry", "base", { "tool" }, 0.1); }
  bool getPositionIK(const Pose& pose, const Values& seed, Values& q, Code& code, const Options& options) const override
  {
    return searchPositionIK(pose, seed, 0.0, q, IKCallbackFn(), code, options);
  }
  bool searchPositionIK(const Pose& pose, const Values& seed, double time, Values& q, Code& code,
                        const Options& options) const override
  {
    return searchPositionIK(pose, seed, time, q, IKCallbackFn(), code, options);
  }
  bool searchPositionIK(const Pose& pose, const Values& seed, double time, const Values&, Values& q, Code& code,
                        const Options& options) const override
  {
    return searchPositionIK(pose, seed, time, q, IKCallbackFn(), code, options);
  }
  bool searchPositionIK(const Pose& pose, const Values& seed, double time, const Values&, Values& q, const IKCallbackFn& valid,
                        Code& code, const Options& options) const override
  {
    return searchPositionIK(pose, seed, time, q, valid, code, options);
  }
  bool searchPositionIK(const Pose& pose, const Values&, double, Values& q, const IKCallbackFn& valid, Code& code,
                        const Options&) const override
  {
    Isometry3d tool;
    tf2::fromMsg(pose, tool);
    q = inverse(tool);
    code.val = Code::SUCCESS;
    if (valid)
      valid(pose, q, code);
    return code.val == Code::SUCCESS;
  }
  bool getPositionFK(const std::vector<std::string>&, const Values&, std::vector<Pose>&) const override { return false; }
  const std::vector<std::string>& getJointNames() const override { return joints_; }
  const std::vector<std::string>& getLinkNames() const override { return tip_frames_; }

private:
  std::vector<std::string> joints_{ "x", "y", "z", "yaw", "pitch", "roll" };
};

std::string joint(const std::string& name, const std::string& kind, const std::string& from, const std::string& axis)
{
  return "<link name='" + name + "_link'/><joint name='" + name + "' type='" + kind + "'><parent link='" + from +
         "'/><child link='" + name + "_link'/><axis xyz='" + axis +
         "'/><limit lower='-3' upper='3' velocity='1' effort='1'/></joint>";
}

RobotModelPtr makeGantry()
{
  const std::string text = "<robot name='gantry'><link name='base'/>" + joint("x", "prismatic", "base", "1 0 0") +
                           joint("y", "prismatic", "x_link", "0 1 0") + joint("z", "prismatic", "y_link", "0 0 1") +
                           joint("yaw", "revolute", "z_link", "0 0 1") + joint("pitch", "revolute", "yaw_link", "0 1 0") +
                           joint("roll", "revolute", "pitch_link", "1 0 0") +
                           "<link name='tool'/><joint name='mount' type='fixed'><parent link='roll_link'/><child link='tool'/>"
                           "<origin xyz='0.2 0 0'/></joint></robot>";
  const auto urdf_model = std::make_shared<urdf::Model>();
  urdf_model->initString(text);
  const auto srdf_model = std::make_shared<srdf::Model>();
  srdf_model->initString(*urdf_model,
                         "<robot name='gantry'><group name='gantry'><chain base_link='base' tip_link='tool'/></group></robot>");
  const auto robot = std::make_shared<RobotModel>(urdf_model, srdf_model);
  robot->setKinematicsAllocators(
      { { "gantry", [robot = robot.get()](const JointModelGroup*) { return std::make_shared<Solver>(*robot); } } });
  return robot;
}

class Lines : public testing::Test
{
protected:
  Lines()
  {
    start_.setToDefaultValues();
    start_.setJointGroupPositions(group_, std::vector<double>{ 0.1, -0.2, 0.3, 0.4, -0.3, 0.2 });
  }

  // To the side by 0.3 m, and 1.2 rad about an axis that none of the joints has.
  Isometry3d target() const { return on(1.0); }
  Isometry3d on(double share) const
  {
    const Isometry3d from = forward({ 0.1, -0.2, 0.3, 0.4, -0.3, 0.2 });
    return Eigen::Translation3d(0.0, 0.3 * share, 0.0) * from * Eigen::AngleAxisd(1.2 * share, AXIS);
  }

  double follow(const CartesianPrecision& precision, const MaxEEFStep& most = ONE_STEP)
  {
    return CartesianInterpolator::computeCartesianPath(&start_, group_, states_, tool_, target(), true, most, precision);
  }

  std::vector<double> joints(std::size_t i) const
  {
    std::vector<double> values;
    states_[i]->copyJointGroupPositions(group_, values);
    return values;
  }

  // The most, over all pairs of states that follow each other, half-way between them.
  void measure(double& translation, double& rotation) const
  {
    translation = rotation = 0.0;
    for (std::size_t i = 1; i < states_.size(); ++i)
    {
      std::vector<double> before = joints(i - 1), after = joints(i), middle(6);
      for (std::size_t k = 0; k < 6; ++k)
        middle[k] = 0.5 * (before[k] + after[k]);
      const Isometry3d from = forward(before), to = forward(after), is = forward(middle);
      const Vector3d point = 0.5 * (from.translation() + to.translation());
      const Eigen::Quaterniond turn = Eigen::Quaterniond(from.linear()).slerp(0.5, Eigen::Quaterniond(to.linear()));
      translation = std::max(translation, (is.translation() - point).norm());
      rotation = std::max(rotation, turn.angularDistance(Eigen::Quaterniond(is.linear())));
    }
  }

  const RobotModelPtr robot_ = makeGantry();
  const JointModelGroup* const group_ = robot_->getJointModelGroup("gantry");
  const LinkModel* const tool_ = robot_->getLinkModel("tool");
  RobotState start_{ robot_ };
  std::vector<RobotStatePtr> states_;
};

CartesianPrecision precise(double translational, double rotational)
{
  CartesianPrecision precision;
  precision.translational = translational;
  precision.rotational = rotational;
  return precision;
}
}  // namespace

TEST_F(Lines, valuesUnlessOthersAreAskedFor)
{
  const CartesianPrecision precision;  // as MoveIt's
  EXPECT_EQ(precision.translational, 0.001);
  EXPECT_EQ(precision.rotational, 0.01);
  EXPECT_EQ(precision.max_resolution, 1e-5);
}

// The first is what evenly moved joints do without any state between the ends: too far off for the others.
TEST_F(Lines, stayWithinThePrecision)
{
  double translation, rotation;
  EXPECT_EQ(follow(precise(1.0, 3.0)), 1.0);
  EXPECT_EQ(states_.size(), 2u);
  measure(translation, rotation);
  EXPECT_GT(translation, 0.01);
  EXPECT_GT(rotation, 0.03);

  EXPECT_EQ(follow(CartesianPrecision()), 1.0);
  const std::size_t normal = states_.size();
  measure(translation, rotation);
  EXPECT_LE(translation, 0.001 + 1e-9);
  EXPECT_LE(rotation, 0.01 + 1e-7);

  EXPECT_EQ(follow(precise(0.0001, 3.0)), 1.0);
  EXPECT_GT(states_.size(), normal);
  measure(translation, rotation);
  EXPECT_LE(translation, 0.0001 + 1e-9);

  EXPECT_EQ(follow(precise(1.0, 0.0005)), 1.0);
  EXPECT_GT(states_.size(), normal);
  measure(translation, rotation);
  EXPECT_LE(rotation, 0.0005 + 1e-7);
}

TEST_F(Lines, goEvenlyFromTheStartToTheTarget)
{
  ASSERT_EQ(follow(CartesianPrecision()), 1.0);
  double before = -1.0;
  for (std::size_t i = 0; i < states_.size(); ++i)
  {
    const Isometry3d is = forward(joints(i));
    const double share = (is.translation() - on(0.0).translation()).y() / 0.3;
    EXPECT_GT(share, before);
    EXPECT_TRUE(is.isApprox(on(share), 1e-9)) << "state " << i;
    before = share;
  }
  EXPECT_NEAR(before, 1.0, 1e-9);
  EXPECT_TRUE(forward(joints(0)).isApprox(on(0.0), 1e-12));
  EXPECT_TRUE(start_.getGlobalLinkTransform(tool_).isApprox(on(0.0), 1e-9));  // it is not changed
}

TEST_F(Lines, haveStepsAsShortAsIsAskedFor)
{
  ASSERT_EQ(follow(precise(1.0, 3.0), MaxEEFStep(0.04, 0.0)), 1.0);
  EXPECT_EQ(states_.size(), 9u);  // 0.3 m / 0.04 m: 8 steps
  ASSERT_EQ(follow(precise(1.0, 3.0), MaxEEFStep(0.0, 0.25)), 1.0);
  EXPECT_EQ(states_.size(), 6u);  // 1.2 rad / 0.25 rad: 5 steps
}

TEST_F(Lines, endWhereNoStepIsShortEnough)
{
  CartesianPrecision never = precise(0.0, 0.0);
  never.max_resolution = 0.1;
  EXPECT_EQ(follow(never), 0.0);
  EXPECT_EQ(states_.size(), 1u);
}

TEST_F(Lines, endBeforeAStateThatIsNotValid)
{
  const auto valid = [this](RobotState*, const JointModelGroup*, const double* q) {
    return forward(std::vector<double>(q, q + 6)).translation().y() < on(0.5).translation().y();
  };
  const double way = CartesianInterpolator::computeCartesianPath(&start_, group_, states_, tool_, Vector3d(0.0, 0.3, 0.0), true,
                                                                 MaxEEFStep(0.04), CartesianPrecision(), valid);
  EXPECT_NEAR(way, 3.0 / 8.0 * 0.3, 1e-9);  // the fourth of eight steps is at the half
  EXPECT_EQ(states_.size(), 4u);            // a gantry needs none between them
}

TEST_F(Lines, ofTheToolsOwnAxesAndOfAFrameAwayFromIt)
{
  const double way = CartesianInterpolator::computeCartesianPath(&start_, group_, states_, tool_, Vector3d::UnitX(), false, 0.1,
                                                                 ONE_STEP, CartesianPrecision());
  EXPECT_NEAR(way, 0.1, 1e-12);
  EXPECT_TRUE(forward(joints(states_.size() - 1)).isApprox(on(0.0) * Eigen::Translation3d(0.1, 0.0, 0.0), 1e-9));

  // A turn about the end of a bit in the tool, and back: the end stays where it is.
  const Isometry3d bit(Eigen::Translation3d(0.1, 0.0, 0.0));
  const Isometry3d turn(Eigen::AngleAxisd(0.8, Vector3d::UnitZ()));
  const double share = CartesianInterpolator::computeCartesianPath(
      &start_, group_, states_, tool_, EigenSTL::vector_Isometry3d{ turn, turn.inverse() }, false, ONE_STEP,
      CartesianPrecision(), GroupStateValidityCallbackFn(), kinematics::KinematicsQueryOptions(), bit);
  EXPECT_EQ(share, 1.0);
  ASSERT_GT(states_.size(), 4u);
  for (std::size_t i = 0; i < states_.size(); ++i)
    EXPECT_TRUE((forward(joints(i)) * bit).translation().isApprox((on(0.0) * bit).translation(), 1e-9)) << "state " << i;
  EXPECT_TRUE(forward(joints(states_.size() - 1)).isApprox(on(0.0), 1e-9));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
