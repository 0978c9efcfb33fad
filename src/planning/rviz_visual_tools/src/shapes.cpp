// Solid shapes, axes and text.
#include <rviz_visual_tools/rviz_visual_tools.h>

namespace rviz_visual_tools {
namespace {

void number(visualization_msgs::Marker& marker, std::size_t id) { marker.id = id == 0 ? marker.id + 1 : static_cast<int>(id); }

double visible(double length) { return length > 0 ? length : SMALL_SCALE; }

Eigen::Isometry3d turned(const Eigen::Isometry3d& pose, double angle, const Eigen::Vector3d& axis) {
  return pose * Eigen::AngleAxisd(angle, axis);
}

geometry_msgs::PoseStamped turned(geometry_msgs::PoseStamped pose, double angle, const Eigen::Vector3d& axis) {
  pose.pose = RvizVisualTools::convertPose(turned(RvizVisualTools::convertPose(pose.pose), angle, axis));
  return pose;
}

}  // namespace

bool RvizVisualTools::addTriangles(const geometry_msgs::Pose& pose, std::vector<geometry_msgs::Point> points,
                                   const std::string& ns, colors color, double scale, std::size_t id) {
  triangle_marker_.header = header();
  number(triangle_marker_, id);
  triangle_marker_.ns = ns;
  triangle_marker_.pose = pose;
  triangle_marker_.points.swap(points);
  triangle_marker_.color = getColor(color);
  triangle_marker_.scale.x = triangle_marker_.scale.y = triangle_marker_.scale.z = scale;
  return publishMarker(triangle_marker_);
}

bool RvizVisualTools::publishCone(const Eigen::Isometry3d& pose, double angle, colors color, double scale) {
  return publishCone(convertPose(pose), angle, color, scale);
}

bool RvizVisualTools::publishCone(const geometry_msgs::Pose& pose, double angle, colors color, double scale) {
  const int sides = 32;
  const auto rim = [&](int side) {
    const double theta = 2 * M_PI * side / sides;
    return convertPoint(Eigen::Vector3d(scale, scale * std::cos(theta) / angle, scale * std::sin(theta) / angle));
  };
  std::vector<geometry_msgs::Point> points;
  for (int side = 0; side < sides; ++side) {
    points.emplace_back();
    points.push_back(rim(side));
    points.push_back(rim(side + 1));
  }
  return addTriangles(pose, std::move(points), "Triangle", color, 1, 0);
}

bool RvizVisualTools::publishABCDPlane(const double A, const double B, const double C, const double D, colors color,
                                       double x_width, double y_width) {
  const Eigen::Vector3d normal(A, B, C);
  const Eigen::Isometry3d pose = Eigen::Translation3d(-D / normal.squaredNorm() * normal) *
                                 Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
  return publishCuboid(pose, x_width, y_width, SMALL_SCALE, color);
}

bool RvizVisualTools::addPlane(const geometry_msgs::Pose& pose, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                               colors color, double scale) {
  const geometry_msgs::Point a = convertPoint(Eigen::Vector3d(scale * (u + v))),
                             b = convertPoint(Eigen::Vector3d(scale * (v - u))),
                             c = convertPoint(Eigen::Vector3d(-scale * (u + v))),
                             d = convertPoint(Eigen::Vector3d(scale * (u - v)));
  return addTriangles(pose, {a, b, c, c, d, a}, "Triangle", color, 1, 0);
}

bool RvizVisualTools::publishXYPlane(const Eigen::Isometry3d& pose, colors color, double scale) {
  return publishXYPlane(convertPose(pose), color, scale);
}
bool RvizVisualTools::publishXYPlane(const geometry_msgs::Pose& pose, colors color, double scale) {
  return addPlane(pose, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), color, scale);
}
bool RvizVisualTools::publishXZPlane(const Eigen::Isometry3d& pose, colors color, double scale) {
  return publishXZPlane(convertPose(pose), color, scale);
}
bool RvizVisualTools::publishXZPlane(const geometry_msgs::Pose& pose, colors color, double scale) {
  return addPlane(pose, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), color, scale);
}
bool RvizVisualTools::publishYZPlane(const Eigen::Isometry3d& pose, colors color, double scale) {
  return publishYZPlane(convertPose(pose), color, scale);
}
bool RvizVisualTools::publishYZPlane(const geometry_msgs::Pose& pose, colors color, double scale) {
  return addPlane(pose, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), color, scale);
}

