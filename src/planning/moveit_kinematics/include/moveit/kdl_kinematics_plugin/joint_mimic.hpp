// A joint and the one that it follows, as solvers on KDL keep it.
#pragma once

#include <string>

namespace kdl_kinematics_plugin
{
class JointMimic
{
public:
  JointMimic() { reset(0); }

  double offset, multiplier;
  unsigned int map_index;  // of the joint that this one takes its value from
  std::string joint_name;
  bool active;  // moves by itself

  void reset(unsigned int index)
  {
    offset = 0.0;
    multiplier = 1.0;
    map_index = index;
    active = false;
  }
};
}  // namespace kdl_kinematics_plugin
