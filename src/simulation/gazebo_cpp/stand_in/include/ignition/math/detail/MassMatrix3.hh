#pragma once
#include <ignition/math/MassMatrix3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
bool MassMatrix3<T>::positive(T epsilon, bool strictly) const
{
  // Sylvester's corners.
  const T corner = Ixx() * Iyy() - Ixy() * Ixy(), all = Moi().Determinant();
  const bool weak = mass_ >= 0 && Ixx() + epsilon >= 0 && corner + epsilon >= 0 && all + epsilon >= 0;
  return strictly ? mass_ > 0 && Ixx() + epsilon > 0 && corner + epsilon > 0 && all + epsilon > 0 : weak;
}

template <typename T>
void MassMatrix3<T>::solve(Vector3<T>& moments, Matrix3<T>& axes) const
{
  // Jacobi: one off-diagonal number after another is turned away.
  Matrix3<T> m = Moi();
  axes = Matrix3<T>::Identity;
  const T small = std::numeric_limits<T>::epsilon() * (std::abs(Ixx()) + std::abs(Iyy()) + std::abs(Izz()) + off_.Abs().Sum());
  for (int turn = 0; turn < 60; ++turn)
  {
    int p = 0, q = 1;
    for (const auto& [i, j] : { std::pair<int, int>(0, 2), std::pair<int, int>(1, 2) })
      if (std::abs(m(i, j)) > std::abs(m(p, q)))
        p = i, q = j;
    if (std::abs(m(p, q)) <= small)
      break;
    const T angle = static_cast<T>(0.5) * std::atan2(2 * m(p, q), m(q, q) - m(p, p));
    Matrix3<T> rotation = Matrix3<T>::Identity;
    rotation(p, p) = rotation(q, q) = std::cos(angle);
    rotation(p, q) = std::sin(angle);
    rotation(q, p) = -std::sin(angle);
    m = rotation.Transposed() * m * rotation;
    axes = axes * rotation;
  }
  int order[3] = { 0, 1, 2 };
  std::sort(order, order + 3, [&m](int a, int b) { return m(a, a) < m(b, b); });
  const Matrix3<T> unsorted = axes;
  for (int i = 0; i < 3; ++i)
  {
    moments[i] = m(order[i], order[i]);
    axes.Col(i, Vector3<T>(unsorted(0, order[i]), unsorted(1, order[i]), unsorted(2, order[i])));
  }
  if (axes.Determinant() < 0)
    axes.Col(2, Vector3<T>(-axes(0, 2), -axes(1, 2), -axes(2, 2)));
}

template <typename T>
Vector3<T> MassMatrix3<T>::PrincipalMoments(const T tolerance) const
{
  const T limit = tolerance * (tolerance < 0 ? -1 : std::max(std::abs(diagonal_.Max()), std::abs(diagonal_.Min())));
  if (off_.Equal(Vector3<T>::Zero, limit))
    return diagonal_;
  Vector3<T> moments;
  Matrix3<T> axes;
  solve(moments, axes);
  return moments;
}

template <typename T>
Quaternion<T> MassMatrix3<T>::PrincipalAxesOffset(const T tolerance) const
{
  const T limit = tolerance * (tolerance < 0 ? -1 : std::max(std::abs(diagonal_.Max()), std::abs(diagonal_.Min())));
  Vector3<T> moments;
  Matrix3<T> axes;
  solve(moments, axes);
  if (off_.Equal(Vector3<T>::Zero, limit) || std::abs(moments[2] - moments[0]) < limit)
    return Quaternion<T>::Identity;
  return Quaternion<T>(axes).Normalized();
}

template <typename T>
bool MassMatrix3<T>::EquivalentBox(Vector3<T>& size, Quaternion<T>& rotation, const T tolerance) const
{
  if (!IsPositive(0))
    return false;
  const Vector3<T> moments = PrincipalMoments(tolerance);
  if (!ValidMoments(moments))
    return false;
  for (int i = 0; i < 3; ++i)
    size[i] = std::sqrt(6 / mass_ * std::max<T>(0, moments[(i + 1) % 3] + moments[(i + 2) % 3] - moments[i]));
  rotation = tolerance < 0 ? PrincipalAxesOffset(-tolerance) : PrincipalAxesOffset(tolerance);
  return true;
}

template <typename T>
bool MassMatrix3<T>::SetFromBox(const Vector3<T>& size, const Quaternion<T>& rotation)
{
  if (mass_ <= 0 || size.Min() <= 0 || rotation == Quaternion<T>::Zero)
    return false;
  const Vector3<T> s = size * size;
  return turned(Vector3<T>(s[1] + s[2], s[2] + s[0], s[0] + s[1]) * (mass_ / 12), rotation);
}

template <typename T>
bool MassMatrix3<T>::SetFromCylinderZ(const T length, const T radius, const Quaternion<T>& rotation)
{
  if (mass_ <= 0 || length <= 0 || radius <= 0 || rotation == Quaternion<T>::Zero)
    return false;
  const T across = mass_ / 12 * (3 * radius * radius + length * length);
  return turned(Vector3<T>(across, across, mass_ / 2 * radius * radius), rotation);
}

template <typename T>
bool MassMatrix3<T>::SetFromSphere(const T radius)
{
  if (mass_ <= 0 || radius <= 0)
    return false;
  const T moment = static_cast<T>(0.4) * mass_ * radius * radius;
  return SetInertiaMatrix(moment, moment, moment, 0, 0, 0);
}

}  // namespace v6
}  // namespace math
}  // namespace ignition