bool RvizVisualTools::addSphere(const std_msgs::Header& header, const geometry_msgs::Pose& pose,
                                const std_msgs::ColorRGBA& color, const geometry_msgs::Vector3& scale, const std::string& ns,
                                std::size_t id) {
  sphere_marker_.header = header;
  number(sphere_marker_, id);
  sphere_marker_.ns = ns;
  sphere_marker_.pose = pose;
  sphere_marker_.color = color;
  sphere_marker_.scale = scale;
  return publishMarker(sphere_marker_);
}

bool RvizVisualTools::publishSphere(const Eigen::Isometry3d& pose, colors color, scales scale, const std::string& ns,
                                    std::size_t id) {
  return addSphere(header(), convertPose(pose), getColor(color), getScale(scale), ns, id);
}
bool RvizVisualTools::publishSphere(const Eigen::Vector3d& point, colors color, scales scale, const std::string& ns,
                                    std::size_t id) {
  return addSphere(header(), convertPointToPose(convertPoint(point)), getColor(color), getScale(scale), ns, id);
}
bool RvizVisualTools::publishSphere(const Eigen::Vector3d& point, colors color, double scale, const std::string& ns,
                                    std::size_t id) {
  return addSphere(header(), convertPointToPose(convertPoint(point)), getColor(color), cube(scale), ns, id);
}
bool RvizVisualTools::publishSphere(const geometry_msgs::Point& point, colors color, scales scale, const std::string& ns,
                                    std::size_t id) {
  return addSphere(header(), convertPointToPose(point), getColor(color), getScale(scale), ns, id);
}
bool RvizVisualTools::publishSphere(const geometry_msgs::Pose& pose, colors color, scales scale, const std::string& ns,
                                    std::size_t id) {
  return addSphere(header(), pose, getColor(color), getScale(scale), ns, id);
}
bool RvizVisualTools::publishSphere(const geometry_msgs::Pose& pose, colors color, double scale, const std::string& ns,
                                    std::size_t id) {
  return addSphere(header(), pose, getColor(color), cube(scale), ns, id);
}
bool RvizVisualTools::publishSphere(const geometry_msgs::Pose& pose, colors color, const geometry_msgs::Vector3 scale,
                                    const std::string& ns, std::size_t id) {
  return addSphere(header(), pose, getColor(color), scale, ns, id);
}
bool RvizVisualTools::publishSphere(const geometry_msgs::Pose& pose, const std_msgs::ColorRGBA& color,
                                    const geometry_msgs::Vector3 scale, const std::string& ns, std::size_t id) {
  return addSphere(header(), pose, color, scale, ns, id);
}
bool RvizVisualTools::publishSphere(const Eigen::Isometry3d& pose, const std_msgs::ColorRGBA& color,
                                    const geometry_msgs::Vector3 scale, const std::string& ns, std::size_t id) {
  return addSphere(header(), convertPose(pose), color, scale, ns, id);
}
bool RvizVisualTools::publishSphere(const Eigen::Vector3d& point, const std_msgs::ColorRGBA& color,
                                    const geometry_msgs::Vector3 scale, const std::string& ns, std::size_t id) {
  return addSphere(header(), convertPointToPose(convertPoint(point)), color, scale, ns, id);
}
bool RvizVisualTools::publishSphere(const geometry_msgs::PoseStamped& pose, colors color, const geometry_msgs::Vector3 scale,
                                    const std::string& ns, std::size_t id) {
  return addSphere(pose.header, pose.pose, getColor(color), scale, ns, id);
}

