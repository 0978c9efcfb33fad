// Every kind of parameter that can be read: roslaunch rosparam_shortcuts example.launch
#include <rosparam_shortcuts/rosparam_shortcuts.h>

int main(int argc, char** argv)
{
  const std::string name = "example";
  ros::init(argc, argv, name);
  const ros::NodeHandle nh(name);

  double control_rate = 0.0;
  int count = 0;
  std::size_t size = 0;
  ros::Duration duration;
  Eigen::Isometry3d by_angles, by_quaternion;
  std::vector<double> numbers;
  geometry_msgs::Pose pose, other_pose;

  std::size_t error = 0;
  error += !rosparam_shortcuts::get(name, nh, "control_rate", control_rate);
  error += !rosparam_shortcuts::get(name, nh, "param1", count);
  error += !rosparam_shortcuts::get(name, nh, "param2", size);
  error += !rosparam_shortcuts::get(name, nh, "param3", duration);
  error += !rosparam_shortcuts::get(name, nh, "param4", by_angles);
  error += !rosparam_shortcuts::get(name, nh, "param5", numbers);
  error += !rosparam_shortcuts::get(name, nh, "param6", by_quaternion);
  error += !rosparam_shortcuts::get(name, nh, "param7", pose);
  error += !rosparam_shortcuts::get(name, nh, "param8", other_pose);
  rosparam_shortcuts::shutdownIfError(name, error);

  ROS_INFO_STREAM_NAMED(name, "control rate: " << control_rate << ", whole numbers: " << count << " and " << size);
  ROS_INFO_STREAM_NAMED(name, "duration: " << duration << " s, numbers: " << rosparam_shortcuts::getDebugArrayString(numbers));
  ROS_INFO_STREAM_NAMED(name, "poses:\n" << by_angles.matrix() << "\n" << by_quaternion.matrix() << "\n" << pose << other_pose);
  return 0;
}
