// Lines, paths, cylinders between points, wire frames, lists of spheres.
#include <rviz_visual_tools/rviz_visual_tools.h>

#include <set>

#include "log_name.hpp"

namespace rviz_visual_tools {
namespace {

Eigen::Vector3d position(const Eigen::Isometry3d& pose) { return pose.translation(); }
Eigen::Vector3d position(const geometry_msgs::Point& point) { return RvizVisualTools::convertPoint(point); }
Eigen::Vector3d position(const geometry_msgs::Pose& pose) { return RvizVisualTools::convertPoint(pose.position); }

template <class Path>
EigenSTL::vector_Vector3d positions(const Path& path) {
  EigenSTL::vector_Vector3d points;
  for (const auto& element : path) points.push_back(position(element));
  return points;
}

std::vector<geometry_msgs::Point> messages(const EigenSTL::vector_Vector3d& points) {
  std::vector<geometry_msgs::Point> result;
  for (const Eigen::Vector3d& point : points) result.push_back(RvizVisualTools::convertPoint(point));
  return result;
}

geometry_msgs::Vector3 width(geometry_msgs::Vector3 scale) {
  scale.y = scale.z = 0;
  return scale;
}

bool isPath(std::size_t points) {
  if (points < 2) ROS_WARN_STREAM_NAMED(LOGNAME, "Skipping path because " << points << " points passed in.");
  return points >= 2;
}

bool areAsMany(const char* what, std::size_t a, std::size_t b) {
  if (a != b) ROS_ERROR_STREAM_NAMED(LOGNAME, "Skipping " << what << " because " << a << " different from " << b << ".");
  return a == b;
}

}  // namespace

bool RvizVisualTools::publishLine(const Eigen::Isometry3d& point1, const Eigen::Isometry3d& point2, colors color,
                                  scales scale) {
  return publishLine(convertPoseToPoint(point1), convertPoseToPoint(point2), getColor(color), getScale(scale));
}
bool RvizVisualTools::publishLine(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, colors color, scales scale) {
  return publishLine(convertPoint(point1), convertPoint(point2), getColor(color), getScale(scale));
}
bool RvizVisualTools::publishLine(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, colors color, double radius) {
  return publishLine(convertPoint(point1), convertPoint(point2), getColor(color), cube(radius));
}
bool RvizVisualTools::publishLine(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2,
                                  const std_msgs::ColorRGBA& color, scales scale) {
  return publishLine(convertPoint(point1), convertPoint(point2), color, getScale(scale));
}
bool RvizVisualTools::publishLine(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2,
                                  const std_msgs::ColorRGBA& color, double radius) {
  return publishLine(convertPoint(point1), convertPoint(point2), color, cube(radius));
}
bool RvizVisualTools::publishLine(const geometry_msgs::Point& point1, const geometry_msgs::Point& point2, colors color,
                                  scales scale) {
  return publishLine(point1, point2, getColor(color), getScale(scale));
}
bool RvizVisualTools::publishLine(const geometry_msgs::Point& point1, const geometry_msgs::Point& point2,
                                  const std_msgs::ColorRGBA& color, scales scale) {
  return publishLine(point1, point2, color, getScale(scale));
}
bool RvizVisualTools::publishLine(const geometry_msgs::Point& point1, const geometry_msgs::Point& point2,
                                  const std_msgs::ColorRGBA& color, const geometry_msgs::Vector3& scale) {
  line_strip_marker_.header = header();
  ++line_strip_marker_.id;
  line_strip_marker_.color = color;
  line_strip_marker_.colors.clear();
  line_strip_marker_.scale = width(scale);
  line_strip_marker_.points = {point1, point2};
  return publishMarker(line_strip_marker_);
}

bool RvizVisualTools::publishLines(const EigenSTL::vector_Vector3d& aPoints, const EigenSTL::vector_Vector3d& bPoints,
                                   const std::vector<colors>& colors, scales scale) {
  std::vector<std_msgs::ColorRGBA> painted;
  for (const auto color : colors) painted.push_back(getColor(color));
  return publishLines(messages(aPoints), messages(bPoints), painted, getScale(scale));
}
bool RvizVisualTools::publishLines(const std::vector<geometry_msgs::Point>& aPoints,
                                   const std::vector<geometry_msgs::Point>& bPoints,
                                   const std::vector<std_msgs::ColorRGBA>& colors, const geometry_msgs::Vector3& scale) {
  if (!areAsMany("lines", aPoints.size(), bPoints.size()) || !areAsMany("lines", aPoints.size(), colors.size())) return false;
  line_list_marker_.header = header();
  line_list_marker_.header.stamp = ros::Time();
  ++line_list_marker_.id;
  line_list_marker_.ns = "Line Array";
  line_list_marker_.scale = width(scale);
  line_list_marker_.points.clear();
  line_list_marker_.colors.clear();
  for (std::size_t i = 0; i < aPoints.size(); ++i) {
    line_list_marker_.points.insert(line_list_marker_.points.end(), {aPoints[i], bPoints[i]});
    line_list_marker_.colors.insert(line_list_marker_.colors.end(), 2, colors[i]);
  }
  return publishMarker(line_list_marker_);
}
bool RvizVisualTools::publishLineStrip(const std::vector<geometry_msgs::Point>& path, colors color, scales scale,
                                       const std::string& ns) {
  if (!isPath(path.size())) return true;
  line_strip_marker_.header = header();
  line_strip_marker_.header.stamp = ros::Time();
  ++line_strip_marker_.id;
  line_strip_marker_.ns = ns;
  line_strip_marker_.scale = width(getScale(scale));
  line_strip_marker_.color = getColor(color);
  line_strip_marker_.points = path;
  line_strip_marker_.colors.assign(path.size(), line_strip_marker_.color);
  return publishMarker(line_strip_marker_);
}

bool RvizVisualTools::publishPath(const std::vector<geometry_msgs::Pose>& path, colors color, scales scale,
                                  const std::string& ns) {
  return publishPath(positions(path), color, getScale(scale).x, ns);
}
bool RvizVisualTools::publishPath(const std::vector<geometry_msgs::Point>& path, colors color, scales scale,
                                  const std::string& ns) {
  return publishPath(positions(path), color, getScale(scale).x, ns);
}
bool RvizVisualTools::publishPath(const EigenSTL::vector_Isometry3d& path, colors color, scales scale, const std::string& ns) {
  return publishPath(positions(path), color, getScale(scale).x, ns);
}
bool RvizVisualTools::publishPath(const EigenSTL::vector_Vector3d& path, colors color, scales scale, const std::string& ns) {
  return publishPath(path, color, getScale(scale).x, ns);
}
bool RvizVisualTools::publishPath(const std::vector<geometry_msgs::Point>& path, colors color, double radius,
                                  const std::string& ns) {
  return publishPath(positions(path), color, radius, ns);
}
bool RvizVisualTools::publishPath(const EigenSTL::vector_Isometry3d& path, colors color, double radius, const std::string& ns) {
  return publishPath(positions(path), color, radius, ns);
}
bool RvizVisualTools::publishPath(const EigenSTL::vector_Vector3d& path, colors color, double radius, const std::string& ns) {
  return publishPath(path, std::vector<std_msgs::ColorRGBA>(path.size(), getColor(color)), radius, ns);
}
bool RvizVisualTools::publishPath(const EigenSTL::vector_Vector3d& path, const std::vector<colors>& colors, double radius,
                                  const std::string& ns) {
  std::vector<std_msgs::ColorRGBA> painted;
  for (const auto color : colors) painted.push_back(getColor(color));
  return publishPath(path, painted, radius, ns);
}
bool RvizVisualTools::publishPath(const EigenSTL::vector_Vector3d& path, const std::vector<std_msgs::ColorRGBA>& colors,
                                  double radius, const std::string& ns) {
  if (!isPath(path.size()) || !areAsMany("path", path.size(), colors.size())) return false;
  for (std::size_t i = 1; i < path.size(); ++i) publishCylinder(path[i - 1], path[i], colors[i], radius, ns);
  return true;
}
bool RvizVisualTools::publishPolygon(const geometry_msgs::Polygon& polygon, colors color, scales scale, const std::string& ns) {
  EigenSTL::vector_Vector3d points;
  for (const geometry_msgs::Point32& point : polygon.points) points.push_back(convertPoint32(point));
  if (!points.empty()) points.push_back(Eigen::Vector3d(points.front()));
  return publishPath(points, color, getScale(scale).x, ns);
}

bool RvizVisualTools::publishGraph(const graph_msgs::GeometryGraph& graph, colors color, double radius) {
  std::set<std::pair<std::size_t, std::size_t>> drawn;
  for (std::size_t a = 0; a < graph.nodes.size() && a < graph.edges.size(); ++a)
    for (const std::size_t b : graph.edges[a].node_ids)
      if (b < graph.nodes.size() && drawn.insert({std::min(a, b), std::max(a, b)}).second)
        publishCylinder(convertPoint(graph.nodes[a]), convertPoint(graph.nodes[b]), color, radius);
  return true;
}

bool RvizVisualTools::publishCylinder(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, colors color, scales scale,
                                      const std::string& ns) {
  return publishCylinder(point1, point2, getColor(color), getScale(scale).x, ns);
}
bool RvizVisualTools::publishCylinder(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, colors color, double radius,
                                      const std::string& ns) {
  return publishCylinder(point1, point2, getColor(color), radius, ns);
}
bool RvizVisualTools::publishCylinder(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2,
                                      const std_msgs::ColorRGBA& color, double radius, const std::string& ns) {
  const Eigen::Isometry3d pose =
      getVectorBetweenPoints(getCenterPoint(point1, point2), point2) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY());
  return publishCylinder(convertPose(pose), color, (point1 - point2).norm(), radius, ns);
}
bool RvizVisualTools::publishCylinder(const Eigen::Isometry3d& pose, colors color, double height, double radius,
                                      const std::string& ns) {
  return publishCylinder(convertPose(pose), getColor(color), height, radius, ns);
}
bool RvizVisualTools::publishCylinder(const geometry_msgs::Pose& pose, colors color, double height, double radius,
                                      const std::string& ns) {
  return publishCylinder(pose, getColor(color), height, radius, ns);
}
bool RvizVisualTools::publishCylinder(const geometry_msgs::Pose& pose, const std_msgs::ColorRGBA& color, double height,
                                      double radius, const std::string& ns) {
  cylinder_marker_.header = header();
  ++cylinder_marker_.id;
  cylinder_marker_.ns = ns;
  cylinder_marker_.pose = pose;
  cylinder_marker_.color = color;
  cylinder_marker_.scale.x = cylinder_marker_.scale.y = radius;
  cylinder_marker_.scale.z = height;
  return publishMarker(cylinder_marker_);
}

