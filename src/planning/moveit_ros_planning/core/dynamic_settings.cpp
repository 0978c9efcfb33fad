#include "dynamic_settings.hpp"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>
#include <ros/service.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace moveit_ros_planning
{
namespace
{
using dynamic_reconfigure::ConfigTools;
using execution::Kind;
using execution::Parameter;
using Value = XmlRpc::XmlRpcValue;

const char* typeOf(const Parameter& parameter)
{
  return parameter.kind == Kind::FLAG ? "bool" : parameter.kind == Kind::COUNT ? "int" : "double";
}

// What a parameter server's value says of it; nothing where that is of another kind.
std::optional<double> given(const Parameter& parameter, Value& value)
{
  const auto type = value.getType();
  if (parameter.kind == Kind::FLAG)
    return type == Value::TypeBoolean ? std::optional<double>(static_cast<bool>(value)) : std::nullopt;
  if (type == Value::TypeInt)
    return static_cast<int>(value);
  if (type == Value::TypeDouble && parameter.kind == Kind::NUMBER)
    return static_cast<double>(value);
  return std::nullopt;
}

// Calls the function with the value in the type in which ROS has it.
template <typename Function>
void typed(const Parameter& parameter, double value, const Function& function)
{
  if (parameter.kind == Kind::FLAG)
    function(value != 0.0);
  else if (parameter.kind == Kind::COUNT)
    function(static_cast<int>(value));
  else
    function(value);
}
}  // namespace

DynamicSettings::DynamicSettings(const ros::NodeHandle& nh, const execution::Parameters& table, const std::string& logger,
                                 std::function<void(const Values&)> changed)
  : nh_(nh)
  , table_(table)
  , logger_(logger)
  , changed_(std::move(changed))
{
  const std::lock_guard<std::mutex> lock(mutex_);
  descriptions_ = nh_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  dynamic_reconfigure::ConfigDescription description;
  description.groups.resize(1);
  description.groups[0].name = "Default";
  for (const Parameter& each : table_)
  {
    dynamic_reconfigure::ParamDescription one;
    one.name = each.name;
    one.type = typeOf(each);
    one.level = each.level;
    one.description = each.description;
    description.groups[0].parameters.push_back(one);
  }
  description.min = message([](const Parameter& each) { return each.low; });
  description.max = message([](const Parameter& each) { return each.high; });
  description.dflt = message([](const Parameter& each) { return each.value; });
  descriptions_.publish(description);
  updates_ = nh_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  const Values values = read();
  changed_(values);
  tell(values);
  service_ = nh_.advertiseService("set_parameters", &DynamicSettings::set, this);
}

DynamicSettings::Values DynamicSettings::read() const
{
  Values values;
  for (const Parameter& each : table_)
  {
    Value value;
    values[each.name] = each.value;
    if (!nh_.getParam(each.name, value))
      continue;
    if (const std::optional<double> found = given(each, value))
      values[each.name] = each.within(*found);
    else
      ROS_WARN_NAMED(logger_, "%s/%s: ignored, %s is expected", nh_.getNamespace().c_str(), each.name.c_str(),
                     each.kind == Kind::FLAG    ? "true or false"
                     : each.kind == Kind::COUNT ? "a whole number"
                                                : "a number");
  }
  return values;
}

// The values that hold, to the parameter server and to all clients.
void DynamicSettings::tell(const Values& values)
{
  values_ = values;
  for (const Parameter& each : table_)
    typed(each, values_.at(each.name), [&](auto value) { nh_.setParam(each.name, value); });
  updates_.publish(message([this](const Parameter& each) { return values_.at(each.name); }));
}

bool DynamicSettings::set(dynamic_reconfigure::Reconfigure::Request& request,
                          dynamic_reconfigure::Reconfigure::Response& response)
{
  Values wanted;
  for (const auto& one : request.config.bools)
    wanted[one.name] = one.value;
  for (const auto& one : request.config.ints)
    wanted[one.name] = one.value;
  for (const auto& one : request.config.doubles)
    wanted[one.name] = one.value;
  const std::lock_guard<std::mutex> lock(mutex_);
  Values values = values_;
  for (const Parameter& each : table_)
  {
    const auto found = wanted.find(each.name);
    if (found == wanted.end() || std::isnan(found->second))
      continue;
    const double value = each.kind == Kind::FLAG ? found->second != 0.0 : found->second;
    values[each.name] = each.within(each.kind == Kind::COUNT ? std::round(value) : value);
  }
  changed_(values);
  tell(values);
  response.config = message([this](const Parameter& each) { return values_.at(each.name); });
  return true;
}

dynamic_reconfigure::Config DynamicSettings::message(const std::function<double(const Parameter&)>& value) const
{
  dynamic_reconfigure::Config config;
  for (const Parameter& each : table_)
    typed(each, value(each), [&](auto one) { ConfigTools::appendParameter(config, each.name, one); });
  config.groups.resize(1);
  config.groups[0].name = "Default";
  config.groups[0].state = true;
  return config;
}

std::string freeNamespace(const std::string& name)
{
  std::string made = "~/" + name;
  std::transform(made.begin(), made.end(), made.begin(),
                 [](unsigned char letter) { return letter == ' ' ? '_' : static_cast<char>(std::tolower(letter)); });
  const auto taken = [](const std::string& where) { return ros::service::exists(where + "/set_parameters", false); };
  if (!taken(made))
    return made;
  unsigned int number = 1;
  while (taken(made + std::to_string(number)))
    ++number;
  return made + std::to_string(number);
}
}  // namespace moveit_ros_planning
