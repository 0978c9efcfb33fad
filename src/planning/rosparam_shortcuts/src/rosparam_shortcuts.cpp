#include <rosparam_shortcuts/rosparam_shortcuts.h>

#include <cstdlib>
#include <sstream>

namespace rosparam_shortcuts
{
namespace
{
using Values = std::vector<double>;

std::string text(const Values& values) { return "[" + getDebugArrayString(values) + "]"; }
std::string text(const std::vector<std::string>& values) { return "[" + getDebugArrayString(values) + "]"; }
std::string text(const std::map<std::string, bool>& values)
{
  std::ostringstream all;
  for (const auto& value : values)
    all << value.first << ": " << value.second << ", ";
  return all.str();
}
template <typename Value>
std::string text(const Value& value)
{
  std::ostringstream all;
  all << value;
  return all.str();
}

template <typename Value>
bool read(const std::string& parent, const ros::NodeHandle& nh, const std::string& name, const char* kind, Value& value)
{
  const std::string where = nh.resolveName(name);
  if (!nh.hasParam(name))
  {
    ROS_ERROR_STREAM_NAMED(parent, "Missing parameter '" << where << "'.");
    return false;
  }
  Value found;
  if (!nh.getParam(name, found))
  {
    XmlRpc::XmlRpcValue other;
    nh.getParam(name, other);
    ROS_ERROR_STREAM_NAMED(parent, "Parameter '" << where << "' is to be " << kind << ", and is " << other.toXml() << ".");
    return false;
  }
  value = found;
  ROS_DEBUG_STREAM_NAMED(parent, "Loaded parameter '" << where << "' with value " << text(value));
  return true;
}

template <typename Value>
bool readList(const std::string& parent, const ros::NodeHandle& nh, const std::string& name, const char* kind, Value& values)
{
  const bool good = read(parent, nh, name, kind, values);
  if (good && values.empty())
    ROS_WARN_STREAM_NAMED(parent, "Empty vector for parameter '" << nh.resolveName(name) << "'.");
  return good;
}
}  // namespace

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, bool& value)
{
  return read(parent_name, nh, param_name, "true or false", value);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& params_namespace,
         std::map<std::string, bool>& parameters)
{
  return read(parent_name, nh, params_namespace, "names with true or false each", parameters);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, double& value)
{
  return read(parent_name, nh, param_name, "a number", value);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, std::vector<double>& values)
{
  return readList(parent_name, nh, param_name, "a list of numbers", values);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, int& value)
{
  return read(parent_name, nh, param_name, "a whole number", value);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, std::size_t& value)
{
  int number = 0;
  if (!read(parent_name, nh, param_name, "a whole number of 0 or more", number))
    return false;
  if (number < 0)
  {
    ROS_ERROR_STREAM_NAMED(parent_name,
                           "Parameter '" << nh.resolveName(param_name) << "' is to be 0 or more, and is " << number << ".");
    return false;
  }
  value = number;
  return true;
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, std::string& value)
{
  return read(parent_name, nh, param_name, "a text", value);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name,
         std::vector<std::string>& values)
{
  return readList(parent_name, nh, param_name, "a list of texts", values);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, ros::Duration& value)
{
  double seconds = 0.0;
  if (!read(parent_name, nh, param_name, "a number of seconds", seconds))
    return false;
  try
  {
    value = ros::Duration(seconds);
  }
  catch (const std::runtime_error& error)
  {
    ROS_ERROR_STREAM_NAMED(parent_name, "Parameter '" << nh.resolveName(param_name) << "' is no time: " << error.what());
    return false;
  }
  return true;
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, Eigen::Isometry3d& value)
{
  Values values;
  return readList(parent_name, nh, param_name, "a list of 6 or 7 numbers", values) &&
         convertDoublesToEigen(parent_name, values, value);
}

bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, geometry_msgs::Pose& value)
{
  Eigen::Isometry3d pose;
  if (!get(parent_name, nh, param_name, pose))
    return false;
  const Eigen::Quaterniond turn(pose.linear());
  value.position.x = pose.translation().x();
  value.position.y = pose.translation().y();
  value.position.z = pose.translation().z();
  value.orientation.x = turn.x();
  value.orientation.y = turn.y();
  value.orientation.z = turn.z();
  value.orientation.w = turn.w();
  return true;
}

namespace
{
template <typename Values>
std::string joined(const Values& values)
{
  std::ostringstream all;
  for (const auto& value : values)
    all << value << ",";
  return all.str();
}
}  // namespace

std::string getDebugArrayString(std::vector<double> values) { return joined(values); }
std::string getDebugArrayString(std::vector<std::string> values) { return joined(values); }

bool convertDoublesToEigen(const std::string& parent_name, std::vector<double> values, Eigen::Isometry3d& transform)
{
  Eigen::Quaterniond turn;
  if (values.size() == 6)
    turn = Eigen::AngleAxisd(values[3], Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(values[4], Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(values[5], Eigen::Vector3d::UnitZ());
  else if (values.size() == 7)
    turn = Eigen::Quaterniond(values[3], values[4], values[5], values[6]);
  else
  {
    ROS_ERROR_STREAM_NAMED(parent_name, "Invalid number of doubles provided for transform, size="
                                            << values.size()
                                            << ": it takes 6 (x, y, z, roll, pitch, yaw) or 7 (x, y, z, qw, qx, "
                                            << "qy, qz).");
    return false;
  }
  if (turn.norm() < 1e-6)
  {
    ROS_ERROR_STREAM_NAMED(parent_name, "The quaternion of a transform is 0: no turn at all is [1, 0, 0, 0], w first.");
    return false;
  }
  transform = Eigen::Translation3d(values[0], values[1], values[2]) * turn.normalized();
  return true;
}

void shutdownIfError(const std::string& parent_name, std::size_t error_count)
{
  if (!error_count)
    return;
  ROS_ERROR_STREAM_NAMED(parent_name, "Missing " << error_count
                                                 << " ros parameters that are required. Shutting down to prevent undefined "
                                                    "behaviors");
  ros::shutdown();
  std::exit(0);  // as upstream's: launch files that require the node end by it
}
}  // namespace rosparam_shortcuts
