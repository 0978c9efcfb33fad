// Planning groups, their named states and end effectors.
#include <algorithm>

#include "model_builder.hpp"

namespace motion
{
void ModelBuilder::buildGroups()
{
  std::set<std::string> in_progress;
  for (const Srdf::Group& group : model_.srdf.groups)
    if (!model_.group_index_.count(group.name) && !buildGroup(group, in_progress))
      in_progress.insert(group.name);  // not tried again
  // Subgroups are built before their owners; users expect the order of the file.
  std::vector<JointModelGroup> ordered;
  for (const Srdf::Group& group : model_.srdf.groups)
  {
    const auto found = model_.group_index_.find(group.name);
    if (found != model_.group_index_.end() && !model_.groups[found->second].name.empty())
      ordered.push_back(std::move(model_.groups[found->second]));
  }
  model_.groups = std::move(ordered);
  model_.group_index_.clear();
  for (std::size_t i = 0; i < model_.groups.size(); ++i)
    model_.group_index_[model_.groups[i].name] = static_cast<int>(i);
}

bool ModelBuilder::buildGroup(const Srdf::Group& config, std::set<std::string>& in_progress)
{
  if (!in_progress.insert(config.name).second)
  {
    warn("group '" + config.name + "' contains itself through its subgroups; left out");
    return false;
  }
  std::set<int> joints;
  auto missing = [&](const std::string& kind, const std::string& name) {
    warn("group '" + config.name + "': " + kind + " '" + name + "' is not in the robot; left out of the group");
  };
  for (const std::string& name : config.joints)
  {
    const auto found = model_.joint_index_.find(name);
    found == model_.joint_index_.end() ? missing("joint", name) : void(joints.insert(found->second));
  }
  for (const std::string& name : config.links)
  {
    const auto found = model_.link_index_.find(name);
    found == model_.link_index_.end() ? missing("link", name) : void(joints.insert(model_.links[found->second].parent_joint));
  }
  for (const auto& [base, tip] : config.chains)
    joints.merge(jointsOfChain(base, tip, config.name));

  JointModelGroup group;
  group.name = config.name;
  for (const std::string& name : config.subgroups)
  {
    if (!model_.group_index_.count(name))
    {
      const auto sub = std::find_if(model_.srdf.groups.begin(), model_.srdf.groups.end(),
                                    [&](const Srdf::Group& g) { return g.name == name; });
      if (sub == model_.srdf.groups.end() || !buildGroup(*sub, in_progress))
      {
        warn("group '" + config.name + "': its subgroup '" + name + "' " +
             (sub == model_.srdf.groups.end() ? "is not in the SRDF" : "could not be built") + "; the group is left out");
        return false;
      }
    }
    const JointModelGroup& sub = model_.groups[model_.group_index_[name]];
    joints.insert(sub.joints.begin(), sub.joints.end());
    group.subgroups.push_back(name);
  }
  in_progress.erase(config.name);
  if (joints.empty())
  {
    warn("group '" + config.name + "' has no joints; left out");
    return false;
  }
  finishGroup(group, joints);
  model_.group_index_[group.name] = static_cast<int>(model_.groups.size());
  model_.groups.push_back(std::move(group));
  return true;
}

// All joints below `base` down to `tip`; between two branches over their common ancestor.
std::set<int> ModelBuilder::jointsOfChain(const std::string& base, const std::string& tip, const std::string& group)
{
  const auto base_found = model_.link_index_.find(base), tip_found = model_.link_index_.find(tip);
  for (const auto& [found, name] : {std::pair(base_found, base), std::pair(tip_found, tip)})
    if (found == model_.link_index_.end())
    {
      warn("group '" + group + "': chain from '" + base + "' to '" + tip + "': there is no link '" + name +
           "'; the chain is left out");
      return {};
    }
  std::set<int> joints;
  auto climb = [&](int link, int stop) {
    for (; link != stop && link >= 0; link = model_.links[link].parent_link)
      joints.insert(model_.links[link].parent_joint);
  };
  int common = base_found->second;
  while (!model_.isAncestor(common, tip_found->second))
    common = model_.links[common].parent_link;
  climb(tip_found->second, common);
  climb(base_found->second, common);
  return joints;
}

void ModelBuilder::finishGroup(JointModelGroup& group, const std::set<int>& joints)
{
  group.joints.assign(joints.begin(), joints.end());
  std::set<int> updated;
  for (int j : group.joints)
  {
    const JointModel& joint = model_.joints[j];
    group.links.push_back(joint.child_link);
    if (joint.variable_count > 0)  // a chain that begins with a fixed joint does not move its base
      updated.insert(joint.descendant_links.begin(), joint.descendant_links.end());
    if (!joint.active())
      continue;
    group.active_joints.push_back(j);
    group.single_variable_joints = group.single_variable_joints && joint.singleVariable();
    for (int k = 0; k < joint.variable_count; ++k)
    {
      group.variables.push_back(joint.first_variable + k);
      group.variable_names.push_back(joint.variables[k]);
    }
  }
  group.updated_links.assign(updated.begin(), updated.end());
  group.link_updated.assign(model_.links.size(), 0);
  for (int link : group.updated_links)
    group.link_updated[link] = 1;
  group.is_chain = true;
  for (std::size_t i = 0; i < group.joints.size(); ++i)
  {
    const JointModel& joint = model_.joints[group.joints[i]];
    const bool follows = i > 0 && joint.parent_link == model_.joints[group.joints[i - 1]].child_link;
    if (!follows)
      group.joint_roots.push_back(joint.index);
    group.is_chain = group.is_chain && (i == 0 || follows);
  }
  group.base_link = model_.joints[group.joints.front()].parent_link;
  if (group.is_chain)
    group.tip_link = model_.joints[group.joints.back()].child_link;
  findTips(group);
}

// Where the hand sits: the last link of a chain; of a tree the last links of its chains of subgroups.
void ModelBuilder::findTips(JointModelGroup& group)
{
  if (group.is_chain)
    group.tips = {group.tip_link};
  for (const std::string& name : group.subgroups)
    if (!group.is_chain)
    {
      const JointModelGroup& sub = model_.groups[model_.group_index_[name]];
      for (int tip : sub.tips)
        if (std::find(group.tips.begin(), group.tips.end(), tip) == group.tips.end())
          group.tips.push_back(tip);
    }
}

void ModelBuilder::buildStates()
{
  for (const Srdf::GroupState& state : model_.srdf.states)
  {
    const auto found = model_.group_index_.find(state.group);
    if (found == model_.group_index_.end())
    {
      warn("group_state '" + state.name + "': there is no group '" + state.group + "'; left out");
      continue;
    }
    JointModelGroup& group = model_.groups[found->second];
    std::map<std::string, std::vector<double>> values;
    for (const auto& [name, numbers] : state.joints)
    {
      const JointModel* joint = model_.findJoint(name);
      if (!joint || !group.hasJoint(joint->index))
        warn("group_state '" + state.name + "': joint '" + name + "' is not in group '" + state.group + "'; left out");
      else if (!joint->active())
        continue;  // fixed or mimic: generated files name them, and they mean nothing
      else if (static_cast<int>(numbers.size()) != joint->variable_count)
        warn("group_state '" + state.name + "': joint '" + name + "' needs " + std::to_string(joint->variable_count) +
             " values, not " + std::to_string(numbers.size()) + "; left out");
      else
        values[name] = numbers;
    }
    std::vector<std::string> absent;
    for (int j : group.active_joints)
      if (!values.count(model_.joints[j].name))
        absent.push_back(model_.joints[j].name);
    if (!absent.empty())
      warn("group_state '" + state.name + "' of group '" + state.group + "' says nothing of: " + listed(absent));
    if (!group.states.count(state.name))
      group.state_names.push_back(state.name);
    group.states[state.name] = values;
  }
}

void ModelBuilder::buildEndEffectors()
{
  std::vector<Srdf::EndEffector> kept;
  for (Srdf::EndEffector effector : model_.srdf.end_effectors)
  {
    const auto own = model_.group_index_.find(effector.group);
    const auto link = model_.link_index_.find(effector.parent_link);
    if (own == model_.group_index_.end() || link == model_.link_index_.end())
    {
      warn("end_effector '" + effector.name + "': there is no " +
           (own == model_.group_index_.end() ? "group '" + effector.group : "link '" + effector.parent_link) + "'; left out");
      continue;
    }
    auto holds = [&](const JointModelGroup& g) {
      return g.name != effector.group && std::find(g.links.begin(), g.links.end(), link->second) != g.links.end();
    };
    if (!effector.parent_group.empty())
    {
      const auto parent = model_.group_index_.find(effector.parent_group);
      if (parent == model_.group_index_.end() || !holds(model_.groups[parent->second]))
      {
        warn("end_effector '" + effector.name + "': parent_group '" + effector.parent_group + "' does not hold link '" +
             effector.parent_link + "'; the smallest group that does is taken");
        effector.parent_group.clear();
      }
    }
    if (effector.parent_group.empty())
    {
      const JointModelGroup* smallest = nullptr;
      for (const JointModelGroup& g : model_.groups)
        if (holds(g) && (!smallest || g.joints.size() < smallest->joints.size()))
          smallest = &g;
      if (smallest)
        effector.parent_group = smallest->name;
      else
        warn("end_effector '" + effector.name + "': no other group holds its parent link '" + effector.parent_link + "'");
    }
    model_.groups[own->second].end_effector = effector.name;
    if (!effector.parent_group.empty())
      model_.groups[model_.group_index_[effector.parent_group]].attached_end_effectors.push_back(effector.name);
    kept.push_back(effector);
  }
  model_.srdf.end_effectors = kept;
}
}  // namespace motion
