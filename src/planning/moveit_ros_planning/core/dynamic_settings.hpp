// A server of dynamic_reconfigure for a table of parameters: rqt_reconfigure and dynparam see what MoveIt 1's generated one shows.
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "laws/parameters.hpp"

namespace moveit_ros_planning
{
class DynamicSettings
{
public:
  using Values = std::map<std::string, double>;  // by name; of a flag 1 or 0

  // Reads what nh's parameters give of the table (each inside its bounds; what is of another kind is named and left out), calls changed
  // with it, and again in a thread of nh's queue whenever a client sets one. logger: whose lines these are.
  DynamicSettings(const ros::NodeHandle& nh, const execution::Parameters& table, const std::string& logger,
                  std::function<void(const Values&)> changed);

private:
  Values read() const;
  void tell(const Values& values);
  bool set(dynamic_reconfigure::Reconfigure::Request& request, dynamic_reconfigure::Reconfigure::Response& response);
  dynamic_reconfigure::Config message(const std::function<double(const execution::Parameter&)>& value) const;

  ros::NodeHandle nh_;
  const execution::Parameters& table_;
  std::string logger_;
  std::function<void(const Values&)> changed_;
  std::mutex mutex_;  // of one change at a time
  Values values_;
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer service_;
};

// ~NAME in the way in which MoveIt 1 makes it: lower case, without blanks, with a number where another one of this node has the name.
std::string freeNamespace(const std::string& name);
}  // namespace moveit_ros_planning
