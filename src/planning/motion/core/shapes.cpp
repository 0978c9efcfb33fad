#include "motion/shapes.hpp"

#include <octomap/octomap.h>

#include <limits>

namespace motion
{
namespace
{
void demandSize(double value, const char* shape, const char* what)
{
  if (!(std::isfinite(value) && value >= 0))
    throw InvalidInput(std::string(shape) + ": " + what + " is " + std::to_string(value) + ", but must be a number from 0 up");
}

const char* typeName(ShapeType type)
{
  static const char* names[] = {"box", "sphere", "cylinder", "cone", "mesh", "plane", "octree"};
  return names[static_cast<int>(type)];
}

double padded(double value, const Shape& shape)
{
  if (!(value >= 0))
    throw InvalidInput(std::string("padding makes the size of a ") + typeName(shape.type) + " negative");
  return value;
}
}  // namespace

std::string Shape::describe() const { return typeName(type); }

Box::Box(const Vector3& s) : Shape(ShapeType::Box), size(s)
{
  for (int i = 0; i < 3; ++i)
    demandSize(size[i], "box", "an edge");
}

Sphere::Sphere(double r) : Shape(ShapeType::Sphere), radius(r) { demandSize(radius, "sphere", "the radius"); }

Cylinder::Cylinder(double r, double l) : Shape(ShapeType::Cylinder), radius(r), length(l)
{
  demandSize(radius, "cylinder", "the radius");
  demandSize(length, "cylinder", "the length");
}

Cone::Cone(double r, double l) : Shape(ShapeType::Cone), radius(r), length(l)
{
  demandSize(radius, "cone", "the radius");
  demandSize(length, "cone", "the length");
}

Mesh::Mesh(std::vector<Vector3> v, std::vector<Eigen::Vector3i> t)
  : Shape(ShapeType::Mesh)
  , vertices(std::move(v))
  , triangles(std::move(t))
{
  if (vertices.empty() || triangles.empty())
    throw InvalidInput("mesh: it has " + std::to_string(vertices.size()) + " vertices and " + std::to_string(triangles.size()) +
                       " triangles; at least one triangle is needed");
  for (const Vector3& vertex : vertices)
    if (!vertex.allFinite())
      throw InvalidInput("mesh: a vertex is not finite");
  for (const Eigen::Vector3i& triangle : triangles)
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= static_cast<int>(vertices.size()))
      throw InvalidInput("mesh: a triangle names vertex " + std::to_string(triangle.maxCoeff()) + " of " +
                         std::to_string(vertices.size()));
}

Plane::Plane(double a, double b, double c, double dd) : Shape(ShapeType::Plane), normal(a, b, c), d(dd)
{
  if (!normal.allFinite() || !std::isfinite(d) || normal.norm() < 1e-12)
    throw InvalidInput("plane: the coefficients a, b, c must be finite and not all zero");
}

OcTreeShape::OcTreeShape(std::shared_ptr<const octomap::OcTree> t) : Shape(ShapeType::OcTree), tree(std::move(t)) {}

// ---------------------------------------------------------------- grown

namespace
{
ShapePtr grownMesh(const Mesh& mesh, double scale, double padding)
{
  Vector3 centre = Vector3::Zero();
  for (const Vector3& vertex : mesh.vertices)
    centre += vertex;
  centre /= static_cast<double>(mesh.vertices.size());
  std::vector<Vector3> vertices = mesh.vertices;
  for (Vector3& vertex : vertices)
  {
    const Vector3 ray = vertex - centre;
    const double length = ray.norm();
    // A vertex in the centre has no direction: it is only scaled, that is left where it is.
    const double factor = length > 1e-6 ? scale + padding / length : scale;
    vertex = centre + ray * factor;
  }
  return std::make_shared<Mesh>(std::move(vertices), mesh.triangles);
}
}  // namespace

ShapePtr grown(const ShapePtr& shape, double scale, double padding)
{
  if (scale == 1.0 && padding == 0.0)
    return shape;
  if (!std::isfinite(scale) || !std::isfinite(padding))
    throw InvalidInput("scale and padding must be finite numbers");
  switch (shape->type)
  {
    case ShapeType::Box: {
      const Vector3 size = static_cast<const Box&>(*shape).size * scale + Vector3::Constant(2 * padding);
      padded(size.minCoeff(), *shape);
      return std::make_shared<Box>(size);
    }
    case ShapeType::Sphere:
      return std::make_shared<Sphere>(padded(static_cast<const Sphere&>(*shape).radius * scale + padding, *shape));
    case ShapeType::Cylinder: {
      const auto& cylinder = static_cast<const Cylinder&>(*shape);
      return std::make_shared<Cylinder>(padded(cylinder.radius * scale + padding, *shape),
                                        padded(cylinder.length * scale + 2 * padding, *shape));
    }
    case ShapeType::Cone: {
      const auto& cone = static_cast<const Cone&>(*shape);
      return std::make_shared<Cone>(padded(cone.radius * scale + padding, *shape),
                                    padded(cone.length * scale + 2 * padding, *shape));
    }
    case ShapeType::Mesh:
      return grownMesh(static_cast<const Mesh&>(*shape), scale, padding);
    default:
      return shape;
  }
}

