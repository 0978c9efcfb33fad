// Shapes of links and objects. Immutable and shared: a scene, its copies and its collision geometry hold the same one.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "motion/types.hpp"

namespace octomap
{
class OcTree;
}

namespace motion
{
enum class ShapeType
{
  Box,
  Sphere,
  Cylinder,
  Cone,
  Mesh,
  Plane,
  OcTree
};

class Shape
{
public:
  virtual ~Shape() = default;
  ShapeType type;
  std::string describe() const;

protected:
  explicit Shape(ShapeType type) : type(type) {}
};
using ShapePtr = std::shared_ptr<const Shape>;

struct Box : Shape
{
  explicit Box(const Vector3& size);
  Vector3 size;  // edges, m
};

struct Sphere : Shape
{
  explicit Sphere(double radius);
  double radius;
};

// Along z, centre in the middle.
struct Cylinder : Shape
{
  Cylinder(double radius, double length);
  double radius, length;
};

// Along z, tip at +length / 2, base of `radius` at -length / 2.
struct Cone : Shape
{
  Cone(double radius, double length);
  double radius, length;
};

struct Mesh : Shape
{
  Mesh(std::vector<Vector3> vertices, std::vector<Eigen::Vector3i> triangles);
  std::vector<Vector3> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

// a x + b y + c z + d = 0
struct Plane : Shape
{
  Plane(double a, double b, double c, double d);
  Vector3 normal;  // as given: not of unit length
  double d;
};

struct OcTreeShape : Shape
{
  explicit OcTreeShape(std::shared_ptr<const octomap::OcTree> tree);
  std::shared_ptr<const octomap::OcTree> tree;

  // `data` of an octomap_msgs/Octomap; throws InvalidInput when it is not one.
  static std::shared_ptr<const OcTreeShape> fromMessage(const std::string& data, double resolution, bool binary,
                                                        const std::string& type);
  static std::shared_ptr<const OcTreeShape> fromPoints(const std::vector<Vector3>& points, double resolution,
                                                       const Vector3* origin);
  static std::shared_ptr<const OcTreeShape> load(const std::string& path);
  void save(const std::string& path) const;
  std::string message(bool binary) const;
  double resolution() const;
  std::size_t nodes() const;
};

// Reads STL, DAE, OBJ ... with assimp. As in MoveIt the root node's transform (up axis, unit) is left out, identical
// vertices are merged, `scale` is applied per vertex. Throws InvalidInput.
std::shared_ptr<const Mesh> loadMesh(const std::string& path, const Vector3& scale = Vector3::Ones());

// The shape grown as geometric_shapes grows it: scaled about its origin, then padded. Planes and octrees stay.
ShapePtr grown(const ShapePtr& shape, double scale, double padding);

// Is the point, in the shape's own frame, inside? Meshes must be closed. A plane has its inside where ax+by+cz+d <= 0.
bool contains(const Shape& shape, const Vector3& point);

// Half of the edges of the shape's box, and that box's centre, in the shape's own frame. False for planes: unbounded.
bool localBounds(const Shape& shape, Vector3& centre, Vector3& half);

// A point uniformly inside the shape, in its own frame; `uniform` gives numbers in [0, 1). False if none was found.
bool sampleInside(const Shape& shape, const std::function<double()>& uniform, Vector3& point);
}  // namespace motion