bool RvizVisualTools::addArrow(const std_msgs::Header& header, const geometry_msgs::Pose& pose, colors color, scales scale,
                               double length, std::size_t id) {
  arrow_marker_.header = header;
  number(arrow_marker_, id);
  arrow_marker_.points.clear();
  arrow_marker_.pose = pose;
  arrow_marker_.color = getColor(color);
  arrow_marker_.scale = getScale(scale);
  arrow_marker_.scale.x = length == 0 ? 10 * arrow_marker_.scale.x : length;
  return publishMarker(arrow_marker_);
}

bool RvizVisualTools::publishArrow(const Eigen::Isometry3d& pose, colors color, scales scale, double length, std::size_t id) {
  return addArrow(header(), convertPose(pose), color, scale, length, id);
}
bool RvizVisualTools::publishArrow(const geometry_msgs::Pose& pose, colors color, scales scale, double length, std::size_t id) {
  return addArrow(header(), pose, color, scale, length, id);
}
bool RvizVisualTools::publishArrow(const geometry_msgs::PoseStamped& pose, colors color, scales scale, double length,
                                   std::size_t id) {
  return addArrow(pose.header, pose.pose, color, scale, length, id);
}
bool RvizVisualTools::publishArrow(const geometry_msgs::Point& start, const geometry_msgs::Point& end, colors color,
                                   scales scale, std::size_t id) {
  arrow_marker_.header = header();
  number(arrow_marker_, id);
  arrow_marker_.pose = getIdentityPose();
  arrow_marker_.points = {start, end};
  arrow_marker_.color = getColor(color);
  arrow_marker_.scale = getScale(scale);
  arrow_marker_.scale.y *= 2;
  arrow_marker_.scale.z *= 3;
  return publishMarker(arrow_marker_);
}

bool RvizVisualTools::publishXArrow(const Eigen::Isometry3d& pose, colors color, scales scale, double length) {
  return publishArrow(pose, color, scale, length);
}
bool RvizVisualTools::publishXArrow(const geometry_msgs::Pose& pose, colors color, scales scale, double length) {
  return publishArrow(pose, color, scale, length);
}
bool RvizVisualTools::publishXArrow(const geometry_msgs::PoseStamped& pose, colors color, scales scale, double length) {
  return publishArrow(pose, color, scale, length);
}
bool RvizVisualTools::publishYArrow(const Eigen::Isometry3d& pose, colors color, scales scale, double length) {
  return publishArrow(turned(pose, M_PI / 2, Eigen::Vector3d::UnitZ()), color, scale, length);
}
bool RvizVisualTools::publishYArrow(const geometry_msgs::Pose& pose, colors color, scales scale, double length) {
  return publishYArrow(convertPose(pose), color, scale, length);
}
bool RvizVisualTools::publishYArrow(const geometry_msgs::PoseStamped& pose, colors color, scales scale, double length) {
  return publishArrow(turned(pose, M_PI / 2, Eigen::Vector3d::UnitZ()), color, scale, length);
}
bool RvizVisualTools::publishZArrow(const Eigen::Isometry3d& pose, colors color, scales scale, double length, std::size_t id) {
  return publishArrow(turned(pose, -M_PI / 2, Eigen::Vector3d::UnitY()), color, scale, length, id);
}
bool RvizVisualTools::publishZArrow(const geometry_msgs::Pose& pose, colors color, scales scale, double length) {
  return publishZArrow(convertPose(pose), color, scale, length);
}
bool RvizVisualTools::publishZArrow(const geometry_msgs::PoseStamped& pose, colors color, scales scale, double length) {
  return publishZArrow(pose, color, scale, length, 0);
}
bool RvizVisualTools::publishZArrow(const geometry_msgs::PoseStamped& pose, colors color, scales scale, double length,
                                    std::size_t id) {
  return publishArrow(turned(pose, -M_PI / 2, Eigen::Vector3d::UnitY()), color, scale, length, id);
}

