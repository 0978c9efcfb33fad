#include "motion/robot_model.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
using Model = RobotModel;
using ModelPtr = std::shared_ptr<RobotModel>;

// Items live in the model: Python's handle keeps the model alive.
template <typename Item>
struct Of
{
  RobotModelPtr model;
  const Item* item;
};
using Joint = Of<JointModel>;
using Link = Of<LinkModel>;
using Group = Of<JointModelGroup>;

std::vector<std::string> jointNames(const RobotModel& model, const std::vector<int>& indices)
{
  std::vector<std::string> names;
  for (int i : indices)
    names.push_back(model.joints[i].name);
  return names;
}

std::vector<std::string> linkNames(const RobotModel& model, const std::vector<int>& indices)
{
  std::vector<std::string> names;
  for (int i : indices)
    names.push_back(model.links[i].name);
  return names;
}

std::string linkName(const RobotModel& model, int index) { return index < 0 ? "" : model.links[index].name; }

LimitOverride limitOverride(const py::handle& values, const std::string& joint)
{
  LimitOverride out;
  if (!py::isinstance<py::dict>(values))
    throw InvalidInput("joint_limits: the entry of joint '" + joint + "' is no mapping");
  const py::dict dict = py::reinterpret_borrow<py::dict>(values);
  auto flag = [&](const char* key, std::optional<bool>& into) {
    if (dict.contains(key))
      into = py::bool_(dict[key]);
  };
  auto number = [&](const char* key, std::optional<double>& into) {
    if (!dict.contains(key))
      return;
    try
    {
      into = py::float_(dict[key]);
    }
    catch (py::error_already_set&)
    {
      throw InvalidInput("joint_limits: " + std::string(key) + " of joint '" + joint + "' is no number");
    }
    if (!std::isfinite(*into))
      throw InvalidInput("joint_limits: " + std::string(key) + " of joint '" + joint + "' is not finite");
  };
  flag("has_velocity_limits", out.has_velocity);
  flag("has_acceleration_limits", out.has_acceleration);
  flag("has_jerk_limits", out.has_jerk);
  number("min_position", out.min_position);
  number("max_position", out.max_position);
  number("max_velocity", out.max_velocity);
  number("max_acceleration", out.max_acceleration);
  number("max_jerk", out.max_jerk);
  return out;
}

ModelPtr load(const std::string& urdf, const std::string& srdf, const py::dict& limits, const py::object& find, bool meshes)
{
  RobotModel::Options options;
  options.meshes = meshes;
  for (const auto& [name, values] : limits)
    options.limits[py::str(name)] = limitOverride(values, py::str(name));
  if (!find.is_none())
    options.find_file = [find](const std::string& uri) { return find(uri).cast<std::string>(); };
  return std::const_pointer_cast<RobotModel>(RobotModel::load(urdf, srdf, options));
}

void bindSmall(py::module_& m)
{
  py::class_<VariableBounds>(m, "VariableLimits", "Limits of one variable: rad or m, per s, s^2, s^3.")
      .def_readonly("has_position", &VariableBounds::has_position)
      .def_readonly("min_position", &VariableBounds::min_position)
      .def_readonly("max_position", &VariableBounds::max_position)
      .def_readonly("has_velocity", &VariableBounds::has_velocity)
      .def_readonly("max_velocity", &VariableBounds::max_velocity)
      .def_readonly("has_acceleration", &VariableBounds::has_acceleration)
      .def_readonly("max_acceleration", &VariableBounds::max_acceleration)
      .def_readonly("has_jerk", &VariableBounds::has_jerk)
      .def_readonly("max_jerk", &VariableBounds::max_jerk);
  py::class_<Srdf::EndEffector>(m, "EndEffectorInfo")
      .def_readonly("name", &Srdf::EndEffector::name)
      .def_readonly("group", &Srdf::EndEffector::group)
      .def_readonly("parent_link", &Srdf::EndEffector::parent_link)
      .def_readonly("parent_group", &Srdf::EndEffector::parent_group);
  py::class_<Srdf::VirtualJoint>(m, "VirtualJointInfo")
      .def_readonly("name", &Srdf::VirtualJoint::name)
      .def_readonly("type", &Srdf::VirtualJoint::type)
      .def_readonly("parent_frame", &Srdf::VirtualJoint::parent_frame)
      .def_readonly("child_link", &Srdf::VirtualJoint::child_link)
      .def_readonly("used", &Srdf::VirtualJoint::used);
}

