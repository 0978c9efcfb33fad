// The laws of wheeled bases for Python.
#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <diff_drive_controller/odometry_law.h>
#include <diff_drive_controller/speed_limiter.h>

namespace py = pybind11;
using namespace diff_drive_controller;

namespace
{

std::size_t window(long long size) { return static_cast<std::size_t>(std::max(0ll, size)); }

/// The law by a clock that counts in s.
struct PlanarOdometry : OdometryLaw
{
  explicit PlanarOdometry(long long size) : OdometryLaw(window(size)) {}
  void restart_at(double now)
  {
    restart();
    time = now;
  }
  double interval(double now) const { return now - time; }
  void travelled_until(double distance, double angle, double now)
  {
    if (travelled(Way{ distance, angle }, interval(now)))
      time = now;
  }
  void commanded_until(double forward, double turning, double now)
  {
    commanded(forward, turning, interval(now));
    time = now;
  }
  void moved_until(double forward, double left, double turning, double now)
  {
    if (moved(forward, left, turning, interval(now)))
      time = now;
  }
  double time = 0.0;
};

/// The law with the last two velocities that came out of it.
struct Limiter
{
  using Bounds = std::optional<std::pair<double, double>>;
  Limiter(const Bounds& velocity, const Bounds& acceleration, const Bounds& jerk)
  {
    const auto take = [](const Bounds& bounds, bool& has, double& low, double& high) {
      if ((has = bounds.has_value()))
        std::tie(low, high) = *bounds;
    };
    take(velocity, law.has_velocity_limits, law.min_velocity, law.max_velocity);
    take(acceleration, law.has_acceleration_limits, law.min_acceleration, law.max_acceleration);
    take(jerk, law.has_jerk_limits, law.min_jerk, law.max_jerk);
  }
  void reset() { last = second_last = 0.0; }
  double limit(double velocity, double dt)
  {
    law.limit(velocity, last, second_last, dt);
    second_last = last;
    return last = velocity;
  }
  SpeedLimiter law;
  double last = 0.0, second_last = 0.0;
};

py::tuple both(const Way& way) { return py::make_tuple(way.distance, way.angle); }

}  // namespace

PYBIND11_MODULE(laws, module)
{
  module.attr("MIN_INTERVAL") = OdometryLaw::min_interval();
  module.def("differential",
             [](double left, double right, double separation) { return both(differential(left, right, separation)); });
  module.def("bicycle", [](double distance, double steering, double base) { return both(bicycle(distance, steering, base)); });
  py::class_<RollingMean>(module, "RollingMean")
      .def(py::init([](long long size) { return RollingMean(window(size)); }))
      .def("__call__", &RollingMean::operator())
      .def("clear", &RollingMean::clear);
  py::class_<WheelTravel>(module, "WheelTravel")
      .def(py::init<>())
      .def("__call__", &WheelTravel::operator())
      .def("restart", &WheelTravel::restart);
  py::class_<PlanarOdometry>(module, "PlanarOdometry")
      .def(py::init<long long>(), py::arg("window"))
      .def("restart", &PlanarOdometry::restart_at)
      .def("interval", &PlanarOdometry::interval)
      .def("travelled", &PlanarOdometry::travelled_until)
      .def("commanded", &PlanarOdometry::commanded_until)
      .def("moved", &PlanarOdometry::moved_until)
      .def_readonly("x", &PlanarOdometry::x)
      .def_readonly("y", &PlanarOdometry::y)
      .def_readonly("heading", &PlanarOdometry::heading)
      .def_readonly("linear", &PlanarOdometry::linear)
      .def_readonly("linear_y", &PlanarOdometry::linear_y)
      .def_readonly("angular", &PlanarOdometry::angular);
  py::class_<Limiter>(module, "SpeedLimiter")
      .def(py::init<const Limiter::Bounds&, const Limiter::Bounds&, const Limiter::Bounds&>(), py::arg("velocity") = py::none(),
           py::arg("acceleration") = py::none(), py::arg("jerk") = py::none())
      .def("reset", &Limiter::reset)
      .def("limit", &Limiter::limit)
      .def_readonly("last", &Limiter::last);
}
