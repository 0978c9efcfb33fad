#pragma once
#include <optional>

#include <ignition/math/AxisAlignedBox.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// The points whose product with the normal is the offset.
template <typename T>
class Plane
{
public:
  enum PlaneSide
  {
    NEGATIVE_SIDE = 0,
    POSITIVE_SIDE = 1,
    NO_SIDE = 2,
    BOTH_SIDE = 3
  };

  Plane() = default;
  Plane(const Vector3<T>& normal, T offset = 0.0) : normal_(normal), offset_(offset) {}
  Plane(const Vector3<T>& normal, const Vector2<T>& size, T offset) : normal_(normal), size_(size), offset_(offset) {}
  Plane(const Plane& plane) = default;
  virtual ~Plane() = default;
  Plane& operator=(const Plane& plane) = default;

  void Set(const Vector3<T>& normal, T offset)
  {
    normal_ = normal;
    offset_ = offset;
  }
  void Set(const Vector3<T>& normal, const Vector2<T>& size, T offset) { *this = Plane(normal, size, offset); }
  T Distance(const Vector3<T>& point) const { return normal_.Dot(point) - offset_; }
  /// Along a ray; none that meets it is 0.
  T Distance(const Vector3<T>& origin, const Vector3<T>& direction) const
  {
    const T slope = normal_.Dot(direction);
    return std::abs(slope) < 1e-3 ? 0 : (offset_ - normal_.Dot(origin)) / slope;
  }
  std::optional<Vector3<T>> Intersection(const Vector3<T>& point, const Vector3<T>& gradient,
                                         const double& tolerance = 1e-6) const
  {
    const T slope = normal_.Dot(gradient);
    if (std::abs(slope) < tolerance)
      return std::nullopt;
    return point + gradient * ((offset_ - normal_.Dot(point)) / slope);
  }
  PlaneSide Side(const Vector3<T>& point) const
  {
    const T distance = Distance(point);
    return distance < 0 ? NEGATIVE_SIDE : distance > 0 ? POSITIVE_SIDE : NO_SIDE;
  }
  PlaneSide Side(const AxisAlignedBox& box) const
  {
    const double distance = Distance(box.Center()), reach = normal_.AbsDot(box.Size() / 2.0);
    return distance < -reach ? NEGATIVE_SIDE : distance > reach ? POSITIVE_SIDE : BOTH_SIDE;
  }
  const Vector2<T>& Size() const { return size_; }
  Vector2<T>& Size() { return size_; }
  const Vector3<T>& Normal() const { return normal_; }
  Vector3<T>& Normal() { return normal_; }
  T Offset() const { return offset_; }

private:
  Vector3<T> normal_;
  Vector2<T> size_;
  T offset_ = 0;
};

typedef Plane<int> Planei;
typedef Plane<double> Planed;
typedef Plane<float> Planef;

}  // namespace v6
}  // namespace math
}  // namespace ignition