void bindJoint(py::module_& m)
{
  py::class_<Joint>(m, "JointInfo")
      .def_property_readonly("name", [](const Joint& j) { return j.item->name; })
      .def_property_readonly("type", [](const Joint& j) { return j.item->typeName(); })
      .def_property_readonly("parent_link", [](const Joint& j) { return linkName(*j.model, j.item->parent_link); })
      .def_property_readonly("child_link", [](const Joint& j) { return linkName(*j.model, j.item->child_link); })
      .def_property_readonly("variables", [](const Joint& j) { return j.item->variables; })
      .def_property_readonly("variable_index", [](const Joint& j) { return j.item->first_variable; })
      .def_property_readonly("axis", [](const Joint& j) { return j.item->axis; })
      .def_property_readonly("origin", [](const Joint& j) { return j.item->origin; })
      .def_property_readonly("passive", [](const Joint& j) { return j.item->passive; })
      .def_property_readonly("active", [](const Joint& j) { return j.item->active(); })
      .def_property_readonly("limits", [](const Joint& j) { return j.item->bounds; })
      .def_property_readonly("motion_model", [](const Joint& j) { return j.item->diff_drive ? "diff_drive" : "holonomic"; })
      .def_property_readonly("distance_weight", [](const Joint& j) { return j.item->angular_distance_weight; })
      .def_property_readonly("mimic",
                             [](const Joint& j) -> py::object {
                               if (j.item->mimic < 0)
                                 return py::none();
                               return py::make_tuple(j.model->joints[j.item->mimic].name, j.item->mimic_factor,
                                                     j.item->mimic_offset);
                             })
      .def("__repr__", [](const Joint& j) { return "<joint '" + j.item->name + "' " + j.item->typeName() + ">"; });
  py::class_<Link>(m, "LinkInfo")
      .def_property_readonly("name", [](const Link& l) { return l.item->name; })
      .def_property_readonly("parent_joint", [](const Link& l) { return l.model->joints[l.item->parent_joint].name; })
      .def_property_readonly("parent_link", [](const Link& l) { return linkName(*l.model, l.item->parent_link); })
      .def_property_readonly("child_joints", [](const Link& l) { return jointNames(*l.model, l.item->child_joints); })
      .def_property_readonly("shapes",
                             [](const Link& l) {
                               std::vector<std::shared_ptr<Shape>> shapes;
                               for (const ShapePtr& s : l.item->shapes)
                                 shapes.push_back(std::const_pointer_cast<Shape>(s));
                               return shapes;
                             })
      .def_property_readonly("shape_poses", [](const Link& l) { return l.item->shape_origins; })
      .def_property_readonly("inertia_mass", [](const Link& l) { return l.item->mass; })
      .def_property_readonly("has_geometry", [](const Link& l) { return l.item->hasGeometry(); })
      .def("__repr__", [](const Link& l) { return "<link '" + l.item->name + "'>"; });
}

void bindGroup(py::module_& m)
{
  py::class_<Group>(m, "Group")
      .def_property_readonly("name", [](const Group& g) { return g.item->name; })
      .def_property_readonly("joints", [](const Group& g) { return jointNames(*g.model, g.item->joints); })
      .def_property_readonly("active_joints", [](const Group& g) { return jointNames(*g.model, g.item->active_joints); })
      .def_property_readonly("variables", [](const Group& g) { return g.item->variable_names; })
      .def_property_readonly("size", [](const Group& g) { return g.item->size(); })
      .def_property_readonly("links", [](const Group& g) { return linkNames(*g.model, g.item->links); })
      .def_property_readonly("updated_links", [](const Group& g) { return linkNames(*g.model, g.item->updated_links); })
      .def_property_readonly("is_chain", [](const Group& g) { return g.item->is_chain; })
      .def_property_readonly("base_link", [](const Group& g) { return linkName(*g.model, g.item->base_link); })
      .def_property_readonly("tip_link", [](const Group& g) { return linkName(*g.model, g.item->tip_link); })
      .def_property_readonly("tips", [](const Group& g) { return linkNames(*g.model, g.item->tips); })
      .def_property_readonly(
          "can_ik",
          [](const Group& g) { return g.item->single_variable_joints && !g.item->tips.empty() && g.item->size() > 0; })
      .def_property_readonly("subgroups", [](const Group& g) { return g.item->subgroups; })
      .def("is_subgroup_of",
           [](const Group& g, const std::string& other) {
             const JointModelGroup& larger = g.model->group(other);
             return &larger != g.item &&
                    std::includes(larger.joints.begin(), larger.joints.end(), g.item->joints.begin(), g.item->joints.end());
           })
      .def_property_readonly("named_states", [](const Group& g) { return g.item->state_names; })
      .def("named_state",
           [](const Group& g, const std::string& name) {
             const auto found = g.item->states.find(name);
             if (found == g.item->states.end())
               throwUnknown("state", name, "group '" + g.item->name + "'", g.item->state_names);
             return found->second;
           })
      .def_property_readonly("end_effector", [](const Group& g) { return g.item->end_effector; })
      .def_property_readonly("attached_end_effectors", [](const Group& g) { return g.item->attached_end_effectors; })
      .def(
          "position_limits",
          [](const Group& g) {
            std::vector<double> lower, upper;
            const double inf = std::numeric_limits<double>::infinity();
            for (int v : g.item->variables)
            {
              const VariableBounds& b = g.model->bounds[v];
              lower.push_back(b.has_position ? b.min_position : -inf);
              upper.push_back(b.has_position ? b.max_position : inf);
            }
            return py::make_tuple(toArray(lower), toArray(upper));
          },
          "(lower (n,), upper (n,)) in rad or m, infinite where there is no limit.")
      .def("__repr__",
           [](const Group& g) { return "<group '" + g.item->name + "' of " + std::to_string(g.item->size()) + " variables>"; });
}

