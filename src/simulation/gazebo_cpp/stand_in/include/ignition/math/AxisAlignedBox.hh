#pragma once
#include <tuple>

#include <ignition/math/Helpers.hh>
#include <ignition/math/Line3.hh>
#include <ignition/math/MassMatrix3.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// A box along the axes; without corners it is empty, and holds nothing.
class IGNITION_MATH_VISIBLE AxisAlignedBox
{
public:
  AxisAlignedBox() : min_(MAX_D, MAX_D, MAX_D), max_(LOW_D, LOW_D, LOW_D) {}
  AxisAlignedBox(const Vector3d& a, const Vector3d& b) : min_(a), max_(a)
  {
    min_.Min(b);
    max_.Max(b);
  }
  AxisAlignedBox(double ax, double ay, double az, double bx, double by, double bz)
    : AxisAlignedBox(Vector3d(ax, ay, az), Vector3d(bx, by, bz))
  {
  }
  AxisAlignedBox(const AxisAlignedBox& box) = default;
  virtual ~AxisAlignedBox() = default;
  AxisAlignedBox& operator=(const AxisAlignedBox& box) = default;

  double XLength() const { return std::max(0.0, max_.X() - min_.X()); }
  double YLength() const { return std::max(0.0, max_.Y() - min_.Y()); }
  double ZLength() const { return std::max(0.0, max_.Z() - min_.Z()); }
  Vector3d Size() const { return Vector3d(XLength(), YLength(), ZLength()); }
  Vector3d Center() const { return min_ * 0.5 + max_ * 0.5; }
  double Volume() const { return XLength() * YLength() * ZLength(); }
  void Merge(const AxisAlignedBox& box)
  {
    min_.Min(box.min_);
    max_.Max(box.max_);
  }
  AxisAlignedBox operator+(const AxisAlignedBox& box) const
  {
    AxisAlignedBox result(*this);
    result.Merge(box);
    return result;
  }
  const AxisAlignedBox& operator+=(const AxisAlignedBox& box)
  {
    Merge(box);
    return *this;
  }
  bool operator==(const AxisAlignedBox& box) const { return min_ == box.min_ && max_ == box.max_; }
  bool operator!=(const AxisAlignedBox& box) const { return !(*this == box); }
  AxisAlignedBox operator-(const Vector3d& v) const { return AxisAlignedBox(min_ - v, max_ - v); }
  AxisAlignedBox operator+(const Vector3d& v) const { return AxisAlignedBox(min_ + v, max_ + v); }
  friend std::ostream& operator<<(std::ostream& out, const AxisAlignedBox& box)
  {
    return out << "Min[" << box.min_ << "] Max[" << box.max_ << "]";
  }
  const Vector3d& Min() const { return min_; }
  const Vector3d& Max() const { return max_; }
  Vector3d& Min() { return min_; }
  Vector3d& Max() { return max_; }

  bool Intersects(const AxisAlignedBox& box) const
  {
    for (unsigned int i = 0; i < 3; ++i)
      if (max_[i] < box.min_[i] || min_[i] > box.max_[i])
        return false;
    return true;
  }
  bool Contains(const Vector3d& p) const
  {
    for (unsigned int i = 0; i < 3; ++i)
      if (p[i] < min_[i] || p[i] > max_[i])
        return false;
    return true;
  }
  /// Of a ray, between two distances from its origin.
  bool IntersectCheck(const Vector3d& origin, const Vector3d& direction, double min, double max) const;
  std::tuple<bool, double> IntersectDist(const Vector3d& origin, const Vector3d& direction, double min, double max) const;
  std::tuple<bool, double, Vector3d> Intersect(const Vector3d& origin, const Vector3d& direction, double min, double max) const;
  std::tuple<bool, double, Vector3d> Intersect(const Line3d& line) const;

private:
  Vector3d min_, max_;
};

}  // namespace v6
}  // namespace math
}  // namespace ignition
