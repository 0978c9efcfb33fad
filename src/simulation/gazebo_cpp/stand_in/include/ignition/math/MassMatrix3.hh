#pragma once
#include <ignition/math/Helpers.hh>
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
constexpr T IGN_MASSMATRIX3_DEFAULT_TOLERANCE = T(10);

/// Mass, and moments of inertia about its centre.
template <typename T>
class MassMatrix3
{
public:
  MassMatrix3() = default;
  MassMatrix3(const T& mass, const Vector3<T>& diagonal, const Vector3<T>& off) : mass_(mass), diagonal_(diagonal), off_(off) {}
  MassMatrix3(const MassMatrix3& m) = default;
  virtual ~MassMatrix3() = default;
  MassMatrix3& operator=(const MassMatrix3& m) = default;

  // All that set tell whether the result can be of a body.
  bool SetMass(const T& mass)
  {
    mass_ = mass;
    return IsValid();
  }
  bool Mass(const T& mass) { return SetMass(mass); }
  T Mass() const { return mass_; }
  bool SetInertiaMatrix(const T& ixx, const T& iyy, const T& izz, const T& ixy, const T& ixz, const T& iyz)
  {
    diagonal_.Set(ixx, iyy, izz);
    off_.Set(ixy, ixz, iyz);
    return IsValid();
  }
  bool InertiaMatrix(const T& ixx, const T& iyy, const T& izz, const T& ixy, const T& ixz, const T& iyz)
  {
    return SetInertiaMatrix(ixx, iyy, izz, ixy, ixz, iyz);
  }
  Vector3<T> DiagonalMoments() const { return diagonal_; }
  Vector3<T> OffDiagonalMoments() const { return off_; }
  bool SetDiagonalMoments(const Vector3<T>& v)
  {
    diagonal_ = v;
    return IsValid();
  }
  bool SetOffDiagonalMoments(const Vector3<T>& v)
  {
    off_ = v;
    return IsValid();
  }
  bool DiagonalMoments(const Vector3<T>& v) { return SetDiagonalMoments(v); }
  bool OffDiagonalMoments(const Vector3<T>& v) { return SetOffDiagonalMoments(v); }
#define NOETIC_MOMENT(Name, NAME, field) \
  T Name() const { return field; }       \
  T NAME() const { return field; }       \
  bool Set##Name(const T& v)             \
  {                                      \
    field = v;                           \
    return IsValid();                    \
  }                                      \
  bool NAME(const T& v) { return Set##Name(v); }
  NOETIC_MOMENT(Ixx, IXX, diagonal_.X())
  NOETIC_MOMENT(Iyy, IYY, diagonal_.Y())
  NOETIC_MOMENT(Izz, IZZ, diagonal_.Z())
  NOETIC_MOMENT(Ixy, IXY, off_.X())
  NOETIC_MOMENT(Ixz, IXZ, off_.Y())
  NOETIC_MOMENT(Iyz, IYZ, off_.Z())
#undef NOETIC_MOMENT
  Matrix3<T> Moi() const { return Matrix3<T>(Ixx(), Ixy(), Ixz(), Ixy(), Iyy(), Iyz(), Ixz(), Iyz(), Izz()); }
  Matrix3<T> MOI() const { return Moi(); }
  bool SetMoi(const Matrix3<T>& m)
  {
    const T half = static_cast<T>(0.5);
    return SetInertiaMatrix(m(0, 0), m(1, 1), m(2, 2), half * (m(0, 1) + m(1, 0)), half * (m(0, 2) + m(2, 0)),
                            half * (m(1, 2) + m(2, 1)));
  }
  bool MOI(const Matrix3<T>& m) { return SetMoi(m); }
  bool operator==(const MassMatrix3& m) const { return equal<T>(mass_, m.mass_) && diagonal_ == m.diagonal_ && off_ == m.off_; }
  bool operator!=(const MassMatrix3& m) const { return !(*this == m); }

  bool IsPositive(const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>) const { return positive(Epsilon(tolerance), true); }
  bool IsNearPositive(const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>) const
  {
    return positive(Epsilon(tolerance), false);
  }
  T Epsilon(const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>) const { return Epsilon(diagonal_, tolerance); }
  static T Epsilon(const Vector3<T>& moments, const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>)
  {
    return tolerance * std::numeric_limits<T>::epsilon() * moments.Max();
  }
  bool IsValid(const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>) const
  {
    return IsNearPositive(tolerance) && ValidMoments(PrincipalMoments(), tolerance);
  }
  /// No moment is larger than the other two together.
  static bool ValidMoments(const Vector3<T>& m, const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>)
  {
    const T epsilon = Epsilon(m, tolerance);
    return m[0] + epsilon >= 0 && m[1] + epsilon >= 0 && m[2] + epsilon >= 0 && m[0] + m[1] + epsilon >= m[2] &&
           m[1] + m[2] + epsilon >= m[0] && m[2] + m[0] + epsilon >= m[1];
  }
  /// Those of the diagonal as they stand, others in their order of size.
  Vector3<T> PrincipalMoments(const T tolerance = 1e-6) const;
  /// The rotation of the axes to which the principal moments belong.
  Quaternion<T> PrincipalAxesOffset(const T tolerance = 1e-6) const;
  /// The box of even density that turns like this.
  bool EquivalentBox(Vector3<T>& size, Quaternion<T>& rotation, const T tolerance = 1e-6) const;
  bool SetFromBox(const T mass, const Vector3<T>& size, const Quaternion<T>& rotation = Quaternion<T>::Identity)
  {
    return mass > 0 && size.Min() > 0 && SetMassThen(mass) && SetFromBox(size, rotation);
  }
  bool SetFromBox(const Vector3<T>& size, const Quaternion<T>& rotation = Quaternion<T>::Identity);
  bool SetFromCylinderZ(const T mass, const T length, const T radius, const Quaternion<T>& rotation = Quaternion<T>::Identity)
  {
    return mass > 0 && length > 0 && radius > 0 && SetMassThen(mass) && SetFromCylinderZ(length, radius, rotation);
  }
  bool SetFromCylinderZ(const T length, const T radius, const Quaternion<T>& rotation);
  bool SetFromSphere(const T mass, const T radius)
  {
    return mass > 0 && radius > 0 && SetMassThen(mass) && SetFromSphere(radius);
  }
  bool SetFromSphere(const T radius);

private:
  bool SetMassThen(T mass)
  {
    mass_ = mass;
    return true;
  }
  bool positive(T epsilon, bool strictly) const;
  /// The moments in the order of their size, and their axes as columns.
  void solve(Vector3<T>& moments, Matrix3<T>& axes) const;
  bool turned(const Vector3<T>& moments, const Quaternion<T>& rotation)
  {
    const Matrix3<T> m(rotation);
    return SetMoi(m * Matrix3<T>(moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2]) * m.Transposed());
  }

  T mass_ = 0;
  Vector3<T> diagonal_, off_;
};

typedef MassMatrix3<double> MassMatrix3d;
typedef MassMatrix3<float> MassMatrix3f;

}  // namespace v6
}  // namespace math
}  // namespace ignition

#include <ignition/math/detail/MassMatrix3.hh>