void bindContents(py::class_<Model, ModelPtr>& c)
{
  auto pairs = [](const std::vector<Srdf::LinkPair>& list) {
    py::list out;
    for (const Srdf::LinkPair& pair : list)
      out.append(py::make_tuple(pair.link1, pair.link2, pair.reason));
    return out;
  };
  c.def_readonly("name", &Model::name)
      .def_readonly("frame", &Model::frame)
      .def_readonly("warnings", &Model::warnings)
      .def_property_readonly("root_link", [](const Model& r) { return r.links[0].name; })
      .def_property_readonly("root_joint", [](const Model& r) { return r.joints[0].name; })
      .def_property_readonly("links", &Model::linkNames)
      .def_property_readonly("joints", &Model::jointNames)
      .def_property_readonly("groups", &Model::groupNames)
      .def_readonly("variables", &Model::variables)
      .def_property_readonly("active_joints",
                             [](const Model& r) {
                               std::vector<std::string> names;
                               for (const JointModel& joint : r.joints)
                                 if (joint.active())
                                   names.push_back(joint.name);
                               return names;
                             })
      .def_property_readonly("passive_joints", [](const Model& r) { return r.srdf.passive_joints; })
      .def_property_readonly("end_effectors", [](const Model& r) { return r.srdf.end_effectors; })
      .def_property_readonly("virtual_joints", [](const Model& r) { return r.srdf.virtual_joints; })
      .def_property_readonly("disabled_collisions", [pairs](const Model& r) { return pairs(r.srdf.disabled); })
      .def_property_readonly("enabled_collisions", [pairs](const Model& r) { return pairs(r.srdf.enabled); })
      .def_property_readonly("no_default_collision_links", [](const Model& r) { return r.srdf.no_default_collision; });
}
}  // namespace

void bindModel(py::module_& m)
{
  bindSmall(m);
  bindJoint(m);
  bindGroup(m);
  m.def("_load_model", &load);
  py::class_<Model, ModelPtr> c(m, "RobotModel", "A robot as it is described. Never changes; see load_model.");
  bindContents(c);
  c.def("link",
        [](const ModelPtr& r, const std::string& name) {
          return Link{r, &r->link(name)};
        })
      .def("joint",
           [](const ModelPtr& r, const std::string& name) {
             return Joint{r, &r->joint(name)};
           })
      .def("group",
           [](const ModelPtr& r, const std::string& name) {
             return Group{r, &r->group(name)};
           })
      .def("has_link", [](const Model& r, const std::string& name) { return r.findLink(name) != nullptr; })
      .def("has_joint", [](const Model& r, const std::string& name) { return r.findJoint(name) != nullptr; })
      .def("has_group", [](const Model& r, const std::string& name) { return r.findGroup(name) != nullptr; })
      .def("variable_index", &Model::variable)
      .def("variable_limits", [](const Model& r, const std::string& name) { return r.bounds[r.variable(name)]; })
      .def(
          "rigidly_connected",
          [](const Model& r, const std::string& link) {
            Transform pose;
            const int parent = r.rigidParent(r.link(link).index, pose);
            return py::make_tuple(r.links[parent].name, pose);
          },
          "(the topmost link that the link is bolted to, the link's Pose in it).")
      .def(
          "state", [](const ModelPtr& r) { return RobotState(r); }, "A RobotState of default values.")
      .def("__repr__", [](const Model& r) { return "<robot '" + r.name + "'>"; });
}
}  // namespace motion