// ---------------------------------------------------------------- inside

namespace
{
// Parity of crossings of a ray with an odd direction, so that it hardly ever meets an edge.
bool insideMesh(const Mesh& mesh, const Vector3& point)
{
  const Vector3 direction = Vector3(0.8215, 0.4373, 0.3657).normalized();
  int crossings = 0;
  for (const Eigen::Vector3i& t : mesh.triangles)
  {
    const Vector3 e1 = mesh.vertices[t[1]] - mesh.vertices[t[0]], e2 = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const Vector3 p = direction.cross(e2);
    const double det = e1.dot(p);
    if (std::abs(det) < 1e-14)
      continue;
    const Vector3 s = point - mesh.vertices[t[0]];
    const double u = s.dot(p) / det;
    const Vector3 q = s.cross(e1);
    const double v = direction.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && e2.dot(q) / det > 0)
      ++crossings;
  }
  return crossings % 2;
}
}  // namespace

bool contains(const Shape& shape, const Vector3& p)
{
  switch (shape.type)
  {
    case ShapeType::Box:
      return (p.cwiseAbs() - 0.5 * static_cast<const Box&>(shape).size).maxCoeff() <= 0;
    case ShapeType::Sphere:
      return p.norm() <= static_cast<const Sphere&>(shape).radius;
    case ShapeType::Cylinder: {
      const auto& cylinder = static_cast<const Cylinder&>(shape);
      return std::abs(p.z()) <= 0.5 * cylinder.length && p.head<2>().norm() <= cylinder.radius;
    }
    case ShapeType::Cone: {
      const auto& cone = static_cast<const Cone&>(shape);
      return std::abs(p.z()) <= 0.5 * cone.length &&
             p.head<2>().norm() * cone.length <= cone.radius * (0.5 * cone.length - p.z());
    }
    case ShapeType::Mesh:
      return insideMesh(static_cast<const Mesh&>(shape), p);
    case ShapeType::Plane:
      return static_cast<const Plane&>(shape).normal.dot(p) + static_cast<const Plane&>(shape).d <= 0;
    case ShapeType::OcTree: {
      const auto& tree = *static_cast<const OcTreeShape&>(shape).tree;
      const auto* node = tree.search(p.x(), p.y(), p.z());
      return node && tree.isNodeOccupied(node);
    }
  }
  return false;
}

bool localBounds(const Shape& shape, Vector3& centre, Vector3& half)
{
  centre.setZero();
  switch (shape.type)
  {
    case ShapeType::Box:
      half = 0.5 * static_cast<const Box&>(shape).size;
      return true;
    case ShapeType::Sphere:
      half.setConstant(static_cast<const Sphere&>(shape).radius);
      return true;
    case ShapeType::Cylinder: {
      const auto& cylinder = static_cast<const Cylinder&>(shape);
      half = Vector3(cylinder.radius, cylinder.radius, 0.5 * cylinder.length);
      return true;
    }
    case ShapeType::Cone: {
      const auto& cone = static_cast<const Cone&>(shape);
      half = Vector3(cone.radius, cone.radius, 0.5 * cone.length);
      return true;
    }
    case ShapeType::Mesh: {
      Vector3 low = Vector3::Constant(std::numeric_limits<double>::max()), high = -low;
      for (const Vector3& vertex : static_cast<const Mesh&>(shape).vertices)
      {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
      }
      centre = 0.5 * (low + high);
      half = 0.5 * (high - low);
      return true;
    }
    case ShapeType::OcTree: {
      const auto& tree = *static_cast<const OcTreeShape&>(shape).tree;
      double lx = 0, ly = 0, lz = 0, hx = 0, hy = 0, hz = 0;
      tree.getMetricMin(lx, ly, lz);
      tree.getMetricMax(hx, hy, hz);
      centre = 0.5 * Vector3(lx + hx, ly + hy, lz + hz);
      half = 0.5 * Vector3(hx - lx, hy - ly, hz - lz);
      return true;
    }
    case ShapeType::Plane:
      break;
  }
  return false;
}

bool sampleInside(const Shape& shape, const std::function<double()>& uniform, Vector3& point)
{
  Vector3 centre, half;
  if (!localBounds(shape, centre, half))
    return false;
  for (int attempt = 0; attempt < 100; ++attempt)
  {
    const double x = uniform(), y = uniform(), z = uniform();
    point = centre + half.cwiseProduct(2.0 * Vector3(x, y, z) - Vector3::Ones());
    if (contains(shape, point))
      return true;
  }
  return false;
}
}  // namespace motion
