#include <compiled_plugins/ros.h>

#include <cmath>
#include <mutex>

#include <ros/names.h>
#include <ros/ros.h>
#include <ros/spinner.h>

namespace compiled_plugins
{
namespace
{

std::mutex mutex;
bool own = false;
ros::AsyncSpinner* spinner = nullptr;

/// The parameter by which roscpp decides to subscribe to /clock; it looks there once.
constexpr const char* clock_parameter = "/use_sim_time";

void forget_remapping(const std::string& name)
{
  // The table is roscpp's own and not const; there is no other way to take a name out. Done before anybody else has roscpp.
  const_cast<ros::M_string&>(ros::names::getRemappings()).erase(name);
  const_cast<ros::M_string&>(ros::names::getUnresolvedRemappings()).erase(name);
}

}  // namespace

std::string start(const std::string& name, const std::map<std::string, std::string>& remappings, double time)
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (ros::isInitialized())
    return ros::this_node::getName();
  ros::M_string words(remappings.begin(), remappings.end());
  words["__name"] = name;
  if (time >= 0.0)
    words[clock_parameter] = "/" + name + "/use_sim_time";  // which is not there: time comes by set_time() alone
  ros::init(words, name, ros::init_options::NoSigintHandler);
  ros::start();
  if (time >= 0.0)
  {
    forget_remapping(clock_parameter);
    ros::Time::setNow(ros::Time().fromNSec(std::llround(time * 1e9)));
  }
  own = true;
  spinner = new ros::AsyncSpinner(0);
  spinner->start();
  return ros::this_node::getName();
}

bool started() { return own; }

void set_time(double time) { ros::Time::setNow(ros::Time().fromNSec(std::llround(time * 1e9))); }

void stop()
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (!own || !spinner)
    return;
  spinner->stop();
  spinner = nullptr;  // left where it is: its destructor would touch what has gone
  ros::shutdown();
}

}  // namespace compiled_plugins