bool RvizVisualTools::publishCuboid(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, colors color) {
  return publishCuboid(convertPoint(point1), convertPoint(point2), color);
}
bool RvizVisualTools::publishCuboid(const geometry_msgs::Point& point1, const geometry_msgs::Point& point2, colors color,
                                    const std::string& ns, std::size_t id) {
  const Eigen::Vector3d a = convertPoint(point1), b = convertPoint(point2), size = (a - b).cwiseAbs();
  cuboid_marker_.header = header();
  number(cuboid_marker_, id);
  cuboid_marker_.ns = ns;
  cuboid_marker_.color = getColor(color);
  cuboid_marker_.pose = convertPointToPose(convertPoint(getCenterPoint(a, b)));
  cuboid_marker_.scale.x = visible(size.x());
  cuboid_marker_.scale.y = visible(size.y());
  cuboid_marker_.scale.z = visible(size.z());
  return publishMarker(cuboid_marker_);
}
bool RvizVisualTools::publishCuboid(const geometry_msgs::Pose& pose, double depth, double width, double height, colors color) {
  cuboid_marker_.header = header();
  number(cuboid_marker_, 0);
  cuboid_marker_.color = getColor(color);
  cuboid_marker_.pose = pose;
  cuboid_marker_.scale.x = visible(depth);
  cuboid_marker_.scale.y = visible(width);
  cuboid_marker_.scale.z = visible(height);
  return publishMarker(cuboid_marker_);
}
bool RvizVisualTools::publishCuboid(const Eigen::Isometry3d& pose, double depth, double width, double height, colors color) {
  return publishCuboid(convertPose(pose), depth, width, height, color);
}
bool RvizVisualTools::publishCuboid(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size, colors color) {
  return publishCuboid(convertPose(pose), size.x(), size.y(), size.z(), color);
}
bool RvizVisualTools::publishCuboid(const geometry_msgs::Pose& pose, const geometry_msgs::Vector3& size, colors color) {
  return publishCuboid(pose, size.x, size.y, size.z, color);
}

bool RvizVisualTools::publishAxisLabeled(const Eigen::Isometry3d& pose, const std::string& label, scales scale, colors color) {
  return publishAxisLabeled(convertPose(pose), label, scale, color);
}
bool RvizVisualTools::publishAxisLabeled(const geometry_msgs::Pose& pose, const std::string& label, scales scale,
                                         colors color) {
  geometry_msgs::Pose beside = pose;
  beside.position.x -= 0.05;
  beside.position.y -= 0.05;
  beside.position.z -= 0.05;
  const scales larger = scale < XXXXLARGE ? static_cast<scales>(scale + 1) : scale;
  return publishAxis(pose, scale, label) && publishText(beside, label, color, larger, false);
}

bool RvizVisualTools::publishAxis(const geometry_msgs::Pose& pose, scales scale, const std::string& ns) {
  return publishAxis(convertPose(pose), scale, ns);
}
bool RvizVisualTools::publishAxis(const Eigen::Isometry3d& pose, scales scale, const std::string& ns) {
  const double radius = getScale(scale).x;
  return publishAxis(pose, 10 * radius, radius, ns);
}
bool RvizVisualTools::publishAxis(const geometry_msgs::Pose& pose, double length, double radius, const std::string& ns) {
  return publishAxis(convertPose(pose), length, radius, ns);
}
bool RvizVisualTools::publishAxis(const Eigen::Isometry3d& pose, double length, double radius, const std::string& ns) {
  const auto bar = [&](const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& about, colors color) {
    const Eigen::Isometry3d middle = pose * Eigen::Translation3d(length / 2 * axis) * Eigen::AngleAxisd(angle, about);
    return publishCylinder(middle, color, length, radius, ns);
  };
  return bar(Eigen::Vector3d::UnitX(), M_PI / 2, Eigen::Vector3d::UnitY(), RED) &&
         bar(Eigen::Vector3d::UnitY(), M_PI / 2, Eigen::Vector3d::UnitX(), GREEN) &&
         bar(Eigen::Vector3d::UnitZ(), 0, Eigen::Vector3d::UnitZ(), BLUE);
}
bool RvizVisualTools::publishAxisPath(const EigenSTL::vector_Isometry3d& path, scales scale, const std::string& ns) {
  for (const Eigen::Isometry3d& pose : path) publishAxis(pose, scale, ns);
  return true;
}
bool RvizVisualTools::publishAxisPath(const EigenSTL::vector_Isometry3d& path, double length, double radius,
                                      const std::string& ns) {
  for (const Eigen::Isometry3d& pose : path) publishAxis(pose, length, radius, ns);
  return true;
}

