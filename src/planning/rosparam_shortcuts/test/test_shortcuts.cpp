// Parameters of config/example.yaml and of shortcuts.test, through a real master.
#include <gtest/gtest.h>
#include <rosparam_shortcuts/rosparam_shortcuts.h>

namespace
{
using rosparam_shortcuts::get;

template <typename Value>
Value read(const std::string& name)
{
  Value value{};
  EXPECT_TRUE(get("test", ros::NodeHandle("example"), name, value)) << name;
  return value;
}

template <typename Value>
void refuse(const std::string& name, Value value)
{
  const Value before = value;
  EXPECT_FALSE(get("test", ros::NodeHandle("bad"), name, value)) << name;
  EXPECT_EQ(value, before) << name;
}

struct Shortcuts : testing::Test
{
  static void SetUpTestSuite() { ros::start(); }
};
}  // namespace

TEST_F(Shortcuts, kindsOfTheExample)
{
  EXPECT_EQ(read<double>("control_rate"), 100.0);
  EXPECT_EQ(read<int>("param1"), 20);
  EXPECT_EQ(read<double>("param1"), 20.0);
  EXPECT_EQ(read<std::size_t>("param2"), 30u);
  EXPECT_EQ(read<ros::Duration>("param3"), ros::Duration(1.0));
  EXPECT_EQ(read<std::vector<double>>("param5"), (std::vector<double>{ 1.1, 2.2, 3.3, 4.4 }));
  EXPECT_TRUE(read<Eigen::Isometry3d>("param6").isApprox(Eigen::Isometry3d(Eigen::Translation3d(2, 2, 2))));
  EXPECT_EQ(read<bool>("flags/one"), true);
  EXPECT_EQ((read<std::map<std::string, bool>>("flags")), (std::map<std::string, bool>{ { "one", true }, { "two", false } }));
  EXPECT_EQ(read<std::vector<std::string>>("names"), (std::vector<std::string>{ "a", "b" }));
}

// About x, then the new y, then the new z: the y axis ends at Rx(0.1) Ry(0.2) Rz(0.3) y.
TEST_F(Shortcuts, anglesTurnAboutTheNewAxes)
{
  Eigen::Isometry3d pose;
  ASSERT_TRUE(rosparam_shortcuts::convertDoublesToEigen("test", { 1, 2, 3, 0.1, 0.2, 0.3 }, pose));
  const Eigen::Vector3d y = pose.linear() * Eigen::Vector3d::UnitY();
  EXPECT_NEAR(y.x(), -std::cos(0.2) * std::sin(0.3), 1e-12);
  EXPECT_NEAR(y.y(), std::cos(0.1) * std::cos(0.3) - std::sin(0.1) * std::sin(0.2) * std::sin(0.3), 1e-12);
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(1, 2, 3));
  const auto message = read<geometry_msgs::Pose>("param7");
  EXPECT_NEAR(message.orientation.x, std::sin(1.57), 1e-12);
  EXPECT_EQ(message.position.z, 1.0);
}

TEST_F(Shortcuts, whatIsMissingOrOfAnotherKindIsRefused)
{
  refuse("nothing", 1.5);
  refuse("text", 1.5);
  refuse("text", std::vector<double>{ 1.0 });
  refuse("number", std::string("as before"));
  refuse("minus", std::size_t(7));
  refuse("number", std::vector<std::string>{ "as", "before" });
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  EXPECT_FALSE(get("test", ros::NodeHandle("bad"), "five", pose));
  EXPECT_FALSE(get("test", ros::NodeHandle("bad"), "no_turn", pose));
  EXPECT_TRUE(pose.isApprox(Eigen::Isometry3d::Identity()));
}

// Such a suite runs before the others: a node has threads, and a copy of it has not.
TEST(ShortcutsDeathTest, errorsEndTheProgram)
{
  rosparam_shortcuts::shutdownIfError("test", 0);
  EXPECT_EXIT(rosparam_shortcuts::shutdownIfError("test", 2), testing::ExitedWithCode(0), "");
}

TEST_F(Shortcuts, listsAsText)
{
  EXPECT_EQ(rosparam_shortcuts::getDebugArrayString(std::vector<double>{ 1, 2.5 }), "1,2.5,");
  EXPECT_EQ(rosparam_shortcuts::getDebugArrayString(std::vector<std::string>{ "a", "b" }), "a,b,");
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_shortcuts");
  return RUN_ALL_TESTS();
}
