// The laws of trajectories for Python, and by them the samples of all joints, cycle by cycle, in one call. Whatever is not ordinary (a
// next segment, a tolerance that is broken, the end of a goal) is left to controller.py, which tells it from then on.
#include <pybind11/pybind11.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <joint_trajectory_controller/tracking_law.h>
#include <trajectory_interface/spline_law.h>

namespace py = pybind11;
namespace law = joint_trajectory_controller::law;
using Knot = trajectory_interface::Knot<double>;
using Point = trajectory_interface::Sample<double>;
using Spline = trajectory_interface::SplineLaw<double>;

namespace
{
struct Joint
{
  const double* position = nullptr;  // measured, rad or m
  const double* velocity = nullptr;
  double* command = nullptr;  // where its position goes, or nobody takes it here
  bool angular = false;
  Spline segment;
  double next_start = 0;                                  // s, of the segment after it
  bool watched = false;                                   // the segment belongs to the goal
  double position_tolerance = 0, velocity_tolerance = 0;  // 0 or less: none
};

class Sampler
{
public:
  void addJoint(std::uintptr_t position, std::uintptr_t velocity, bool angular)
  {
    Joint joint;
    joint.position = reinterpret_cast<const double*>(position);
    joint.velocity = reinterpret_cast<const double*>(velocity);
    joint.angular = angular;
    joints_.push_back(joint);
    points_.emplace_back();
  }

  void addCommand(std::size_t index, std::uintptr_t command) { joints_.at(index).command = reinterpret_cast<double*>(command); }

  void follow(std::size_t index, const Spline& segment, double next_start, bool watched, double position_tolerance,
              double velocity_tolerance)
  {
    Joint& joint = joints_.at(index);
    joint.segment = segment;
    joint.next_start = next_start;
    joint.watched = watched;
    joint.position_tolerance = position_tolerance;
    joint.velocity_tolerance = velocity_tolerance;
  }

  py::object quick(double time, bool watch, bool whole)
  {
    for (std::size_t j = 0; j < joints_.size(); ++j)
    {
      const Joint& joint = joints_[j];
      if (!(time < joint.next_start))
        return py::none();
      points_[j] = joint.segment.sample(time);
      if (!ordinary(joint, points_[j], time, watch && joint.watched))
        return py::none();
    }
    bool written = true;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j].command)
        *joints_[j].command = points_[j].position;
      else
        written = false;
    if (written && !whole)
      return nothing_;
    return py::reinterpret_steal<py::object>(PyTuple_Pack(2, desired().ptr(), (whole ? errors() : py::list()).ptr()));
  }

private:
  static bool ordinary(const Joint& joint, const Point& point, double time, bool watched)
  {
    const double error = law::position_error(*joint.position, point.position, joint.angular);
    if (!watched)
      return true;
    if (time < joint.segment.end())
      return !law::exceeds(error, joint.position_tolerance) &&
             !law::exceeds(point.velocity - *joint.velocity, joint.velocity_tolerance);
    return std::isfinite(joint.next_start);  // else the goal is decided upon
  }

  py::list desired() const
  {
    py::list rows(points_.size());
    for (std::size_t j = 0; j < points_.size(); ++j)
    {
      PyObject* row = PyTuple_New(3);
      PyTuple_SET_ITEM(row, 0, PyFloat_FromDouble(points_[j].position));
      PyTuple_SET_ITEM(row, 1, PyFloat_FromDouble(points_[j].velocity));
      PyTuple_SET_ITEM(row, 2, PyFloat_FromDouble(points_[j].acceleration));
      PyList_SET_ITEM(rows.ptr(), static_cast<Py_ssize_t>(j), row);
    }
    return rows;
  }

  py::list errors() const
  {
    py::list rows(points_.size());
    for (std::size_t j = 0; j < points_.size(); ++j)
    {
      PyObject* row = PyTuple_New(2);
      PyTuple_SET_ITEM(row, 0,
                       PyFloat_FromDouble(law::position_error(*joints_[j].position, points_[j].position, joints_[j].angular)));
      PyTuple_SET_ITEM(row, 1, PyFloat_FromDouble(points_[j].velocity - *joints_[j].velocity));
      PyList_SET_ITEM(rows.ptr(), static_cast<Py_ssize_t>(j), row);
    }
    return rows;
  }

  std::vector<Joint> joints_;
  std::vector<Point> points_;
  const py::tuple nothing_ = py::make_tuple(py::tuple(), py::tuple());
};
/// \param state position, and velocity and acceleration or None
Knot knot(const py::tuple& state)
{
  Knot k;
  k.position = state[0].cast<double>();
  k.has_velocity = !state[1].is_none();
  k.has_acceleration = !state[2].is_none();
  if (k.has_velocity)
    k.velocity = state[1].cast<double>();
  if (k.has_acceleration)
    k.acceleration = state[2].cast<double>();
  return k;
}

py::tuple sample(const Spline& spline, double time)
{
  const Point at = spline.sample(time);
  return py::make_tuple(at.position, at.velocity, at.acceleration);
}

py::tuple coefficients(const Spline& spline)
{
  const Spline::Coefficients& c = spline.coefficients();
  return py::make_tuple(c[0], c[1], c[2], c[3], c[4], c[5]);
}

Spline stop(double start, double position, double velocity, double duration)
{
  const law::Ends<double> ends = law::stop(position, velocity, duration);
  return Spline(start, ends.first, duration > 0.0 ? start + duration : start, ends.last);
}

}  // namespace

PYBIND11_MODULE(_sampler, m)
{
  m.doc() = "The laws of trajectories, and the samples of all joints, cycle by cycle.";
  py::class_<Spline>(m, "Spline")
      .def(py::init([](double start, const py::tuple& first, double end, const py::tuple& last) {
        return Spline(start, knot(first), end, knot(last));
      }))
      .def(py::init<const Spline&>())
      .def_static("stop", &stop, py::arg("start"), py::arg("position"), py::arg("velocity"), py::arg("duration"))
      .def("sample", &sample)
      .def("move", &Spline::move)
      .def_property_readonly("start", &Spline::start)
      .def_property_readonly("end", &Spline::end)
      .def_property_readonly("end_position", &Spline::rest)
      .def_property_readonly("coefficients", &coefficients);
  m.def("position_error", &law::position_error);
  m.def("violation", &law::violation);
  m.def("overridden", &law::overridden<double>);
  m.def("has_passed", &law::has_passed);
  m.def("joining_time", &law::joining_time);
  m.def("turns_to_add", &law::turns_to_add);
  py::class_<Sampler>(m, "Sampler")
      .def(py::init<>())
      .def("add_joint", &Sampler::addJoint, py::arg("position"), py::arg("velocity"), py::arg("angular"))
      .def("add_command", &Sampler::addCommand, py::arg("joint"), py::arg("command"))
      .def("follow", &Sampler::follow, py::arg("joint"), py::arg("segment"), py::arg("next_start"), py::arg("watched"),
           py::arg("position_tolerance"), py::arg("velocity_tolerance"))
      .def("quick", &Sampler::quick, py::arg("time"), py::arg("watch"), py::arg("whole"));
}
