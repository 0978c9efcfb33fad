#include "planner_configs.hpp"

#include <xmlrpcpp/XmlRpcException.h>

#include <cstdlib>
#include <functional>
#include <sstream>

namespace ompl_interface
{
namespace
{
constexpr char DEFAULT[] = "geometric::RRTConnect";
// Settings of a group that every planner of it inherits.
const char* const GROUP_KEYS[] = { "projection_evaluator", "longest_valid_segment_fraction", "enforce_joint_model_state_space",
                                   "enforce_constrained_state_space" };
using Settings = std::map<std::string, std::string>;
using Value = XmlRpc::XmlRpcValue;

std::string asText(Value& value)
{
  if (value.getType() == Value::TypeString)
    return static_cast<std::string>(value);
  if (value.getType() == Value::TypeBoolean)
    return static_cast<bool>(value) ? "1" : "0";
  std::ostringstream text;
  text.precision(17);
  if (value.getType() == Value::TypeInt)
    text << static_cast<int>(value);
  else if (value.getType() == Value::TypeDouble)
    text << static_cast<double>(value);
  return text.str();
}

bool isTable(const Value& value) { return value.getType() == Value::TypeStruct; }

bool truth(const std::string& text) { return text == "1" || text == "true" || text == "True" || text == "yes"; }

// The planner `name` of planner_configs with what all of the group have; empty when there is none.
Settings oneConfig(Value& all, const std::string& name, const std::string& group, const Settings& common)
{
  if (!isTable(all) || !all.hasMember(name) || !isTable(all[name]))
  {
    ROS_ERROR_NAMED(LOGNAME, "Could not find the planner configuration '%s' on the param server; group '%s' uses %s instead",
                    name.c_str(), group.c_str(), DEFAULT);
    return {};
  }
  if (!all[name].hasMember("type"))
  {
    ROS_ERROR_NAMED(LOGNAME, "The planning configuration '%s' does not have a type", name.c_str());
    return {};
  }
  Settings settings(common);
  for (auto& item : all[name])
    settings[item.first] = asText(item.second);
  return settings;
}
}  // namespace

planning_interface::PlannerConfigurationMap readPlannerConfigs(const moveit::core::RobotModel& model, const ros::NodeHandle& nh)
{
  planning_interface::PlannerConfigurationMap configs;
  Value all;
  nh.getParam("planner_configs", all);
  for (const std::string& group : model.getJointModelGroupNames())
  {
    Value entry;
    Settings common;
    if (nh.getParam(group, entry) && isTable(entry))
      for (const char* key : GROUP_KEYS)
        if (entry.hasMember(key))
          common[key] = asText(entry[key]);
    Settings standard(common);
    standard["type"] = DEFAULT;
    if (isTable(entry) && entry.hasMember("default_planner_config"))
    {
      const Settings wanted = oneConfig(all, asText(entry["default_planner_config"]), group, common);
      if (!wanted.empty())
        standard = wanted;
    }
    configs[group] = { group, group, standard };
    if (!isTable(entry) || !entry.hasMember("planner_configs"))
      continue;
    Value& names = entry["planner_configs"];
    if (names.getType() != Value::TypeArray)
    {
      ROS_ERROR_NAMED(LOGNAME,
                      "The planner_configs argument of a group configuration should be an array of strings (for group '%s')",
                      group.c_str());
      continue;
    }
    for (int i = 0; i < names.size(); ++i)
    {
      const std::string name = asText(names[i]);
      const Settings settings = oneConfig(all, name, group, common);
      if (!settings.empty())
        configs[group + "[" + name + "]"] = { group, group + "[" + name + "]", settings };
    }
  }
  return configs;
}

Settings findConfig(const planning_interface::PlannerConfigurationMap& configs, const std::string& group,
                    const std::string& planner_id)
{
  if (!planner_id.empty())
  {
    const auto found = configs.find(planner_id.find(group) == std::string::npos ? group + "[" + planner_id + "]" : planner_id);
    if (found != configs.end())
      return found->second.config;
    ROS_WARN_NAMED(LOGNAME, "Cannot find planning configuration for group '%s' using planner '%s'. Will use defaults instead.",
                   group.c_str(), planner_id.c_str());
  }
  const auto found = configs.find(group);
  return found == configs.end() ? Settings{ { "type", DEFAULT } } : found->second.config;
}

void applyConfig(Settings settings, motion::PlanRequest& request)
{
  const auto take = [&settings](const char* key, const std::function<void(const std::string&)>& use) {
    const auto found = settings.find(key);
    if (found == settings.end())
      return;
    if (!found->second.empty())
      use(found->second);
    settings.erase(found);
  };
  const auto number = [](const std::string& text, double& field) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end && *end == '\0')
      field = value;
    else
      ROS_WARN_NAMED(LOGNAME, "planner setting '%s' is not a number: ignored", text.c_str());
  };
  take("type", [&](const std::string& text) { request.planner = text; });
  take("longest_valid_segment_fraction", [&](const std::string& text) { number(text, request.segment_fraction); });
  take("maximum_waypoint_distance", [&](const std::string& text) { number(text, request.maximum_waypoint_distance); });
  take("minimum_waypoint_count", [&](const std::string& text) {
    double value = request.minimum_waypoints;
    number(text, value);
    request.minimum_waypoints = static_cast<int>(value);
  });
  take("projection_evaluator", [&](const std::string& text) { request.projection = text; });
  take("interpolate", [&](const std::string& text) { request.interpolate = truth(text); });
  take("simplify_solutions", [&](const std::string& text) { request.simplify = truth(text); });
  take("hybridize", [&](const std::string& text) { request.hybridize = truth(text); });
  for (const char* key : { "enforce_joint_model_state_space", "enforce_constrained_state_space" })
    settings.erase(key);
  request.parameters = settings;
}
}  // namespace ompl_interface
