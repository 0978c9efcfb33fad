#include "shapes.hpp"

#include <geometric_shapes/mesh_operations.h>

namespace moveit
{
namespace core
{
namespace
{
shapes::ShapeConstPtr toMesh(const motion::Mesh& from)
{
  auto mesh = std::make_shared<shapes::Mesh>(from.vertices.size(), from.triangles.size());
  for (std::size_t i = 0; i < from.vertices.size(); ++i)
    for (int k = 0; k < 3; ++k)
      mesh->vertices[3 * i + k] = from.vertices[i][k];
  for (std::size_t i = 0; i < from.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      mesh->triangles[3 * i + k] = from.triangles[i][k];
  mesh->computeTriangleNormals();
  mesh->computeVertexNormals();
  return mesh;
}

motion::ShapePtr fromMesh(const shapes::Mesh& from)
{
  std::vector<motion::Vector3> vertices(from.vertex_count);
  std::vector<Eigen::Vector3i> triangles(from.triangle_count);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = Eigen::Map<const Eigen::Vector3d>(from.vertices + 3 * i);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    triangles[i] = Eigen::Map<const Eigen::Matrix<unsigned int, 3, 1>>(from.triangles + 3 * i).cast<int>();
  return std::make_shared<motion::Mesh>(std::move(vertices), std::move(triangles));
}
}  // namespace

shapes::ShapeConstPtr toShape(const motion::ShapePtr& shape)
{
  switch (shape->type)
  {
    case motion::ShapeType::Box: {
      const motion::Vector3& size = static_cast<const motion::Box&>(*shape).size;
      return std::make_shared<shapes::Box>(size.x(), size.y(), size.z());
    }
    case motion::ShapeType::Sphere:
      return std::make_shared<shapes::Sphere>(static_cast<const motion::Sphere&>(*shape).radius);
    case motion::ShapeType::Cylinder: {
      const auto& c = static_cast<const motion::Cylinder&>(*shape);
      return std::make_shared<shapes::Cylinder>(c.radius, c.length);
    }
    case motion::ShapeType::Cone: {
      const auto& c = static_cast<const motion::Cone&>(*shape);
      return std::make_shared<shapes::Cone>(c.radius, c.length);
    }
    case motion::ShapeType::Plane: {
      const auto& p = static_cast<const motion::Plane&>(*shape);
      return std::make_shared<shapes::Plane>(p.normal.x(), p.normal.y(), p.normal.z(), p.d);
    }
    case motion::ShapeType::OcTree:
      return std::make_shared<shapes::OcTree>(static_cast<const motion::OcTreeShape&>(*shape).tree);
    case motion::ShapeType::Mesh:
      return toMesh(static_cast<const motion::Mesh&>(*shape));
  }
  return nullptr;
}

motion::ShapePtr fromShape(const shapes::ShapeConstPtr& shape)
{
  switch (shape->type)
  {
    case shapes::BOX: {
      const double* size = static_cast<const shapes::Box&>(*shape).size;
      return std::make_shared<motion::Box>(motion::Vector3(size[0], size[1], size[2]));
    }
    case shapes::SPHERE:
      return std::make_shared<motion::Sphere>(static_cast<const shapes::Sphere&>(*shape).radius);
    case shapes::CYLINDER: {
      const auto& c = static_cast<const shapes::Cylinder&>(*shape);
      return std::make_shared<motion::Cylinder>(c.radius, c.length);
    }
    case shapes::CONE: {
      const auto& c = static_cast<const shapes::Cone&>(*shape);
      return std::make_shared<motion::Cone>(c.radius, c.length);
    }
    case shapes::PLANE: {
      const auto& p = static_cast<const shapes::Plane&>(*shape);
      return std::make_shared<motion::Plane>(p.a, p.b, p.c, p.d);
    }
    case shapes::OCTREE:
      return std::make_shared<motion::OcTreeShape>(static_cast<const shapes::OcTree&>(*shape).octree);
    case shapes::MESH:
      return fromMesh(static_cast<const shapes::Mesh&>(*shape));
    default:
      throw motion::InvalidInput("a shape of unknown type");
  }
}
}  // namespace core
}  // namespace moveit
