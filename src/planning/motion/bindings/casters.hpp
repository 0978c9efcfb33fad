// How poses, arrays and posture objects cross between Python and C++.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "motion/robot_state.hpp"

namespace py = pybind11;

namespace motion
{
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline py::array_t<double> toArray(const std::vector<double>& values)
{
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

inline py::array_t<double> toArray(const std::vector<std::vector<double>>& rows, std::size_t width)
{
  py::array_t<double> out({rows.size(), width});
  auto cells = out.mutable_unchecked<2>();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < width; ++j)
      cells(i, j) = rows[i][j];
  return out;
}

// A vector of exactly `size` finite numbers; `what` is named in the error.
inline std::vector<double> fromArray(const Array& array, std::size_t size, const std::string& what)
{
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != size)
    throw InvalidInput(
        what + ": " + std::to_string(size) + " numbers are needed, not " +
        (array.ndim() == 1 ? std::to_string(array.shape(0)) : "an array of " + std::to_string(array.ndim()) + " dimensions"));
  std::vector<double> out(array.data(), array.data() + size);
  for (std::size_t i = 0; i < size; ++i)
    if (!std::isfinite(out[i]))
      throw InvalidInput(what + ": number " + std::to_string(i + 1) + " is not finite");
  return out;
}

// Rows of `width` finite numbers.
inline std::vector<std::vector<double>> rowsFromArray(const Array& array, std::size_t width, const std::string& what)
{
  if (array.size() == 0)
    return {};
  if (array.ndim() != 2 || static_cast<std::size_t>(array.shape(1)) != width)
    throw InvalidInput(what + ": an array of " + std::to_string(width) + " columns is needed");
  std::vector<std::vector<double>> out(array.shape(0));
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
  {
    out[i].assign(array.data(i, 0), array.data(i, 0) + width);
    for (double value : out[i])
      if (!std::isfinite(value))
        throw InvalidInput(what + ": row " + std::to_string(i + 1) + " is not finite");
  }
  return out;
}

inline Transform poseFromPython(py::handle source)
{
  py::sequence pair = py::reinterpret_borrow<py::sequence>(source);
  const auto position = fromArray(Array::ensure(pair[0]), 3, "the position of a pose");
  const auto q = fromArray(Array::ensure(pair[1]), 4, "the quaternion of a pose");
  const Quaternion quaternion(q[3], q[0], q[1], q[2]);
  if (quaternion.norm() < 1e-6)
    throw InvalidInput("the quaternion of a pose is zero: (0, 0, 0, 1) is no rotation");
  Transform pose = Transform::Identity();
  pose.translation() = Vector3(position[0], position[1], position[2]);
  pose.linear() = quaternion.normalized().toRotationMatrix();
  return pose;
}

inline py::object poseToPython(const Transform& pose)
{
  const Quaternion q(pose.linear());
  py::array_t<double> position(3), quaternion(4);
  std::copy(pose.translation().data(), pose.translation().data() + 3, position.mutable_data());
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  double* out = quaternion.mutable_data();
  out[0] = sign * q.x(), out[1] = sign * q.y(), out[2] = sign * q.z(), out[3] = sign * q.w();
  return py::module_::import("motion.pose").attr("Pose")(position, quaternion);
}
}  // namespace motion

namespace pybind11::detail
{
template <>
struct type_caster<motion::Transform>
{
  PYBIND11_TYPE_CASTER(motion::Transform, const_name("Pose"));

  bool load(handle source, bool)
  {
    if (!source || isinstance<str>(source) || !PySequence_Check(source.ptr()) || PySequence_Size(source.ptr()) != 2)
      return false;
    value = motion::poseFromPython(source);
    return true;
  }

  static handle cast(const motion::Transform& pose, return_value_policy, handle)
  {
    return motion::poseToPython(pose).release();
  }
};
}  // namespace pybind11::detail

namespace motion
{
void bindModel(py::module_& m);
void bindState(py::module_& m);
void bindShapes(py::module_& m);
void bindScene(py::module_& m);
void bindConstraints(py::module_& m);
void bindIk(py::module_& m);
void bindPlanning(py::module_& m);
void bindTiming(py::module_& m);
void bindOctree(py::module_& m);
}  // namespace motion
