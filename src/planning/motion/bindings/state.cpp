#include "motion/robot_state.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
using Body = AttachedBody;

const JointModelGroup* groupOrNull(const RobotState& s, const std::optional<std::string>& name)
{
  return name && !name->empty() ? &s.model()->group(*name) : nullptr;
}

Random randomSource(const std::optional<std::uint64_t>& seed) { return seed ? Random(*seed) : Random(std::random_device{}()); }

// A Python object that may be dropped by a thread without Python's lock.
std::any kept(const py::object& object)
{
  if (object.is_none())
    return {};
  return std::shared_ptr<py::object>(new py::object(object), [](py::object* p) {
    py::gil_scoped_acquire lock;
    delete p;
  });
}

py::object kept(const std::any& any)
{
  const auto* object = std::any_cast<std::shared_ptr<py::object>>(&any);
  return object ? **object : py::object(py::none());
}

std::shared_ptr<Body> makeBody(const std::string& id, const std::string& link,
                               const std::vector<std::shared_ptr<Shape>>& shapes, const std::vector<Transform>& shape_poses,
                               const std::optional<Transform>& pose, const std::vector<std::string>& touch_links,
                               const Subframes& subframes, const py::object& posture, double weight, const std::string& type)
{
  auto body = std::make_shared<Body>();
  body->id = id;
  body->link = link;
  body->shapes.assign(shapes.begin(), shapes.end());
  body->shape_poses = shape_poses;
  if (shape_poses.size() > shapes.size())
    throw InvalidInput("attached body '" + id + "' has more shape poses than shapes");
  body->shape_poses.resize(shapes.size(), Transform::Identity());
  if (pose)
    body->pose = *pose;
  body->touch_links.insert(touch_links.begin(), touch_links.end());
  body->subframes = subframes;
  body->posture = kept(posture);
  body->weight = weight;
  body->type = type;
  return body;
}

void setMany(RobotState& state, const py::dict& values)
{
  std::vector<std::pair<int, double>> checked;
  for (const auto& [name, value] : values)
  {
    const int variable = state.model()->variable(py::str(name));
    const double number = py::float_(py::reinterpret_borrow<py::object>(value));
    if (!std::isfinite(number))
      throw InvalidInput("variable '" + std::string(py::str(name)) + "': the value is not finite");
    checked.emplace_back(variable, number);
  }
  for (const auto& [variable, number] : checked)
    state.setVariable(variable, number);
}

py::list violations(const RobotState& s, const std::optional<std::string>& group, double margin)
{
  py::list out;
  const JointModelGroup* g = groupOrNull(s, group);
  for (const JointModel& joint : s.model()->joints)
  {
    if (!joint.active() || (g && !g->hasJoint(joint.index)) || joint.satisfiesBounds(s.joint(joint), margin))
      continue;
    for (int k = 0; k < joint.variable_count; ++k)
    {
      const VariableBounds& b = joint.bounds[k];
      const double value = s.joint(joint)[k];
      const bool heading = joint.type == JointType::Planar && k == 2;
      if (!std::isfinite(value) ||
          (heading ? std::abs(value) > M_PI + 1e-9 + margin
                   : b.has_position && (value < b.min_position - margin || value > b.max_position + margin)))
        out.append(py::make_tuple(joint.variables[k], value, b.min_position, b.max_position));
    }
  }
  return out;
}

void bindBody(py::module_& m)
{
  py::class_<Body, std::shared_ptr<Body>>(m, "AttachedBody", "An object that moves with a link. Never changes.")
      .def(py::init(&makeBody), py::arg("id"), py::arg("link"), py::arg("shapes"),
           py::arg("shape_poses") = std::vector<Transform>(), py::arg("pose") = py::none(),
           py::arg("touch_links") = std::vector<std::string>(), py::arg("subframes") = Subframes(),
           py::arg("detach_posture") = py::none(), py::arg("weight") = 0.0, py::arg("type") = "",
           "`pose`: of the object in the link; `shape_poses`, `subframes`: in the object.")
      .def_readonly("id", &Body::id)
      .def_readonly("link", &Body::link)
      .def_readonly("pose", &Body::pose)
      .def_readonly("shape_poses", &Body::shape_poses)
      .def_readonly("subframes", &Body::subframes)
      .def_readonly("weight", &Body::weight)
      .def_readonly("type", &Body::type)
      .def_property_readonly("shapes",
                             [](const Body& b) {
                               std::vector<std::shared_ptr<Shape>> out;
                               for (const ShapePtr& s : b.shapes)
                                 out.push_back(std::const_pointer_cast<Shape>(s));
                               return out;
                             })
      .def_property_readonly("touch_links",
                             [](const Body& b) { return std::vector<std::string>(b.touch_links.begin(), b.touch_links.end()); })
      .def_property_readonly("detach_posture", [](const Body& b) { return kept(b.posture); })
      .def("__repr__", [](const Body& b) { return "<attached body '" + b.id + "' on '" + b.link + "'>"; });
}

