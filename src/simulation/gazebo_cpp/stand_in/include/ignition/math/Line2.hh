#pragma once
#include <ignition/math/Vector2.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// From a first point to a second.
template <typename T>
class Line2
{
public:
  Line2(const Vector2<T>& a, const Vector2<T>& b) { Set(a, b); }
  Line2(double x1, double y1, double x2, double y2) { Set(x1, y1, x2, y2); }
  void Set(const Vector2<T>& a, const Vector2<T>& b)
  {
    points_[0] = a;
    points_[1] = b;
  }
  void Set(double x1, double y1, double x2, double y2)
  {
    Set(Vector2<T>(static_cast<T>(x1), static_cast<T>(y1)), Vector2<T>(static_cast<T>(x2), static_cast<T>(y2)));
  }

  double CrossProduct(const Line2& line) const { return cross(along(), line.along()); }
  double CrossProduct(const Vector2<T>& point) const { return cross(points_[1] - points_[0], point - points_[1]); }
  bool Collinear(const Vector2<T>& point, double epsilon = 1e-6) const { return equal(CrossProduct(point), 0.0, epsilon); }
  bool Parallel(const Line2& line, double epsilon = 1e-6) const { return equal(CrossProduct(line), 0.0, epsilon); }
  bool Collinear(const Line2& line, double epsilon = 1e-6) const { return Parallel(line, epsilon) && Intersect(line, epsilon); }
  bool OnSegment(const Vector2<T>& point, double epsilon = 1e-6) const
  {
    return Collinear(point, epsilon) && Within(point, epsilon);
  }
  /// In the box that the segment spans.
  bool Within(const Vector2<T>& point, double epsilon = 1e-6) const
  {
    for (int i = 0; i < 2; ++i)
      if (point[i] > std::max(points_[0][i], points_[1][i]) + epsilon ||
          point[i] < std::min(points_[0][i], points_[1][i]) - epsilon)
        return false;
    return true;
  }
  bool Intersect(const Line2& line, double epsilon = 1e-6) const
  {
    Vector2<T> point;
    return Intersect(line, point, epsilon);
  }
  bool Intersect(const Line2& line, Vector2<T>& point, double epsilon = 1e-6) const
  {
    const double turn = CrossProduct(line);
    if (std::abs(turn) <= epsilon)
    {
      if (!equal(cross(along(), line.points_[0] - points_[0]), 0.0, epsilon))
        return false;
      for (int i = 0; i < 4; ++i)  // an end of the one on the other
      {
        const Line2 &owner = i < 2 ? line : *this, &other = i < 2 ? *this : line;
        point = owner.points_[i % 2];
        if (other.Within(point, epsilon))
          return true;
      }
      return false;
    }
    const Vector2<T> start = line.points_[0] - points_[0];
    const double here = cross(start, line.along()) / turn, there = cross(start, along()) / turn;
    if (here < 0 || here > 1 || there < 0 || there > 1)
      return false;
    point =
        Vector2<T>(static_cast<T>(points_[0].X() + here * along().X()), static_cast<T>(points_[0].Y() + here * along().Y()));
    return true;
  }
  T Length() const { return static_cast<T>(std::sqrt(along().SquaredLength())); }
  /// NAN_D where it stands upright.
  double Slope() const
  {
    return along().X() == 0 ? NAN_D : static_cast<double>(along().Y()) / static_cast<double>(along().X());
  }
  bool operator==(const Line2& line) const { return points_[0] == line.points_[0] && points_[1] == line.points_[1]; }
  bool operator!=(const Line2& line) const { return !(*this == line); }
  Vector2<T> operator[](std::size_t index) const { return points_[std::min<std::size_t>(index, 1)]; }
  friend std::ostream& operator<<(std::ostream& out, const Line2& line)
  {
    return out << line.points_[0] << " " << line.points_[1];
  }

private:
  Vector2<T> along() const { return points_[1] - points_[0]; }
  static double cross(const Vector2<T>& a, const Vector2<T>& b) { return a.X() * b.Y() - a.Y() * b.X(); }

  Vector2<T> points_[2];
};

typedef Line2<int> Line2i;
typedef Line2<double> Line2d;
typedef Line2<float> Line2f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
