#pragma once
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// From a first point to a second.
template <typename T>
class Line3
{
public:
  Line3() = default;
  Line3(const Line3& line) = default;
  Line3(const Vector3<T>& a, const Vector3<T>& b) { Set(a, b); }
  Line3(double x1, double y1, double x2, double y2) { Set(x1, y1, x2, y2); }
  Line3(double x1, double y1, double z1, double x2, double y2, double z2) { Set(x1, y1, z1, x2, y2, z2); }
  Line3& operator=(const Line3& line) = default;
  void Set(const Vector3<T>& a, const Vector3<T>& b)
  {
    points_[0] = a;
    points_[1] = b;
  }
  void SetA(const Vector3<T>& a) { points_[0] = a; }
  void SetB(const Vector3<T>& b) { points_[1] = b; }
  void Set(double x1, double y1, double x2, double y2, double z = 0) { Set(x1, y1, z, x2, y2, z); }
  void Set(double x1, double y1, double z1, double x2, double y2, double z2)
  {
    points_[0].Set(static_cast<T>(x1), static_cast<T>(y1), static_cast<T>(z1));
    points_[1].Set(static_cast<T>(x2), static_cast<T>(y2), static_cast<T>(z2));
  }

  Vector3<T> Direction() const { return (points_[1] - points_[0]).Normalized(); }
  T Length() const { return points_[0].Distance(points_[1]); }
  /// The shortest line from this segment to the other; no line has none.
  bool Distance(const Line3& line, Line3& result, double epsilon = 1e-6) const;
  T Distance(const Vector3<T>& point) const
  {
    const Vector3<T> along = points_[1] - points_[0];
    const T square = along.SquaredLength();
    if (square <= 0)
      return point.Distance(points_[0]);
    const T t = clamp<T>((point - points_[0]).Dot(along) / square, 0, 1);
    return point.Distance(points_[0] + along * t);
  }
  bool Coplanar(const Line3& line, double epsilon = 1e-6) const
  {
    return std::abs((line.points_[0] - points_[0]).Dot((points_[0] - points_[1]).Cross(line.points_[0] - line.points_[1]))) <=
           epsilon;
  }
  bool Parallel(const Line3& line, double epsilon = 1e-6) const
  {
    return (points_[1] - points_[0]).Cross(line.points_[1] - line.points_[0]).Length() <= epsilon;
  }
  bool Intersect(const Line3& line, double epsilon = 1e-6) const
  {
    Vector3<T> point;
    return Intersect(line, point, epsilon);
  }
  bool Intersect(const Line3& line, Vector3<T>& point, double epsilon = 1e-6) const
  {
    Line3 between;
    if (!Distance(line, between, epsilon) || between.Length() >= epsilon)
      return false;
    point = between[0];
    return true;
  }
  /// In the box that the segment spans.
  bool Within(const Vector3<T>& point, double epsilon = 1e-6) const
  {
    for (int i = 0; i < 3; ++i)
      if (point[i] > std::max(points_[0][i], points_[1][i]) + epsilon ||
          point[i] < std::min(points_[0][i], points_[1][i]) - epsilon)
        return false;
    return true;
  }
  bool operator==(const Line3& line) const { return points_[0] == line.points_[0] && points_[1] == line.points_[1]; }
  bool operator!=(const Line3& line) const { return !(*this == line); }
  Vector3<T> operator[](std::size_t index) const { return points_[std::min<std::size_t>(index, 1)]; }
  friend std::ostream& operator<<(std::ostream& out, const Line3& line)
  {
    return out << line.points_[0] << " " << line.points_[1];
  }

private:
  Vector3<T> points_[2];
};

template <typename T>
bool Line3<T>::Distance(const Line3& line, Line3& result, double epsilon) const
{
  const Vector3<T> mine = points_[1] - points_[0], its = line.points_[1] - line.points_[0],
                   start = points_[0] - line.points_[0];
  const T a = mine.SquaredLength(), e = its.SquaredLength(), b = mine.Dot(its), c = mine.Dot(start), f = its.Dot(start);
  if (a < epsilon * epsilon || e < epsilon * epsilon)
    return false;
  const T turn = a * e - b * b;
  T s = std::abs(turn) < epsilon ? 0 : clamp<T>((b * f - c * e) / turn, 0, 1);
  T t = (b * s + f) / e;
  if (t < 0 || t > 1)
  {
    t = clamp<T>(t, 0, 1);
    s = clamp<T>((b * t - c) / a, 0, 1);
  }
  result.Set(points_[0] + mine * s, line.points_[0] + its * t);
  return true;
}

typedef Line3<int> Line3i;
typedef Line3<double> Line3d;
typedef Line3<float> Line3f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