template <std::vector<double> RobotState::*Member>
void bindOptional(py::class_<RobotState>& c, const char* name)
{
  c.def_property(
      name,
      [](const RobotState& s) -> py::object {
        return (s.*Member).empty() ? py::object(py::none()) : py::object(toArray(s.*Member));
      },
      [name](RobotState& s, const std::optional<Array>& values) {
        if (values)
          s.*Member = fromArray(*values, s.positions().size(), name);
        else
          (s.*Member).clear();
      });
}

void bindValues(py::class_<RobotState>& c)
{
  c.def_property(
       "positions", [](const RobotState& s) { return toArray(s.positions()); },
       [](RobotState& s, const Array& values) { s.setPositions(fromArray(values, s.positions().size(), "positions").data()); },
       "(nv,) copy in the model's order of variables, rad or m.")
      .def("get", [](const RobotState& s, const std::string& variable) { return s.positions()[s.model()->variable(variable)]; })
      .def("set", &setMany, py::arg("values"), "A mapping variable -> value; joints that mimic follow.")
      .def("set",
           [](RobotState& s, const std::string& variable, double value) {
             if (!std::isfinite(value))
               throw InvalidInput("variable '" + variable + "': the value is not finite");
             s.setVariable(s.model()->variable(variable), value);
           })
      .def("as_dict", [](const RobotState& s) {
        py::dict out;
        for (std::size_t i = 0; i < s.positions().size(); ++i)
          out[py::str(s.model()->variables[i])] = s.positions()[i];
        return out;
      });
}

void bindValuesOfParts(py::class_<RobotState>& c)
{
  c.def(
       "set_group",
       [](RobotState& s, const std::string& group, const Array& values) {
         const JointModelGroup& g = s.model()->group(group);
         s.setGroup(g, fromArray(values, g.size(), "values of group '" + group + "'").data());
       },
       py::arg("group"), py::arg("values"))
      .def("get_group",
           [](const RobotState& s, const std::string& group) {
             const JointModelGroup& g = s.model()->group(group);
             std::vector<double> values(g.size());
             s.getGroup(g, values.data());
             return toArray(values);
           })
      .def("set_joint",
           [](RobotState& s, const std::string& name, const Array& values) {
             const JointModel& joint = s.model()->joint(name);
             s.setJoint(joint, fromArray(values, joint.variable_count, "values of joint '" + name + "'").data());
           })
      .def("get_joint",
           [](const RobotState& s, const std::string& name) {
             const JointModel& joint = s.model()->joint(name);
             return toArray(std::vector<double>(s.joint(joint), s.joint(joint) + joint.variable_count));
           })
      .def("set_default", &RobotState::setDefault)
      .def("set_named", [](RobotState& s, const std::string& group,
                           const std::string& name) { return s.setNamed(s.model()->group(group), name); })
      .def(
          "randomize",
          [](RobotState& s, const std::optional<std::string>& group, const std::optional<std::uint64_t>& seed) {
            Random random = randomSource(seed);
            s.randomize(groupOrNull(s, group), random);
          },
          py::arg("group") = py::none(), py::arg("seed") = py::none())
      .def(
          "randomize_near",
          [](RobotState& s, const std::string& group, const RobotState& near, double distance,
             const std::optional<std::uint64_t>& seed) {
            Random random = randomSource(seed);
            s.randomizeNear(s.model()->group(group), near, distance, random);
          },
          py::arg("group"), py::arg("near"), py::arg("distance"), py::arg("seed") = py::none());
}

void bindComparisons(py::class_<RobotState>& c)
{
  c.def(
       "in_bounds",
       [](const RobotState& s, const std::optional<std::string>& group, double margin) {
         return s.satisfiesBounds(groupOrNull(s, group), margin);
       },
       py::arg("group") = py::none(), py::arg("margin") = 0.0)
      .def("violations", &violations, py::arg("group") = py::none(), py::arg("margin") = 0.0)
      .def(
          "enforce_bounds",
          [](RobotState& s, const std::optional<std::string>& group) { s.enforceBounds(groupOrNull(s, group)); },
          py::arg("group") = py::none())
      .def(
          "normalize_continuous",
          [](RobotState& s, const std::optional<std::string>& group) { s.normalizeContinuous(groupOrNull(s, group)); },
          py::arg("group") = py::none())
      .def(
          "distance",
          [](const RobotState& s, const RobotState& other, const std::optional<std::string>& group) {
            return s.distance(other, groupOrNull(s, group));
          },
          py::arg("other"), py::arg("group") = py::none())
      .def(
          "interpolate",
          [](const RobotState& s, const RobotState& other, double t, const std::optional<std::string>& group) {
            return s.interpolate(other, t, groupOrNull(s, group));
          },
          py::arg("other"), py::arg("t"), py::arg("group") = py::none());
}

