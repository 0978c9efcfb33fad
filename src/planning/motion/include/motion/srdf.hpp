// SRDF as written: names only, checked against a robot later, by the model.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "motion/types.hpp"

namespace motion
{
struct Srdf
{
  struct Group
  {
    std::string name;
    std::vector<std::string> joints, links, subgroups;
    std::vector<std::pair<std::string, std::string>> chains;  // base link, tip link
  };
  struct GroupState
  {
    std::string name, group;
    std::map<std::string, std::vector<double>> joints;
  };
  struct EndEffector
  {
    std::string name, group, parent_link, parent_group;
  };
  struct VirtualJoint
  {
    std::string name, type, parent_frame, child_link;
    bool used = false;
  };
  struct LinkPair
  {
    std::string link1, link2, reason;
  };
  struct JointProperty
  {
    std::string joint, property, value;
  };
  struct SphereApproximation
  {
    std::string link;
    std::vector<std::pair<Vector3, double>> spheres;
  };

  std::string name;
  std::vector<Group> groups;
  std::vector<GroupState> states;
  std::vector<EndEffector> end_effectors;
  std::vector<VirtualJoint> virtual_joints;
  std::vector<std::string> passive_joints;
  std::vector<JointProperty> joint_properties;
  std::vector<LinkPair> disabled, enabled;
  std::vector<std::string> no_default_collision;  // disable_default_collisions
  std::vector<SphereApproximation> spheres;

  // Throws ModelError when the text is not an SRDF; what is odd but can be left out becomes a line in `warnings`.
  static Srdf parse(const std::string& text, std::vector<std::string>& warnings);
};
}  // namespace motion
