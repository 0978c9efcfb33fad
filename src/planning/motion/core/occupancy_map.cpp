#include "motion/occupancy_map.hpp"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "collision_shape.hpp"

namespace motion
{
namespace
{
octomap::point3d toOctomap(const Vector3& p)
{
  return octomap::point3d(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
}

octomap::KeySet keysOf(const octomap::OcTree& tree, const std::vector<Vector3>& points)
{
  octomap::KeySet keys;
  octomap::OcTreeKey key;
  for (const Vector3& p : points)
    if (p.allFinite() && tree.coordToKeyChecked(toOctomap(p), key))
      keys.insert(key);
  return keys;
}

// A shape that points are compared with, in its own frame.
class Region
{
public:
  Region(const PlacedShape& placed, double scale, double shadow)
    : shape_(grown(placed.shape, scale, placed.padding))
    , inverse_(placed.pose.inverse())
  {
    const auto& [shape, pose, padding] = placed;
    Vector3 centre, half;
    if (!localBounds(*shape_, centre, half))
      return;
    const Vector3 middle = pose * centre, reach = pose.linear().cwiseAbs() * half;
    const Vector3 more = Vector3::Constant(shadow + std::max(padding, 0.0));
    box_ = {middle - reach - more, middle + reach + more};
    if (shape->type == ShapeType::Mesh && padding > 0)
    {
      // A mesh grows away from its middle, not from its surface, and need not be closed: its surface is tested as well.
      surface_ = collisionShape(shape, scale, 0.0);
      ball_ = std::make_shared<fcl::Sphered>(padding);
    }
    bounded_ = true;
  }

  bool near(const Vector3& p) const
  {
    return bounded_ && (box_.low.array() <= p.array()).all() && (p.array() <= box_.high.array()).all();
  }

  bool inside(const Vector3& p) const
  {
    const Vector3 local = inverse_ * p;
    if (contains(*shape_, local))
      return true;
    if (!surface_)
      return false;
    fcl::Transform3d place = fcl::Transform3d::Identity();
    place.translation() = local;
    fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    return fcl::collide(ball_.get(), place, surface_->geometry.get(), fcl::Transform3d::Identity(), request, result) > 0;
  }

private:
  ShapePtr shape_;
  Transform inverse_;
  Aabb box_;
  bool bounded_ = false;
  CollisionShapePtr surface_;
  std::shared_ptr<fcl::Sphered> ball_;
};
}  // namespace

// An octree cannot give up single cells without trouble (octomap asserts when a node loses its last child), a table can.
struct OccupancyMap::Cells : std::unordered_map<octomap::OcTreeKey, float, octomap::OcTreeKey::KeyHash>
{
};

OccupancyMap::OccupancyMap(double resolution) : cells_(std::make_shared<Cells>())
{
  if (!std::isfinite(resolution) || resolution < 1e-3)
    throw InvalidInput("octomap: the resolution is " + std::to_string(resolution) + " m, but must be 0.001 or more");
  grid_ = std::make_shared<octomap::OcTree>(resolution);
}

void OccupancyMap::insert(const Vector3& origin, const std::vector<Vector3>& occupied, const std::vector<Vector3>& known,
                          const std::vector<Vector3>& beyond)
{
  if (!origin.allFinite())
    throw InvalidInput("octomap: the place of the sensor is not finite");
  octomap::KeySet seen = keysOf(*grid_, occupied);
  const octomap::KeySet mine = keysOf(*grid_, known), past = keysOf(*grid_, beyond);
  octomap::KeySet free;
  octomap::KeyRay ray;
  for (const octomap::KeySet* ends : {static_cast<const octomap::KeySet*>(&seen), &mine, &past})
    for (const octomap::OcTreeKey& end : *ends)
      if (!cells_->empty() && grid_->computeRayKeys(toOctomap(origin), grid_->keyToCoord(end), ray))
        for (const octomap::OcTreeKey& key : ray)
          if (cells_->count(key))
            free.insert(key);
  for (const octomap::OcTreeKey& key : mine)
  {
    seen.erase(key);
    cells_->erase(key);
  }
  for (const octomap::OcTreeKey& key : free)
  {
    const auto cell = seen.count(key) ? cells_->end() : cells_->find(key);
    if (cell != cells_->end() && (cell->second += grid_->getProbMissLog()) < grid_->getOccupancyThresLog())
      cells_->erase(cell);
  }
  for (const octomap::OcTreeKey& key : seen)
  {
    float& value = (*cells_)[key];
    value = std::min(value + grid_->getProbHitLog(), grid_->getClampingThresMaxLog());
  }
}

void OccupancyMap::clear() { cells_->clear(); }

void OccupancyMap::assign(const OcTreeShape& other)
{
  octomap::OcTree whole(*other.tree);
  whole.expand();
  grid_ = std::make_shared<octomap::OcTree>(whole.getResolution());
  cells_->clear();
  for (auto leaf = whole.begin_leafs(); leaf != whole.end_leafs(); ++leaf)
    if (whole.isNodeOccupied(*leaf))
      (*cells_)[leaf.getKey()] = leaf->getLogOdds();
}

std::shared_ptr<const OcTreeShape> OccupancyMap::shape() const
{
  auto tree = std::make_shared<octomap::OcTree>(grid_->getResolution());
  for (const auto& [key, value] : *cells_)
    tree->setNodeValue(key, value, true);
  tree->updateInnerOccupancy();
  double unused;
  tree->getMetricMin(unused, unused, unused);  // computed lazily otherwise, by several threads at once
  return std::make_shared<OcTreeShape>(std::move(tree));
}

double OccupancyMap::resolution() const { return grid_->getResolution(); }

std::size_t OccupancyMap::cells() const { return cells_->size(); }

std::vector<std::uint8_t> labelPoints(const std::vector<PlacedShape>& shapes, const std::vector<Vector3>& points,
                                      const Vector3& origin, double scale, double shadow)
{
  std::vector<Region> regions;
  for (const PlacedShape& placed : shapes)
    if (placed.shape->type != ShapeType::Plane && placed.shape->type != ShapeType::OcTree)
      regions.emplace_back(placed, scale, shadow);
  constexpr int STEPS = 4;  // places between a point and the end of a shadow that is cast on it
  std::vector<std::uint8_t> labels(points.size(), Unknown);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vector3& p = points[i];
    if (!p.allFinite())
      continue;
    const Vector3 back = shadow > 0 ? Vector3((origin - p).normalized() * (shadow / STEPS)) : Vector3::Zero();
    for (const Region& region : regions)
    {
      if (!region.near(p))
        continue;
      if (region.inside(p))
      {
        labels[i] = Inside;
        break;
      }
      for (int k = 1; shadow > 0 && labels[i] == Unknown && k <= STEPS; ++k)
        if (region.inside(p + k * back))
          labels[i] = Shadow;
    }
  }
  return labels;
}
}  // namespace motion
