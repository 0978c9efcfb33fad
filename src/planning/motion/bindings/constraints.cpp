#include "motion/constraints.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
using Region = std::vector<std::pair<std::shared_ptr<Shape>, Transform>>;

Quaternion quaternion(const Array& values)
{
  const auto q = fromArray(values, 4, "the quaternion of an orientation constraint");
  return Quaternion(q[3], q[0], q[1], q[2]);
}

void setRegion(PositionConstraint& c, const Region& region)
{
  c.shapes.clear();
  c.poses.clear();
  for (const auto& [shape, pose] : region)
  {
    c.shapes.push_back(shape);
    c.poses.push_back(pose);
  }
}

Region region(const PositionConstraint& c)
{
  Region out;
  for (std::size_t i = 0; i < c.shapes.size(); ++i)
    out.emplace_back(std::const_pointer_cast<Shape>(c.shapes[i]), i < c.poses.size() ? c.poses[i] : Transform::Identity());
  return out;
}

void setParameterization(OrientationConstraint& c, const std::string& name)
{
  if (name != "euler" && name != "rotation_vector")
    throw InvalidInput("orientation constraint: parameterization '" + name.substr(0, 40) +
                       "' is neither 'euler' nor 'rotation_vector'");
  c.rotation_vector = name == "rotation_vector";
}

void setView(VisibilityConstraint& c, const std::string& axis)
{
  if (axis != "x" && axis != "y" && axis != "z")
    throw InvalidInput("visibility constraint: sensor_view '" + axis.substr(0, 40) + "' is none of 'x', 'y', 'z'");
  c.sensor_view = axis[0];
}

void bindJointConstraint(py::module_& m)
{
  py::class_<JointConstraint>(m, "JointConstraint", "A joint within [position - below, position + above], rad or m.")
      .def(py::init([](const std::string& joint, double position, double above, double below, double weight) {
             return JointConstraint{joint, position, above, below, weight};
           }),
           py::arg("joint"), py::arg("position"), py::arg("above") = 0.0, py::arg("below") = 0.0, py::arg("weight") = 1.0)
      .def_readwrite("joint", &JointConstraint::joint)
      .def_readwrite("position", &JointConstraint::position)
      .def_readwrite("above", &JointConstraint::above)
      .def_readwrite("below", &JointConstraint::below)
      .def_readwrite("weight", &JointConstraint::weight);
}

void bindPositionConstraint(py::module_& m)
{
  py::class_<PositionConstraint>(m, "PositionConstraint", "A point of a link inside one of the shapes of a region.")
      .def(py::init([](const std::string& link, const Region& shapes, const Vector3& offset, const std::string& frame,
                       double weight) {
             PositionConstraint c;
             c.link = link;
             c.frame = frame;
             c.offset = offset;
             c.weight = weight;
             setRegion(c, shapes);
             return c;
           }),
           py::arg("link"), py::arg("region"), py::arg("offset") = Vector3(0, 0, 0), py::arg("frame") = "",
           py::arg("weight") = 1.0)
      .def_readwrite("link", &PositionConstraint::link)
      .def_readwrite("frame", &PositionConstraint::frame)
      .def_readwrite("offset", &PositionConstraint::offset)
      .def_property("region", &region, &setRegion)
      .def_readwrite("weight", &PositionConstraint::weight);
}

void bindOrientationConstraint(py::module_& m)
{
  py::class_<OrientationConstraint>(m, "OrientationConstraint", "A link turned as wanted, within (3,) tolerances in rad.")
      .def(py::init([](const std::string& link, const Array& q, const Vector3& tolerance, const std::string& parameterization,
                       const std::string& frame, double weight) {
             OrientationConstraint c;
             c.link = link;
             c.frame = frame;
             c.orientation = quaternion(q);
             c.tolerance = tolerance;
             c.weight = weight;
             setParameterization(c, parameterization);
             return c;
           }),
           py::arg("link"), py::arg("quaternion"), py::arg("tolerance"), py::arg("parameterization") = "euler",
           py::arg("frame") = "", py::arg("weight") = 1.0)
      .def_readwrite("link", &OrientationConstraint::link)
      .def_readwrite("frame", &OrientationConstraint::frame)
      .def_property(
          "quaternion", [](const OrientationConstraint& c) { return Eigen::Vector4d(c.orientation.coeffs()); },
          [](OrientationConstraint& c, const Array& q) { c.orientation = quaternion(q); })
      .def_readwrite("tolerance", &OrientationConstraint::tolerance)
      .def_property(
          "parameterization", [](const OrientationConstraint& c) { return c.rotation_vector ? "rotation_vector" : "euler"; },
          &setParameterization)
      .def_readwrite("weight", &OrientationConstraint::weight);
}

