// roscpp in a process whose node is one of rospy.
#pragma once

#include <map>
#include <string>

namespace compiled_plugins
{

/// Start roscpp as a node of its own, unless this process is a node of roscpp already. Its callbacks run in threads, as in the
/// original's simulator; signals are left to Python.
///
/// \param name base name of the node
/// \param remappings as on the command line; __ns is the namespace
/// \param time s of the simulation's clock; with it, the clock is moved by set_time() alone and not by the topic /clock, which comes
///             later than the step. Negative: no simulated time.
/// \return the name of the node
std::string start(const std::string& name, const std::map<std::string, std::string>& remappings, double time);

/// Whether start() has made the node, so that its clock is set by set_time().
bool started();

/// Set roscpp's clock. \param time s
void set_time(double time);

/// End what start() made.
void stop();

}  // namespace compiled_plugins