void bindPoses(py::class_<RobotState>& c)
{
  c.def("pose",
        [](const RobotState& s, const std::string& name) {
          Transform pose;
          if (!s.framePose(name, pose))
            throwUnknown("link or attached body", name, "robot '" + s.model()->name + "'", s.model()->linkNames());
          return pose;
        })
      .def("has_frame",
           [](const RobotState& s, const std::string& name) {
             Transform pose;
             return s.frameLink(name, pose) >= 0;
           })
      .def(
          "frame_link",
          [](const RobotState& s, const std::string& name) {
            Transform pose;
            const int link = s.frameLink(name, pose);
            if (link < 0)
              throwUnknown("link or attached body", name, "robot '" + s.model()->name + "'", s.model()->linkNames());
            return py::make_tuple(s.model()->links[link].name, pose);
          },
          "(the link that moves the frame, the frame's Pose in it).")
      .def(
          "poses",
          [](const RobotState& s, const std::optional<std::vector<std::string>>& links) {
            py::dict out;
            for (const std::string& name : links ? *links : s.model()->linkNames())
              out[py::str(name)] = poseToPython(s.linkPose(s.model()->link(name).index));
            return out;
          },
          py::arg("links") = py::none())
      .def("shape_poses",
           [](const RobotState& s, const std::string& name) {
             const LinkModel& link = s.model()->link(name);
             std::vector<Transform> out;
             for (const Transform& origin : link.shape_origins)
               out.push_back(s.linkPose(link.index) * origin);
             return out;
           })
      .def(
          "jacobian",
          [](const RobotState& s, const std::string& group, const std::string& link, const Vector3& point) {
            const JointModelGroup& g = s.model()->group(group);
            if (link.empty() && g.tip_link < 0)
              throw InvalidInput("group '" + group + "' is no chain: name the link of the Jacobian");
            return Eigen::MatrixXd(s.jacobian(g, link.empty() ? g.tip_link : s.model()->link(link).index, point));
          },
          py::arg("group"), py::arg("link") = "", py::arg("point") = Vector3(0, 0, 0),
          "(6, n): rows of velocity (m/s) and turning rate (rad/s) at `point` of `link`, in the group's base link.");
}
}  // namespace

void bindState(py::module_& m)
{
  bindBody(m);
  py::class_<RobotState> c(m, "RobotState", "A value for each variable, and what the robot carries.");
  c.def(py::init([](const std::shared_ptr<RobotModel>& model) { return RobotState(model); }), py::arg("model"))
      .def_property_readonly("model", [](const RobotState& s) { return std::const_pointer_cast<RobotModel>(s.model()); })
      .def("copy", [](const RobotState& s) { return RobotState(s); })
      .def("__copy__", [](const RobotState& s) { return RobotState(s); })
      .def("attach", [](RobotState& s, const std::shared_ptr<Body>& body) { s.attach(body); })
      .def("detach",
           [](RobotState& s, const std::string& id) {
             const AttachedBodyPtr body = s.detach(id);
             if (!body)
             {
               std::vector<std::string> known;
               for (const auto& [name, other] : s.attached())
                 known.push_back(name);
               throwUnknown("attached body", id, "the state", known);
             }
             return std::const_pointer_cast<Body>(body);
           })
      .def_property_readonly("attached",
                             [](const RobotState& s) {
                               std::vector<std::shared_ptr<Body>> out;
                               for (const auto& [id, body] : s.attached())
                                 out.push_back(std::const_pointer_cast<Body>(body));
                               return out;
                             })
      .def(
          "clear_attached", [](RobotState& s, const std::optional<std::string>& link) { s.clearAttached(link.value_or("")); },
          py::arg("link") = py::none())
      .def("__repr__", [](const RobotState& s) {
        return "<state of '" + s.model()->name + "', " + std::to_string(s.positions().size()) + " variables>";
      });
  bindValues(c);
  bindValuesOfParts(c);
  bindComparisons(c);
  bindPoses(c);
  bindOptional<&RobotState::velocities>(c, "velocities");
  bindOptional<&RobotState::efforts>(c, "efforts");
  bindOptional<&RobotState::accelerations>(c, "accelerations");
}
}  // namespace motion
