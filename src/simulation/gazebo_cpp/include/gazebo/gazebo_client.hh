// Programs that speak with a simulator which runs already, on topics of its transport.
#pragma once
#include <string>
#include <vector>

#include <gazebo/gazebo_config.h>
#include <gazebo/util/system.hh>

namespace gazebo
{
GAZEBO_VISIBLE void printVersion();

namespace client
{
GAZEBO_VISIBLE void printVersion();

/// Connect to the simulator at GAZEBO_MASTER_URI (http://localhost:11345 without it), waiting up to 30 s for it.
/// \return whether there is one
GAZEBO_VISIBLE bool setup(int argc = 0, char** argv = nullptr);
GAZEBO_VISIBLE bool setup(const std::vector<std::string>& arguments);

/// Send what has been published, and leave.
GAZEBO_VISIBLE bool shutdown();
}  // namespace client
}  // namespace gazebo
