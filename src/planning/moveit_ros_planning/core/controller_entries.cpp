// What an entry of controller_list says beyond its name and joints.
#include <ros/console.h>

#include <cmath>
#include <map>

#include "built_in_controllers.hpp"
#include "log_names.hpp"

namespace trajectory_execution_manager
{
namespace
{
using control_msgs::JointTolerance;
using XmlRpc::XmlRpcValue;

struct Quantity
{
  const char* name;
  double JointTolerance::*member;
};
const Quantity QUANTITIES[] = { { "position", &JointTolerance::position },
                                { "velocity", &JointTolerance::velocity },
                                { "acceleration", &JointTolerance::acceleration } };

bool isNumber(const XmlRpcValue& value)
{
  return value.getType() == XmlRpcValue::TypeDouble || value.getType() == XmlRpcValue::TypeInt;
}

double numberIn(XmlRpcValue value)
{
  return value.getType() == XmlRpcValue::TypeInt ? static_cast<int>(value) : static_cast<double>(value);
}

void tell(const ControllerEntry& entry, const std::string& place, const std::string& problem)
{
  ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "controller_list: %s of controller '%s' %s: it is not used", place.c_str(),
                  entry.name.c_str(), problem.c_str());
}

double toleranceIn(const ControllerEntry& entry, const std::string& place, const XmlRpcValue& value)
{
  if (isNumber(value))
    return numberIn(value);
  tell(entry, place, "is no number");
  return 0.0;
}

// One for each of the entry's joints, in their order.
std::vector<double> ofJoints(const ControllerEntry& entry, const std::string& place, XmlRpcValue given)
{
  const std::size_t joints = entry.joints.size();
  if (given.getType() != XmlRpcValue::TypeArray)
    return std::vector<double>(joints, toleranceIn(entry, place, given));
  std::vector<double> values(joints, 0.0);
  if (static_cast<std::size_t>(given.size()) != joints)
    tell(entry, place,
         "has " + std::to_string(given.size()) + " numbers, but the controller " + std::to_string(joints) + " joints");
  else
    for (std::size_t i = 0; i < joints; ++i)
      values[i] = toleranceIn(entry, place, given[i]);
  return values;
}

using Rows = std::map<std::string, JointTolerance>;

void readTable(const ControllerEntry& entry, const std::string& key, XmlRpcValue table, Rows& rows)
{
  for (const Quantity& quantity : QUANTITIES)
  {
    if (!table.hasMember(quantity.name))
      continue;
    const std::vector<double> values = ofJoints(entry, key + ": " + quantity.name, table[quantity.name]);
    for (std::size_t i = 0; i < values.size(); ++i)
      rows[entry.joints[i]].*quantity.member = values[i];
  }
}

void readList(const ControllerEntry& entry, const std::string& key, XmlRpcValue list, Rows& rows)
{
  for (int i = 0; i < list.size(); ++i)
  {
    const std::string place = key + "[" + std::to_string(i) + "]";
    XmlRpcValue& row = list[i];
    if (row.getType() != XmlRpcValue::TypeStruct || !row.hasMember("name") || row["name"].getType() != XmlRpcValue::TypeString)
    {
      tell(entry, place, "needs the 'name' of a joint");
      continue;
    }
    JointTolerance& made = rows[static_cast<std::string>(row["name"])];
    for (const Quantity& quantity : QUANTITIES)
      if (row.hasMember(quantity.name))
        made.*quantity.member = toleranceIn(entry, place + ": " + quantity.name, row[quantity.name]);
  }
}
}  // namespace

bool ControllerEntry::has(const char* key, XmlRpcValue::Type kind) const
{
  return all.getType() == XmlRpcValue::TypeStruct && all.hasMember(key) && XmlRpcValue(all)[key].getType() == kind;
}

bool ControllerEntry::flag(const char* key) const
{
  if (all.getType() != XmlRpcValue::TypeStruct || !all.hasMember(key))
    return false;
  XmlRpcValue value = XmlRpcValue(all)[key];
  return value.getType() == XmlRpcValue::TypeBoolean ? static_cast<bool>(value)
         : value.getType() == XmlRpcValue::TypeInt   ? static_cast<int>(value) != 0
                                                     : true;
}

double ControllerEntry::number(const char* key, double standard) const
{
  if (all.getType() != XmlRpcValue::TypeStruct || !all.hasMember(key))
    return standard;
  const XmlRpcValue value = XmlRpcValue(all)[key];
  if (isNumber(value) && std::isfinite(numberIn(value)))
    return numberIn(value);
  tell(*this, key, "is no number");
  return standard;
}

std::string ControllerEntry::text(const char* key) const
{
  return has(key, XmlRpcValue::TypeString) ? static_cast<std::string>(XmlRpcValue(all)[key]) : "";
}

std::vector<JointTolerance> ControllerEntry::tolerances(const char* key) const
{
  std::vector<JointTolerance> made;
  if (all.getType() != XmlRpcValue::TypeStruct || !all.hasMember(key))
    return made;
  Rows rows;
  const XmlRpcValue given = XmlRpcValue(all)[key];
  if (given.getType() == XmlRpcValue::TypeStruct)
    readTable(*this, key, given, rows);
  else if (given.getType() == XmlRpcValue::TypeArray)
    readList(*this, key, given, rows);
  else
    tell(*this, key, "is neither a table of position, velocity and acceleration nor a list of tables with a 'name'");
  for (auto& [joint, row] : rows)
  {
    row.name = joint;
    made.push_back(row);
  }
  return made;
}
}  // namespace trajectory_execution_manager
