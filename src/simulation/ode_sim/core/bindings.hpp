// How the bindings take and give vectors, poses and numbers: 3-tuples, 7-tuples (x y z qx qy qz qw), SI units, world axes.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <stdexcept>
#include <string>
#include <tuple>

#include "limits.hpp"
#include "world.hpp"

namespace py = pybind11;

namespace ode_sim {

using T3 = std::tuple<double, double, double>;
using T7 = std::tuple<double, double, double, double, double, double, double>;

inline T3 out(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Vec3 in(const T3& t) { return checked(Vec3{std::get<0>(t), std::get<1>(t), std::get<2>(t)}, "a vector"); }
inline T7 out(const Pose& X) { return {X.p.x, X.p.y, X.p.z, X.q.x, X.q.y, X.q.z, X.q.w}; }
inline Pose in(const T7& t, double most = kFarthestPart) {
  return checked(
      Pose{{std::get<0>(t), std::get<1>(t), std::get<2>(t)}, {std::get<3>(t), std::get<4>(t), std::get<5>(t), std::get<6>(t)}},
      "a pose", most);
}
using T6 = std::tuple<double, double, double, double, double, double>;
inline Sym3 in(const T6& t) {  // ixx iyy izz ixy ixz iyz
  const Sym3 m{std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t), std::get<4>(t), std::get<5>(t)};
  for (double v : {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz}) checked(v, "a moment of inertia");
  return m;
}
inline double in_mass(double mass) {
  if (!(mass > 0)) throw std::invalid_argument("a mass must be positive, not " + shown(mass));
  return checked(mass, "a mass");
}
inline Axis& axis_of(Joint& j, int i) {
  if (i >= 0 && i < std::max(j.axis_count, 1)) return j.axes[i];
  throw std::invalid_argument("a joint of " + std::to_string(j.axis_count) + " axes has no axis " + std::to_string(i));
}
inline void push(Vec3& sum, const Vec3& f) { sum = limited(sum + f, kStrongest, "a force"); }
inline World& world_of(Model* model) {
  if (!model || !model->world) throw std::runtime_error("this model is no longer in the world");
  return *model->world;
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// module_shapes.cpp, module_links.cpp, module_joints.cpp, module_models.cpp, module_noise.cpp, module_rays.cpp
void bind_shapes(py::module_& m);
void bind_links(py::module_& m);
void bind_joints(py::module_& m);
void bind_models(py::module_& m);
void bind_noise(py::module_& m);
void bind_rays(py::module_& m);  // after the world

}  // namespace ode_sim
