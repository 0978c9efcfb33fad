#include "model_builder.hpp"

#include <algorithm>
#include <cstdlib>

namespace motion
{
namespace
{
Vector3 vector(const urdf::Vector3& v) { return Vector3(v.x, v.y, v.z); }

Transform transform(const urdf::Pose& pose)
{
  Transform t = Transform::Identity();
  Quaternion q(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  if (q.norm() > 1e-12)
    t.linear() = q.normalized().toRotationMatrix();
  t.translation() = vector(pose.position);
  return t;
}

bool emptyLink(const urdf::Link& link) { return !link.inertial && !link.visual && !link.collision; }
}  // namespace

void ModelBuilder::build()
{
  model_.name = urdf_->getName();
  if (!model_.srdf.name.empty() && model_.srdf.name != model_.name)
    warn("the SRDF is for robot '" + model_.srdf.name + "', the URDF for '" + model_.name + "': are these files of one robot?");
  model_.frame = urdf_->getRoot()->name;
  buildRootJoint();
  addLink(*urdf_->getRoot(), 0);
  for (std::size_t i = 0; i < model_.joints.size(); ++i)
    model_.joint_index_[model_.joints[i].name] = static_cast<int>(i);
  for (std::size_t i = 0; i < model_.links.size(); ++i)
    model_.link_index_[model_.links[i].name] = static_cast<int>(i);
  resolveMimics();
  applyProperties();
  applyLimits();
  finishVariables();
  findDescendants();
  buildGroups();
  buildStates();
  buildEndEffectors();
}

// The joint between the world outside and the root link: of the virtual joint whose child is the root, or fixed.
void ModelBuilder::buildRootJoint()
{
  JointModel joint;
  joint.name = "ASSUMED_FIXED_ROOT_JOINT";
  const urdf::Link& root = *urdf_->getRoot();
  for (Srdf::VirtualJoint& v : model_.srdf.virtual_joints)
  {
    if (v.child_link != root.name)
    {
      // An empty root called world is the outside already: a fixed joint to it says nothing new.
      if (root.name == "world" && emptyLink(root) && v.type == "fixed")
        joint.name = v.name;
      else
        warn("virtual joint '" + v.name + "' is left out: its child link '" + v.child_link + "' is not the root link '" +
             root.name + "' of the URDF");
      continue;
    }
    if (v.parent_frame.empty())
    {
      warn("virtual joint '" + v.name + "' is left out: it has no parent_frame");
      continue;
    }
    joint.name = v.name;
    joint.type = v.type == "planar" ? JointType::Planar : v.type == "floating" ? JointType::Floating : JointType::Fixed;
    if (joint.type != JointType::Fixed)
      model_.frame = v.parent_frame;
    v.used = true;
    break;
  }
  joint.child_link = 0;
  addVariables(joint);
  model_.joints.push_back(joint);
}

void ModelBuilder::addLink(const urdf::Link& link, int parent_joint)
{
  const int index = static_cast<int>(model_.links.size());
  model_.links.emplace_back();
  LinkModel& out = model_.links.back();
  out.name = link.name;
  out.index = index;
  out.parent_joint = parent_joint;
  out.parent_link = model_.joints[parent_joint].parent_link;
  model_.joints[parent_joint].child_link = index;
  if (link.inertial)
    out.mass = link.inertial->mass;
  addShapes(link, out);
  auto children = link.child_joints;
  std::sort(children.begin(), children.end(), [](const auto& a, const auto& b) { return a->name < b->name; });
  for (const auto& child : children)
  {
    model_.links[index].child_joints.push_back(static_cast<int>(model_.joints.size()));
    addJoint(*child, index);
  }
}

namespace
{
// Limits as the URDF has them; those of a safety controller only narrow.
void limit(VariableBounds& b, const urdf::Joint& urdf, bool continuous)
{
  if (urdf.limits)
  {
    b.max_velocity = std::abs(urdf.limits->velocity);
    b.has_velocity = b.max_velocity > 1e-12;
  }
  if (!continuous)
  {
    b.has_position = urdf.limits != nullptr || urdf.safety != nullptr;
    if (urdf.limits)
    {
      b.min_position = urdf.limits->lower;
      b.max_position = urdf.limits->upper;
    }
    if (urdf.safety)
    {
      b.min_position = urdf.limits ? std::max(b.min_position, urdf.safety->soft_lower_limit) : urdf.safety->soft_lower_limit;
      b.max_position = urdf.limits ? std::min(b.max_position, urdf.safety->soft_upper_limit) : urdf.safety->soft_upper_limit;
    }
  }
}
}  // namespace

void ModelBuilder::addJoint(const urdf::Joint& urdf, int parent_link)
{
  JointModel joint;
  joint.name = urdf.name;
  joint.index = static_cast<int>(model_.joints.size());
  joint.parent_link = parent_link;
  joint.origin = transform(urdf.parent_to_joint_origin_transform);
  joint.axis = vector(urdf.axis);
  switch (urdf.type)
  {
    case urdf::Joint::REVOLUTE:
      joint.type = JointType::Revolute;
      break;
    case urdf::Joint::CONTINUOUS:
      joint.type = JointType::Revolute;
      joint.continuous = true;
      break;
    case urdf::Joint::PRISMATIC:
      joint.type = JointType::Prismatic;
      break;
    case urdf::Joint::PLANAR:
      joint.type = JointType::Planar;
      break;
    case urdf::Joint::FLOATING:
      joint.type = JointType::Floating;
      break;
    case urdf::Joint::FIXED:
      break;
    default:
      warn("joint '" + joint.name + "' is of a type that is not known; taken as fixed");
  }
  if (joint.type == JointType::Revolute || joint.type == JointType::Prismatic)
  {
    if (joint.axis.norm() < 1e-12)
    {
      error("joint '" + joint.name + "': <axis xyz> is zero; 0 0 1 is used, as by the simulator");
      joint.axis = Vector3::UnitZ();
    }
    joint.axis.normalize();
  }
  addVariables(joint);
  if (joint.singleVariable())
  {
    limit(joint.bounds[0], urdf, joint.continuous);
    if (urdf.mimic)
      mimics_[joint.name] = {urdf.mimic->joint_name, {urdf.mimic->multiplier, urdf.mimic->offset}};
  }
  const int index = joint.index;
  model_.joints.push_back(joint);
  addLink(*urdf_->getLink(urdf.child_link_name), index);
}

void ModelBuilder::addVariables(JointModel& joint)
{
  auto add = [&joint](const std::string& suffix, bool bounded, double low, double high) {
    joint.variables.push_back(joint.name + suffix);
    VariableBounds b;
    b.has_position = bounded;
    b.min_position = low;
    b.max_position = high;
    joint.bounds.push_back(b);
  };
  const double inf = std::numeric_limits<double>::infinity();
  switch (joint.type)
  {
    case JointType::Revolute:
      add("", false, -M_PI, M_PI);
      break;
    case JointType::Prismatic:
      add("", false, -inf, inf);
      break;
    case JointType::Planar:
      joint.axis = Vector3::UnitZ();
      add("/x", false, -inf, inf);
      add("/y", false, -inf, inf);
      add("/theta", false, -M_PI, M_PI);
      break;
    case JointType::Floating:
      for (const char* suffix : {"/trans_x", "/trans_y", "/trans_z"})
        add(suffix, false, -inf, inf);
      for (const char* suffix : {"/rot_x", "/rot_y", "/rot_z", "/rot_w"})
        add(suffix, true, -1.0, 1.0);
      break;
    case JointType::Fixed:
      break;
  }
  joint.variable_count = static_cast<int>(joint.variables.size());
  joint.distance_factor = joint.type == JointType::Planar ? 3 : joint.type == JointType::Floating ? 6 : 1;
}

void ModelBuilder::addShapes(const urdf::Link& link, LinkModel& out)
{
  for (const auto& collision : link.collision_array)
  {
    if (!collision || !collision->geometry)
      continue;
    if (ShapePtr s = shape(*collision->geometry, link.name))
    {
      out.shapes.push_back(s);
      out.shape_origins.push_back(transform(collision->origin));
    }
  }
}

ShapePtr ModelBuilder::shape(const urdf::Geometry& geometry, const std::string& link)
{
  try
  {
    switch (geometry.type)
    {
      case urdf::Geometry::SPHERE:
        return std::make_shared<Sphere>(static_cast<const urdf::Sphere&>(geometry).radius);
      case urdf::Geometry::BOX:
        return std::make_shared<Box>(vector(static_cast<const urdf::Box&>(geometry).dim));
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
        return std::make_shared<Cylinder>(cylinder.radius, cylinder.length);
      }
      case urdf::Geometry::MESH: {
        if (!options_.meshes)
          return nullptr;
        const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
        const Vector3 scale = vector(mesh.scale);
        ShapePtr& known = meshes_[mesh.filename + " " + std::to_string(scale.x()) + " " + std::to_string(scale.y()) + " " +
                                  std::to_string(scale.z())];
        if (!known)
        {
          const std::string path = options_.find_file ? options_.find_file(mesh.filename) : mesh.filename;
          if (path.empty())
            throw InvalidInput("mesh '" + mesh.filename + "' is not found");
          known = loadMesh(path, scale);
        }
        return known;
      }
    }
  }
  catch (const InvalidInput& error)
  {
    warn("link '" + link + "': a <collision> is left out: " + error.what());
  }
  return nullptr;
}

void ModelBuilder::resolveMimics()
{
  for (const auto& [name, mimic] : mimics_)
  {
    JointModel& joint = model_.joints[model_.joint_index_[name]];
    // Chains of followers end at the joint that really moves.
    std::string target = mimic.first;
    double factor = mimic.second.first, offset = mimic.second.second;
    std::set<std::string> seen{name};
    while (mimics_.count(target) && seen.insert(target).second)
    {
      const auto& next = mimics_.at(target);
      offset += factor * next.second.second;
      factor *= next.second.first;
      target = next.first;
    }
    const auto found = model_.joint_index_.find(target);
    if (seen.count(target) || found == model_.joint_index_.end() || !model_.joints[found->second].singleVariable())
    {
      warn("joint '" + name + "' mimics '" + mimic.first + "', which " +
           (seen.count(target) ? "follows it in turn" : "is no joint with one variable") + "; it moves by itself");
      continue;
    }
    joint.mimic = found->second;
    joint.mimic_factor = factor;
    joint.mimic_offset = offset;
    model_.joints[found->second].mimicked_by.push_back(joint.index);
  }
}

void ModelBuilder::applyProperties()
{
  for (const std::string& name : model_.srdf.passive_joints)
  {
    const auto found = model_.joint_index_.find(name);
    if (found == model_.joint_index_.end())
      warn("passive joint '" + name + "' of the SRDF is not in the URDF");
    else
      model_.joints[found->second].passive = true;
  }
  for (const Srdf::JointProperty& p : model_.srdf.joint_properties)
  {
    const auto found = model_.joint_index_.find(p.joint);
    if (found == model_.joint_index_.end())
    {
      warn("joint_property '" + p.property + "': joint '" + p.joint + "' of the SRDF is not in the URDF");
      continue;
    }
    JointModel& joint = model_.joints[found->second];
    char* end = nullptr;
    const double number = std::strtod(p.value.c_str(), &end);
    const bool is_number = end && *end == 0 && std::isfinite(number) && number >= 0;
    const bool planar = joint.type == JointType::Planar;
    if (p.property == "angular_distance_weight" && is_number && (planar || joint.type == JointType::Floating))
      joint.angular_distance_weight = number;
    else if (p.property == "motion_model" && planar && (p.value == "holonomic" || p.value == "diff_drive"))
      joint.diff_drive = p.value == "diff_drive";
    else if (p.property == "min_translational_distance" && planar && is_number)
      joint.min_translational_distance = number;
    else
      warn("joint_property '" + p.property + "' of joint '" + p.joint + "' with value '" + p.value.substr(0, 40) +
           "' is not understood; left out");
  }
}

// Limits are given by variable: that of a joint with one variable is called as the joint.
std::pair<JointModel*, int> ModelBuilder::variableNamed(const std::string& name)
{
  for (JointModel& joint : model_.joints)
    for (int k = 0; k < joint.variable_count; ++k)
      if (joint.variables[k] == name)
        return {&joint, k};
  return {nullptr, 0};
}

void ModelBuilder::warnOfLimits(const std::string& name)
{
  const auto found = model_.joint_index_.find(name);
  if (found == model_.joint_index_.end())
  {
    warn("joint_limits: joint '" + name + "' is not in the robot");
    return;
  }
  std::string variables;
  for (const std::string& variable : model_.joints[found->second].variables)
    variables += (variables.empty() ? "" : ", ") + variable.substr(name.size() + 1);
  warn("joint_limits: those of joint '" + name + "' are left out: " +
       (variables.empty() ? "it is fixed" : "it has several variables, whose limits go below " + name + ": " + variables));
}

void ModelBuilder::applyLimits()
{
  for (const auto& [name, limit] : options_.limits)
  {
    const auto [joint, k] = variableNamed(name);
    if (!joint)
    {
      warnOfLimits(name);
      continue;
    }
    VariableBounds& b = joint->bounds[k];
    const bool angle =
        joint->continuous || (joint->type == JointType::Planar && k == 2) || (joint->type == JointType::Floating && k > 2);
    if ((limit.min_position || limit.max_position) && angle)
      warn("joint_limits: position limits of joint '" + name + "' are left out: it turns without end");
    else if (limit.min_position || limit.max_position)
    {
      b.has_position = true;
      b.min_position = limit.min_position.value_or(b.min_position);
      b.max_position = limit.max_position.value_or(b.max_position);
    }
    // A limit counts without its flag, which can take it back, but makes none.
    const auto take = [&, &joint_name = name](bool& has, double& most, const std::optional<bool>& flag,
                                              const std::optional<double>& value, const std::string& what) {
      if (flag.value_or(false) && !has && !value)
        warn("joint_limits: joint '" + joint_name + "' has has_" + what + "_limits: true, but no max_" + what +
             ": it counts as not limited");
      has = (has || value) && flag.value_or(true);
      most = value.value_or(most);
    };
    take(b.has_velocity, b.max_velocity, limit.has_velocity, limit.max_velocity, "velocity");
    take(b.has_acceleration, b.max_acceleration, limit.has_acceleration, limit.max_acceleration, "acceleration");
    take(b.has_jerk, b.max_jerk, limit.has_jerk, limit.max_jerk, "jerk");
  }
  for (const JointModel& joint : model_.joints)
    for (const VariableBounds& b : joint.bounds)
      if (b.has_position && !(b.min_position <= b.max_position))
        error("joint '" + joint.name + "': its lower limit " + std::to_string(b.min_position) + " is above its upper limit " +
              std::to_string(b.max_position) +
              ": no position is within them, so nothing that moves it can be planned; exchange the two");
}

void ModelBuilder::finishVariables()
{
  for (JointModel& joint : model_.joints)
  {
    joint.first_variable = static_cast<int>(model_.variables.size());
    for (int k = 0; k < joint.variable_count; ++k)
    {
      const VariableBounds& b = joint.bounds[k];
      model_.variable_index_[joint.variables[k]] = static_cast<int>(model_.variables.size());
      model_.variables.push_back(joint.variables[k]);
      model_.bounds.push_back(b);
      model_.variable_joint.push_back(joint.index);
      const bool zero_fits = !b.has_position || (b.min_position <= 0 && b.max_position >= 0);
      model_.defaults.push_back(zero_fits ? 0.0 : 0.5 * (b.min_position + b.max_position));
    }
    if (joint.type == JointType::Floating)
      model_.defaults.back() = 1.0;
  }
  for (const JointModel& joint : model_.joints)
    if (joint.mimic >= 0)
      model_.defaults[joint.first_variable] =
          joint.mimic_factor * model_.defaults[model_.joints[joint.mimic].first_variable] + joint.mimic_offset;
}

void ModelBuilder::findDescendants()
{
  for (JointModel& joint : model_.joints)
  {
    std::set<int> links;
    for (int below : joint.mimicked_by)
      for (const LinkModel& link : model_.links)
        if (model_.isAncestor(model_.joints[below].child_link, link.index))
          links.insert(link.index);
    for (const LinkModel& link : model_.links)
      if (model_.isAncestor(joint.child_link, link.index))
        links.insert(link.index);
    joint.descendant_links.assign(links.begin(), links.end());
  }
}
}  // namespace motion
