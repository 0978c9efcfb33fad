#include "collision_shape.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <tuple>

namespace motion
{
namespace
{
std::shared_ptr<fcl::CollisionGeometryd> fclMesh(const Mesh& mesh)
{
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Eigen::Vector3i& t : mesh.triangles)
    triangles.emplace_back(t[0], t[1], t[2]);
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.vertices.size()));
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

std::shared_ptr<fcl::CollisionGeometryd> fclGeometry(const Shape& shape)
{
  switch (shape.type)
  {
    case ShapeType::Box:
      return std::make_shared<fcl::Boxd>(static_cast<const Box&>(shape).size);
    case ShapeType::Sphere:
      return std::make_shared<fcl::Sphered>(static_cast<const Sphere&>(shape).radius);
    case ShapeType::Cylinder: {
      const auto& cylinder = static_cast<const Cylinder&>(shape);
      return std::make_shared<fcl::Cylinderd>(cylinder.radius, cylinder.length);
    }
    case ShapeType::Cone: {
      const auto& cone = static_cast<const Cone&>(shape);
      return std::make_shared<fcl::Coned>(cone.radius, cone.length);
    }
    case ShapeType::Plane: {
      // FCL's planes are n.x = d, ours are n.x + d = 0.
      const auto& plane = static_cast<const Plane&>(shape);
      const double length = plane.normal.norm();
      return std::make_shared<fcl::Planed>(plane.normal / length, -plane.d / length);
    }
    case ShapeType::OcTree:
      return std::make_shared<fcl::OcTreed>(static_cast<const OcTreeShape&>(shape).tree);
    case ShapeType::Mesh:
      return fclMesh(static_cast<const Mesh&>(shape));
  }
  return nullptr;
}

std::shared_ptr<CollisionShape> make(const ShapePtr& shape, double scale, double padding)
{
  auto out = std::make_shared<CollisionShape>();
  out->shape = shape;
  const ShapePtr larger = grown(shape, scale, padding);
  out->geometry = fclGeometry(*larger);
  out->geometry->computeLocalAABB();
  out->unbounded = !localBounds(*larger, out->centre, out->half);
  if (larger->type == ShapeType::Mesh && !static_cast<const Mesh&>(*larger).triangles.empty())
    out->parts = std::make_shared<const MeshParts>(std::static_pointer_cast<const Mesh>(larger));
  return out;
}
}  // namespace

CollisionShapePtr collisionShape(const ShapePtr& shape, double scale, double padding)
{
  using Key = std::tuple<const Shape*, double, double>;
  static std::mutex lock;
  static std::map<Key, std::weak_ptr<const CollisionShape>> cache;
  static std::size_t clean_at = 256;
  const Key key(shape.get(), scale, padding);
  {
    std::lock_guard<std::mutex> guard(lock);
    const auto found = cache.find(key);
    if (found != cache.end())
      if (CollisionShapePtr known = found->second.lock())
        return known;
  }
  const CollisionShapePtr made = make(shape, scale, padding);
  std::lock_guard<std::mutex> guard(lock);
  cache[key] = made;
  if (cache.size() > clean_at)
  {
    for (auto it = cache.begin(); it != cache.end();)
      it = it->second.expired() ? cache.erase(it) : std::next(it);
    clean_at = std::max<std::size_t>(256, 2 * cache.size());
  }
  return made;
}

double gapOfBoxes(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b)
{
  if (a.unbounded || b.unbounded)
    return -std::numeric_limits<double>::infinity();
  const Eigen::Matrix3d turn = at_a.linear().transpose() * at_b.linear(), size = turn.cwiseAbs();  // of b's axes in a's
  const Vector3 off = at_a.linear().transpose() * (at_b * b.centre - at_a * a.centre);
  double gap = gapByFaces(turn, size, off, a.half, b.half, 0);
  if (gap > 0)
    return gap;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
    {
      constexpr double PARALLEL = 1e-6;  // the sine squared below which the two axes are those of above
      const double sine2 = 1 - turn(i, k) * turn(i, k);
      if (sine2 < PARALLEL)
        continue;
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const double between = std::abs(off[i2] * turn(i1, k) - off[i1] * turn(i2, k)) - a.half[i1] * size(i2, k) -
                             a.half[i2] * size(i1, k) - b.half[k1] * size(i, k2) - b.half[k2] * size(i, k1);
      gap = std::max(gap, between / std::sqrt(sine2));
    }
  return gap;
}

void AabbTree::build(const std::vector<Aabb>& boxes)
{
  nodes_.clear();
  if (boxes.empty())
    return;
  nodes_.reserve(2 * boxes.size());
  std::vector<int> items(boxes.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i] = static_cast<int>(i);
  split(items, 0, static_cast<int>(items.size()), boxes);
}

int AabbTree::split(std::vector<int>& items, int first, int last, const std::vector<Aabb>& boxes)
{
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Aabb box = boxes[items[first]];
  for (int i = first + 1; i < last; ++i)
    box.extend(boxes[items[i]]);
  nodes_[index].box = box;
  if (last - first == 1)
  {
    nodes_[index].item = items[first];
    return index;
  }
  int axis;
  (box.high - box.low).maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(items.begin() + first, items.begin() + middle, items.begin() + last, [&](int a, int b) {
    return boxes[a].low[axis] + boxes[a].high[axis] < boxes[b].low[axis] + boxes[b].high[axis];
  });
  const int left = split(items, first, middle, boxes);
  const int right = split(items, middle, last, boxes);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}
}  // namespace motion
