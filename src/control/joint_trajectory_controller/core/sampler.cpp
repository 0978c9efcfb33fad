// The samples of all joints of a trajectory, cycle by cycle, as segment.py has them: the same sums in the same order. Whatever is not
// ordinary (a next segment, a tolerance that is broken, the end of a goal) is left to controller.py, which tells it from then on.
#include <pybind11/pybind11.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace py = pybind11;

namespace
{
struct Joint
{
  const double* position = nullptr;  // measured, rad or m
  const double* velocity = nullptr;
  double* command = nullptr;  // where its position goes, or nobody takes it here
  bool angular = false;
  double start = 0, end = 0, next_start = 0;  // s; of the segment and of the one after it
  std::array<double, 6> c{};
  double end_position = 0;
  bool watched = false;                                   // the segment belongs to the goal
  double position_tolerance = 0, velocity_tolerance = 0;  // 0 or less: none
};

struct Point
{
  double position, velocity, acceleration;
};

Point sample(const Joint& joint, double time)
{
  if (time > joint.end)
    return { joint.end_position, 0.0, 0.0 };
  const auto& c = joint.c;
  const double t = time - joint.start;
  if (t < 0.0)
    return { c[0], 0.0, 0.0 };
  return { c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5])))),
           c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * 5.0 * c[5]))),
           2.0 * c[2] + t * (6.0 * c[3] + t * (12.0 * c[4] + t * 20.0 * c[5])) };
}

bool broken(double error, double tolerance) { return tolerance > 0.0 && !(std::abs(error) <= tolerance); }

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

  void follow(std::size_t index, double start, double end, const std::array<double, 6>& coefficients, double end_position,
              double next_start, bool watched, double position_tolerance, double velocity_tolerance)
  {
    Joint& joint = joints_.at(index);
    joint.start = start;
    joint.end = end;
    joint.c = coefficients;
    joint.end_position = end_position;
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
      points_[j] = sample(joint, time);
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
    const double error = point.position - *joint.position;
    if (joint.angular && !(-M_PI < error && error <= M_PI))
      return false;
    if (!watched)
      return true;
    if (time < joint.end)
      return !broken(error, joint.position_tolerance) && !broken(point.velocity - *joint.velocity, joint.velocity_tolerance);
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
      PyTuple_SET_ITEM(row, 0, PyFloat_FromDouble(points_[j].position - *joints_[j].position));
      PyTuple_SET_ITEM(row, 1, PyFloat_FromDouble(points_[j].velocity - *joints_[j].velocity));
      PyList_SET_ITEM(rows.ptr(), static_cast<Py_ssize_t>(j), row);
    }
    return rows;
  }

  std::vector<Joint> joints_;
  std::vector<Point> points_;
  const py::tuple nothing_ = py::make_tuple(py::tuple(), py::tuple());
};
}  // namespace

PYBIND11_MODULE(_sampler, m)
{
  m.doc() = "The samples of all joints of a trajectory, cycle by cycle.";
  py::class_<Sampler>(m, "Sampler")
      .def(py::init<>())
      .def("add_joint", &Sampler::addJoint, py::arg("position"), py::arg("velocity"), py::arg("angular"))
      .def("add_command", &Sampler::addCommand, py::arg("joint"), py::arg("command"))
      .def("follow",
           [](Sampler& s, std::size_t joint, double start, double end, const py::tuple& coefficients, double end_position,
              double next_start, bool watched, double position_tolerance, double velocity_tolerance) {
             if (coefficients.size() != 6)
               throw py::value_error("a segment has six coefficients");
             std::array<double, 6> c;
             for (std::size_t i = 0; i < c.size(); ++i)
               c[i] = coefficients[i].cast<double>();
             s.follow(joint, start, end, c, end_position, next_start, watched, position_tolerance, velocity_tolerance);
           })
      .def("quick", &Sampler::quick, py::arg("time"), py::arg("watch"), py::arg("whole"));
}