void bindVisibilityConstraint(py::module_& m)
{
  using C = VisibilityConstraint;
  py::class_<C>(m, "VisibilityConstraint", "The robot keeps out of the cone from a sensor to a disc.")
      .def(py::init([](const Transform& target_pose, const std::string& target_frame, double target_radius,
                       const Transform& sensor_pose, const std::string& sensor_frame, int cone_sides, double max_view_angle,
                       double max_range_angle, const std::string& sensor_view, double weight) {
             C c;
             c.target_pose = target_pose, c.target_frame = target_frame, c.target_radius = target_radius;
             c.sensor_pose = sensor_pose, c.sensor_frame = sensor_frame, c.cone_sides = cone_sides;
             c.max_view_angle = max_view_angle, c.max_range_angle = max_range_angle, c.weight = weight;
             setView(c, sensor_view);
             return c;
           }),
           py::arg("target_pose"), py::arg("target_frame"), py::arg("target_radius"), py::arg("sensor_pose"),
           py::arg("sensor_frame"), py::arg("cone_sides") = 4, py::arg("max_view_angle") = 0.0,
           py::arg("max_range_angle") = 0.0, py::arg("sensor_view") = "z", py::arg("weight") = 1.0)
      .def_readwrite("target_pose", &C::target_pose)
      .def_readwrite("target_frame", &C::target_frame)
      .def_readwrite("target_radius", &C::target_radius)
      .def_readwrite("sensor_pose", &C::sensor_pose)
      .def_readwrite("sensor_frame", &C::sensor_frame)
      .def_readwrite("cone_sides", &C::cone_sides)
      .def_readwrite("max_view_angle", &C::max_view_angle)
      .def_readwrite("max_range_angle", &C::max_range_angle)
      .def_property(
          "sensor_view", [](const C& c) { return std::string(1, c.sensor_view); }, &setView)
      .def_readwrite("weight", &C::weight);
}
}  // namespace

void bindConstraints(py::module_& m)
{
  bindJointConstraint(m);
  bindPositionConstraint(m);
  bindOrientationConstraint(m);
  bindVisibilityConstraint(m);
  py::class_<Constraints>(m, "Constraints", "All of them have to hold.")
      .def(py::init([](std::vector<JointConstraint> joint, std::vector<PositionConstraint> position,
                       std::vector<OrientationConstraint> orientation, std::vector<VisibilityConstraint> visibility,
                       const std::string& name) {
             return Constraints{name, joint, position, orientation, visibility};
           }),
           py::arg("joint") = std::vector<JointConstraint>(), py::arg("position") = std::vector<PositionConstraint>(),
           py::arg("orientation") = std::vector<OrientationConstraint>(),
           py::arg("visibility") = std::vector<VisibilityConstraint>(), py::arg("name") = "")
      .def_readwrite("name", &Constraints::name)
      .def_readwrite("joint", &Constraints::joint)
      .def_readwrite("position", &Constraints::position)
      .def_readwrite("orientation", &Constraints::orientation)
      .def_readwrite("visibility", &Constraints::visibility)
      .def("empty", &Constraints::empty)
      .def("merged", [](const Constraints& a, const Constraints& b) {
        Constraints out = a;
        out.joint.insert(out.joint.end(), b.joint.begin(), b.joint.end());
        out.position.insert(out.position.end(), b.position.begin(), b.position.end());
        out.orientation.insert(out.orientation.end(), b.orientation.begin(), b.orientation.end());
        out.visibility.insert(out.visibility.end(), b.visibility.begin(), b.visibility.end());
        return out;
      });
  py::class_<ConstraintResult>(m, "ConstraintResult")
      .def_readonly("satisfied", &ConstraintResult::satisfied)
      .def_readonly("distance", &ConstraintResult::distance)
      .def_readonly("description", &ConstraintResult::description)
      .def("__bool__", [](const ConstraintResult& r) { return r.satisfied; });
  m.def(
      "evaluate",
      [](const PlanningScene& scene, const RobotState& state, const Constraints& constraints) {
        return ConstraintSet(scene, constraints).evaluate(state);
      },
      py::arg("scene"), py::arg("state"), py::arg("constraints"),
      "One ConstraintResult for each: joint, position, orientation, visibility.");
  m.def("_project",
        [](const PlanningScene& scene, RobotState& state, const std::string& group, const Constraints& constraints) {
          return ConstraintSet(scene, constraints).project(state, scene.model()->group(group));
        });
}
}  // namespace motion