bool RvizVisualTools::publishMesh(const Eigen::Isometry3d& pose, const std::string& file_name, colors color, double scale,
                                  const std::string& ns, std::size_t id) {
  return publishMesh(convertPose(pose), file_name, color, scale, ns, id);
}
bool RvizVisualTools::publishMesh(const geometry_msgs::Pose& pose, const std::string& file_name, colors color, double scale,
                                  const std::string& ns, std::size_t id) {
  mesh_marker_.header = header();
  number(mesh_marker_, id);
  mesh_marker_.ns = ns;
  mesh_marker_.mesh_resource = file_name;
  mesh_marker_.mesh_use_embedded_materials = true;
  mesh_marker_.pose = pose;
  mesh_marker_.color = getColor(color);
  mesh_marker_.scale.x = mesh_marker_.scale.y = mesh_marker_.scale.z = scale;
  return publishMarker(mesh_marker_);
}
bool RvizVisualTools::publishMesh(const Eigen::Isometry3d& pose, const shape_msgs::Mesh& mesh, colors color, double scale,
                                  const std::string& ns, std::size_t id) {
  return publishMesh(convertPose(pose), mesh, color, scale, ns, id);
}
bool RvizVisualTools::publishMesh(const geometry_msgs::Pose& pose, const shape_msgs::Mesh& mesh, colors color, double scale,
                                  const std::string& ns, std::size_t id) {
  std::vector<geometry_msgs::Point> points;
  for (const shape_msgs::MeshTriangle& triangle : mesh.triangles)
    for (const auto index : triangle.vertex_indices) points.push_back(mesh.vertices.at(index));
  return addTriangles(pose, std::move(points), ns, color, scale, id);
}

bool RvizVisualTools::publishText(const Eigen::Isometry3d& pose, const std::string& text, colors color, scales scale,
                                  bool static_id) {
  return publishText(convertPose(pose), text, color, getScale(scale), static_id);
}
bool RvizVisualTools::publishText(const Eigen::Isometry3d& pose, const std::string& text, colors color,
                                  const geometry_msgs::Vector3 scale, bool static_id) {
  return publishText(convertPose(pose), text, color, scale, static_id);
}
bool RvizVisualTools::publishText(const geometry_msgs::Pose& pose, const std::string& text, colors color, scales scale,
                                  bool static_id) {
  return publishText(pose, text, color, getScale(scale), static_id);
}
bool RvizVisualTools::publishText(const geometry_msgs::Pose& pose, const std::string& text, colors color,
                                  const geometry_msgs::Vector3 scale, bool static_id) {
  const int last = text_marker_.id;
  text_marker_.header = header();
  text_marker_.id = static_id ? 0 : last + 1;
  text_marker_.text = text;
  text_marker_.pose = pose;
  text_marker_.color = getColor(color);
  text_marker_.scale = scale;
  text_marker_.scale.x = text_marker_.scale.y = 0;
  const bool added = publishMarker(text_marker_);
  if (static_id) text_marker_.id = last;
  return added;
}

}  // namespace rviz_visual_tools
