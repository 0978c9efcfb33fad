#include "support_surfaces.hpp"

#include <geometric_shapes/mesh_operations.h>

#include <algorithm>
#include <limits>

namespace moveit_rviz_plugin {
namespace {
constexpr double LEVEL = 0.002;      // m, how uneven a top may be
constexpr double LEAST_AREA = 1e-4;  // m2 of a top that something can stand on
constexpr double LEAST_SHARE = 0.5;  // of what an object covers: a ball and a lying can have no top
constexpr double CLOSE = 0.02;       // m, how far above a surface an object still stands on it
constexpr double SPACING = 0.1;      // m between two places
constexpr double THICKNESS = 0.01;   // m of a detected table
constexpr double ROUNDING = 1e-6;    // m

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double areaOf(const std::vector<Eigen::Vector2d>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  return 0.5 * twice;
}
}  // namespace

// ---------------------------------------------------------------- outlines

double Surface::area() const { return areaOf(outline); }

Eigen::Vector2d Surface::centre() const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const Eigen::Vector2d origin = outline.front();  // near it nothing is lost to rounding
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d a = outline[i] - origin, b = outline[(i + 1) % outline.size()] - origin;
    sum += cross(a, b) * (a + b);
  }
  return origin + sum / (6.0 * area());
}

double Surface::inside(const Eigen::Vector2d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    least = std::min(least, cross(edge, point - outline[i]) / edge.norm());
  }
  return least;
}

// Andrew's monotone chain.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Eigen::Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Eigen::Vector2d& point : points) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= ROUNDING * ROUNDING)
        hull.pop_back();
      hull.push_back(point);
    }
    if (!hull.empty()) hull.pop_back();  // the other side begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// ---------------------------------------------------------------- objects

std::vector<Eigen::Vector3d> cornersOf(const std::vector<shapes::ShapeConstPtr>& shapes,
                                       const EigenSTL::vector_Isometry3d& poses) {
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t i = 0; i < shapes.size() && i < poses.size(); ++i) {
    const shapes::Shape& shape = *shapes[i];
    if (shape.type == shapes::PLANE || shape.type == shapes::OCTREE || shape.type == shapes::UNKNOWN_SHAPE) continue;
    std::unique_ptr<shapes::Mesh> made;
    const auto* mesh = dynamic_cast<const shapes::Mesh*>(&shape);
    if (!mesh) {
      made.reset(shapes::createMeshFromShape(&shape));
      mesh = made.get();
    }
    for (unsigned int v = 0; mesh && v < mesh->vertex_count; ++v)
      corners.push_back(poses[i] * Eigen::Map<const Eigen::Vector3d>(mesh->vertices + 3 * v));
  }
  return corners;
}

Bounds boundsOf(const std::vector<Eigen::Vector3d>& corners) {
  Bounds bounds;
  if (corners.empty()) return bounds;
  bounds.low = bounds.high = corners.front();
  for (const Eigen::Vector3d& corner : corners) {
    bounds.low = bounds.low.cwiseMin(corner);
    bounds.high = bounds.high.cwiseMax(corner);
  }
  return bounds;
}

std::vector<Surface> surfacesOf(const collision_detection::World& world) {
  std::vector<Surface> surfaces;
  for (const auto& item : world) {
    const std::vector<Eigen::Vector3d> corners = cornersOf(item.second->shapes_, item.second->global_shape_poses_);
    if (corners.empty()) continue;
    Surface surface;
    surface.id = item.first;
    surface.height = boundsOf(corners).high.z();
    std::vector<Eigen::Vector2d> all, top;
    for (const Eigen::Vector3d& corner : corners) {
      all.emplace_back(corner.x(), corner.y());
      if (corner.z() > surface.height - LEVEL) top.emplace_back(corner.x(), corner.y());
    }
    surface.outline = convexHull(top);
    const double covered = areaOf(convexHull(all));
    if (surface.area() > std::max(LEAST_AREA, LEAST_SHARE * covered)) surfaces.push_back(surface);
  }
  std::stable_sort(surfaces.begin(), surfaces.end(), [](const Surface& a, const Surface& b) { return a.area() > b.area(); });
  return surfaces;
}

std::string surfaceBelow(const std::vector<Surface>& surfaces, const collision_detection::World::Object& object) {
  const Bounds bounds = boundsOf(cornersOf(object.shapes_, object.global_shape_poses_));
  const Eigen::Vector2d middle = 0.5 * (bounds.low + bounds.high).head<2>();
  std::string best;
  double nearest = CLOSE;
  for (const Surface& surface : surfaces) {
    const double gap = std::abs(bounds.low.z() - surface.height);
    if (surface.id == object.id_ || gap > nearest || surface.inside(middle) < 0.0) continue;
    best = surface.id;
    nearest = gap;
  }
  return best;
}

// ---------------------------------------------------------------- places

std::vector<Eigen::Vector3d> placesOn(const Surface& surface, const Bounds& object, const Eigen::Vector3d& from) {
  // The middle of the object is what is spread, its own frame may be elsewhere.
  const Eigen::Vector2d middle = 0.5 * (object.low + object.high).head<2>();
  const double margin = 0.5 * (object.high - object.low).head<2>().maxCoeff();
  const double height = surface.height - object.low.z();
  const Eigen::Vector2d centre = surface.centre();
  std::vector<Eigen::Vector3d> places;
  const auto add = [&](const Eigen::Vector2d& point) {
    places.emplace_back(point.x() - middle.x(), point.y() - middle.y(), height);
  };
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : surface.outline) reach = reach.cwiseMax((corner - centre).cwiseAbs());
  const int across = static_cast<int>(reach.x() / SPACING), along = static_cast<int>(reach.y() / SPACING);
  for (int i = -across; i <= across; ++i)
    for (int j = -along; j <= along; ++j) {
      const Eigen::Vector2d point = centre + SPACING * Eigen::Vector2d(i, j);
      if (surface.inside(point) >= margin - ROUNDING) add(point);
    }
  if (places.empty()) add(centre);
  std::stable_sort(places.begin(), places.end(), [&from](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - from).squaredNorm() < (b - from).squaredNorm();
  });
  return places;
}

shapes::ShapeConstPtr boardOf(const object_recognition_msgs::Table& table) {
  std::vector<Eigen::Vector2d> points;
  double height = 0.0;
  for (const geometry_msgs::Point& point : table.convex_hull) {
    points.emplace_back(point.x, point.y);
    height += point.z / static_cast<double>(table.convex_hull.size());
  }
  const std::vector<Eigen::Vector2d> outline = convexHull(points);
  const auto count = static_cast<unsigned int>(outline.size());
  if (count < 3) return nullptr;
  EigenSTL::vector_Vector3d corners;
  for (const double z : {height, height - THICKNESS})
    for (const Eigen::Vector2d& point : outline) corners.emplace_back(point.x(), point.y(), z);
  std::vector<unsigned int> triangles;
  for (unsigned int i = 1; i + 1 < count; ++i)
    triangles.insert(triangles.end(), {0, i, i + 1, count, count + i + 1, count + i});
  for (unsigned int i = 0; i < count; ++i) {
    const unsigned int next = (i + 1) % count;
    triangles.insert(triangles.end(), {i, count + i, next, next, count + i, count + next});
  }
  return shapes::ShapeConstPtr(shapes::createMeshFromVertices(corners, triangles));
}

}  // namespace moveit_rviz_plugin
