// What the simulator tells and asks the transport.
#pragma once
#include <string>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace transport
{
GAZEBO_VISIBLE void set_world(const std::string& name);  // what "~" stands for
GAZEBO_VISIBLE bool wanted(const std::string& topic);    // somebody listens
}  // namespace transport
}  // namespace gazebo