bool RvizVisualTools::addEdges(const std::vector<Eigen::Vector3d>& corners, const std::vector<std::pair<int, int>>& edges,
                               geometry_msgs::Vector3 scale, colors color, const std::string& ns, std::size_t id) {
  line_list_marker_.header = header();
  line_list_marker_.header.stamp = ros::Time();
  line_list_marker_.id = id == 0 ? line_list_marker_.id + 1 : static_cast<int>(id);
  line_list_marker_.ns = ns;
  line_list_marker_.scale = width(scale);
  line_list_marker_.color = getColor(color);
  line_list_marker_.points.clear();
  for (const auto& [a, b] : edges) {
    line_list_marker_.points.push_back(convertPoint(corners[a]));
    line_list_marker_.points.push_back(convertPoint(corners[b]));
  }
  line_list_marker_.colors.assign(line_list_marker_.points.size(), line_list_marker_.color);
  return publishMarker(line_list_marker_);
}

bool RvizVisualTools::publishWireframeCuboid(const Eigen::Isometry3d& pose, double depth, double width, double height,
                                             colors color, const std::string& ns, std::size_t id) {
  const Eigen::Vector3d half(depth / 2, width / 2, height / 2);
  return publishWireframeCuboid(pose, -half, half, color, ns, id);
}
bool RvizVisualTools::publishWireframeCuboid(const Eigen::Isometry3d& pose, const Eigen::Vector3d& min_point,
                                             const Eigen::Vector3d& max_point, colors color, const std::string& ns,
                                             std::size_t id) {
  // Bits 0, 1, 2 of a corner's number choose max along x, y, z; an edge joins corners that differ in one bit.
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::pair<int, int>> edges;
  for (int corner = 0; corner < 8; ++corner) {
    corners.push_back(pose * Eigen::Vector3d((corner & 1 ? max_point : min_point).x(), (corner & 2 ? max_point : min_point).y(),
                                             (corner & 4 ? max_point : min_point).z()));
    for (const int bit : {1, 2, 4})
      if (!(corner & bit)) edges.emplace_back(corner, corner | bit);
  }
  return addEdges(corners, edges, getScale(XXSMALL), color, ns, id);
}
bool RvizVisualTools::publishWireframeRectangle(const Eigen::Isometry3d& pose, double height, double width, colors color,
                                                scales scale, std::size_t id) {
  const double x = width / 2, y = height / 2;
  return addEdges({pose * Eigen::Vector3d(-x, -y, 0), pose * Eigen::Vector3d(-x, y, 0), pose * Eigen::Vector3d(x, y, 0),
                   pose * Eigen::Vector3d(x, -y, 0)},
                  {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, getScale(scale, 0.25), color, "Wireframe Rectangle", id);
}
bool RvizVisualTools::publishWireframeRectangle(const Eigen::Isometry3d& pose, const Eigen::Vector3d& p1_in,
                                                const Eigen::Vector3d& p2_in, const Eigen::Vector3d& p3_in,
                                                const Eigen::Vector3d& p4_in, colors color, scales scale) {
  return addEdges({pose * p1_in, pose * p2_in, pose * p3_in, pose * p4_in}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                  getScale(scale, 0.25), color, "Wireframe Rectangle", 0);
}

bool RvizVisualTools::publishSpheres(const EigenSTL::vector_Vector3d& points, colors color, scales scale,
                                     const std::string& ns) {
  return publishSpheres(messages(points), color, getScale(scale), ns);
}
bool RvizVisualTools::publishSpheres(const EigenSTL::vector_Vector3d& points, colors color, double scale,
                                     const std::string& ns) {
  return publishSpheres(messages(points), color, cube(scale), ns);
}
bool RvizVisualTools::publishSpheres(const std::vector<geometry_msgs::Point>& points, colors color, scales scale,
                                     const std::string& ns) {
  return publishSpheres(points, color, getScale(scale), ns);
}
bool RvizVisualTools::publishSpheres(const std::vector<geometry_msgs::Point>& points, colors color, double scale,
                                     const std::string& ns) {
  return publishSpheres(points, color, cube(scale), ns);
}
bool RvizVisualTools::publishSpheres(const std::vector<geometry_msgs::Point>& points, colors color,
                                     const geometry_msgs::Vector3& scale, const std::string& ns) {
  return publishSpheres(points, std::vector<std_msgs::ColorRGBA>(points.size(), getColor(color)), scale, ns);
}
bool RvizVisualTools::publishSpheres(const EigenSTL::vector_Vector3d& points, const std::vector<colors>& colors, scales scale,
                                     const std::string& ns) {
  std::vector<std_msgs::ColorRGBA> painted;
  for (const auto color : colors) painted.push_back(getColor(color));
  return publishSpheres(messages(points), painted, getScale(scale), ns);
}
bool RvizVisualTools::publishSpheres(const std::vector<geometry_msgs::Point>& points,
                                     const std::vector<std_msgs::ColorRGBA>& colors, const geometry_msgs::Vector3& scale,
                                     const std::string& ns) {
  if (!areAsMany("spheres", points.size(), colors.size())) return false;
  spheres_marker_.header = header();
  spheres_marker_.header.stamp = ros::Time();
  ++spheres_marker_.id;
  spheres_marker_.ns = ns;
  spheres_marker_.scale = scale;
  if (!colors.empty()) spheres_marker_.color = colors.front();
  spheres_marker_.points = points;
  spheres_marker_.colors = colors;
  return publishMarker(spheres_marker_);
}

}  // namespace rviz_visual_tools
