#include "execution_parameters.hpp"

#include <ros/console.h>

#include <optional>

#include "log_names.hpp"

namespace trajectory_execution_manager
{
namespace
{
using Value = XmlRpc::XmlRpcValue;

std::optional<double> number(Value& value)
{
  if (value.getType() == Value::TypeDouble)
    return static_cast<double>(value);
  if (value.getType() == Value::TypeInt)
    return static_cast<int>(value);
  return std::nullopt;
}

bool holds(const Value& table, const std::string& key) { return table.getType() == Value::TypeStruct && table.hasMember(key); }
}  // namespace

std::map<std::string, double> readStartTolerances(const ros::NodeHandle& nh)
{
  std::map<std::string, double> tolerances;
  Value table;
  if (!nh.getParam("joints_allowed_start_tolerance", table) || table.getType() != Value::TypeStruct)
    return tolerances;
  for (auto& [joint, value] : table)
  {
    const std::optional<double> tolerance = number(value);
    if (tolerance && *tolerance >= 0.0)
      tolerances[joint] = *tolerance;
    else
      ROS_WARN_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                     "joints_allowed_start_tolerance/%s: ignored, a number of 0 or more is expected", joint.c_str());
  }
  return tolerances;
}

std::map<std::string, double> readOfControllers(const ros::NodeHandle& nh, const std::string& key)
{
  std::map<std::string, double> numbers;
  Value list;
  if (!nh.getParam("controller_list", list) || list.getType() != Value::TypeArray)
    return numbers;
  for (int i = 0; i < list.size(); ++i)
    if (holds(list[i], "name") && list[i]["name"].getType() == Value::TypeString && holds(list[i], key))
      if (const std::optional<double> own = number(list[i][key]))
        numbers[list[i]["name"]] = *own;
  return numbers;
}
}  // namespace trajectory_execution_manager
