// Between Eigen's types and messages; random poses; printing.
#include <rviz_visual_tools/rviz_visual_tools.h>

#include <iostream>

#include <tf2_eigen/tf2_eigen.h>

namespace rviz_visual_tools {

geometry_msgs::Pose RvizVisualTools::convertPose(const Eigen::Isometry3d& pose) { return tf2::toMsg(pose); }

void RvizVisualTools::convertPoseSafe(const Eigen::Isometry3d& pose, geometry_msgs::Pose& pose_msg) {
  pose_msg = tf2::toMsg(pose);
}

Eigen::Isometry3d RvizVisualTools::convertPose(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d result;
  tf2::fromMsg(pose, result);
  return result;
}

void RvizVisualTools::convertPoseSafe(const geometry_msgs::Pose& pose_msg, Eigen::Isometry3d& pose) {
  tf2::fromMsg(pose_msg, pose);
}

Eigen::Isometry3d RvizVisualTools::convertPoint32ToPose(const geometry_msgs::Point32& point) {
  return convertPointToPose(convertPoint32(point));
}

geometry_msgs::Pose RvizVisualTools::convertPointToPose(const geometry_msgs::Point& point) {
  geometry_msgs::Pose pose = getIdentityPose();
  pose.position = point;
  return pose;
}

Eigen::Isometry3d RvizVisualTools::convertPointToPose(const Eigen::Vector3d& point) {
  return Eigen::Isometry3d(Eigen::Translation3d(point));
}

geometry_msgs::Point RvizVisualTools::convertPoseToPoint(const Eigen::Isometry3d& pose) {
  return convertPoint(Eigen::Vector3d(pose.translation()));
}

Eigen::Vector3d RvizVisualTools::convertPoint(const geometry_msgs::Point& point) { return {point.x, point.y, point.z}; }

Eigen::Vector3d RvizVisualTools::convertPoint32(const geometry_msgs::Point32& point) { return {point.x, point.y, point.z}; }

geometry_msgs::Point32 RvizVisualTools::convertPoint32(const Eigen::Vector3d& point) {
  geometry_msgs::Point32 result;
  result.x = point.x();
  result.y = point.y();
  result.z = point.z();
  return result;
}

geometry_msgs::Point RvizVisualTools::convertPoint(const geometry_msgs::Vector3& point) {
  return convertPoint(Eigen::Vector3d(point.x, point.y, point.z));
}

geometry_msgs::Point RvizVisualTools::convertPoint(const Eigen::Vector3d& point) {
  geometry_msgs::Point result;
  result.x = point.x();
  result.y = point.y();
  result.z = point.z();
  return result;
}

Eigen::Isometry3d RvizVisualTools::convertFromXYZRPY(double tx, double ty, double tz, double rx, double ry, double rz,
                                                     EulerConvention convention) {
  const Eigen::AngleAxisd x(rx, Eigen::Vector3d::UnitX()), y(ry, Eigen::Vector3d::UnitY()), z(rz, Eigen::Vector3d::UnitZ());
  const Eigen::Quaterniond rotation = convention == ZYX ? z * y * x : convention == ZXZ ? z * x * z : x * y * z;
  return Eigen::Translation3d(tx, ty, tz) * rotation;
}

Eigen::Isometry3d RvizVisualTools::convertFromXYZRPY(const std::vector<double>& transform6, EulerConvention convention) {
  if (transform6.size() != 6)
    throw std::invalid_argument("convertFromXYZRPY wants x, y, z, roll, pitch, yaw and got " +
                                std::to_string(transform6.size()) + " numbers");
  return convertFromXYZRPY(transform6[0], transform6[1], transform6[2], transform6[3], transform6[4], transform6[5],
                           convention);
}

void RvizVisualTools::convertToXYZRPY(const Eigen::Isometry3d& pose, std::vector<double>& xyzrpy) {
  xyzrpy.resize(6);
  convertToXYZRPY(pose, xyzrpy[0], xyzrpy[1], xyzrpy[2], xyzrpy[3], xyzrpy[4], xyzrpy[5]);
}

void RvizVisualTools::convertToXYZRPY(const Eigen::Isometry3d& pose, double& x, double& y, double& z, double& roll,
                                      double& pitch, double& yaw) {
  const Eigen::Vector3d angles = pose.linear().eulerAngles(0, 1, 2);
  x = pose.translation().x();
  y = pose.translation().y();
  z = pose.translation().z();
  roll = angles[0];
  pitch = angles[1];
  yaw = angles[2];
}

Eigen::Vector3d RvizVisualTools::getCenterPoint(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  return (a + b) / 2;
}

Eigen::Isometry3d RvizVisualTools::getVectorBetweenPoints(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  const Eigen::Vector3d direction = b - a;
  return Eigen::Translation3d(a) *
         Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(),
                                            direction.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : direction);
}

void RvizVisualTools::generateRandomPose(geometry_msgs::Pose& pose, RandomPoseBounds pose_bounds) {
  Eigen::Isometry3d generated;
  generateRandomPose(generated, pose_bounds);
  pose = convertPose(generated);
}

void RvizVisualTools::generateRandomPose(Eigen::Isometry3d& pose, RandomPoseBounds bounds) {
  const auto within = [](double min, double max, double least, double most) {
    return dRand(std::max(min, least), std::min(max, most));
  };
  const double elevation = within(bounds.elevation_min_, bounds.elevation_max_, 0, M_PI),
               azimuth = within(bounds.azimuth_min_, bounds.azimuth_max_, 0, 2 * M_PI);
  const Eigen::Vector3d axis(std::sin(elevation) * std::cos(azimuth), std::sin(elevation) * std::sin(azimuth),
                             std::cos(elevation));
  const double angle = dRand(bounds.angle_min_, bounds.angle_max_);
  pose = Eigen::Translation3d(dRand(bounds.x_min_, bounds.x_max_), dRand(bounds.y_min_, bounds.y_max_),
                              dRand(bounds.z_min_, bounds.z_max_)) *
         Eigen::AngleAxisd(angle, axis);
}

void RvizVisualTools::generateRandomCuboid(geometry_msgs::Pose& cuboid_pose, double& depth, double& width, double& height,
                                           RandomPoseBounds pose_bounds, RandomCuboidBounds cuboid_bounds) {
  for (double* edge : {&depth, &width, &height}) *edge = fRand(cuboid_bounds.cuboid_size_min_, cuboid_bounds.cuboid_size_max_);
  generateRandomPose(cuboid_pose, pose_bounds);
}

geometry_msgs::Pose RvizVisualTools::getIdentityPose() {
  geometry_msgs::Pose pose;
  pose.orientation.w = 1;
  return pose;
}

bool RvizVisualTools::posesEqual(const Eigen::Isometry3d& pose1, const Eigen::Isometry3d& pose2, double threshold) {
  return (pose1.matrix() - pose2.matrix()).cwiseAbs().maxCoeff() <= threshold;
}

double RvizVisualTools::dRand(double min, double max) { return min + rand() / static_cast<double>(RAND_MAX) * (max - min); }
float RvizVisualTools::fRand(float min, float max) { return dRand(min, max); }
int RvizVisualTools::iRand(int min, int max) { return min + rand() % (max - min + 1); }

void RvizVisualTools::printTranslation(const Eigen::Vector3d& p) {
  std::cout << "T.xyz = [" << p.x() << ", " << p.y() << ", " << p.z() << "]" << std::endl;
}

void RvizVisualTools::printTransform(const Eigen::Isometry3d& transform) {
  const Eigen::Vector3d p = transform.translation();
  const Eigen::Quaterniond q(transform.linear());
  std::cout << "T.xyz = [" << p.x() << ", " << p.y() << ", " << p.z() << "], Q.xyzw = [" << q.x() << ", " << q.y() << ", "
            << q.z() << ", " << q.w() << "]" << std::endl;
}

void RvizVisualTools::printTransformRPY(const Eigen::Isometry3d& transform) {
  double x, y, z, roll, pitch, yaw;
  convertToXYZRPY(transform, x, y, z, roll, pitch, yaw);
  std::cout << "transform: [" << x << ", " << y << ", " << z << ", " << roll << ", " << pitch << ", " << yaw << "]\n";
}

void RvizVisualTools::printTransformFull(const Eigen::Isometry3d& transform) {
  const Eigen::Vector3d p = transform.translation();
  std::cout << "T.xyz = [" << p.x() << ", " << p.y() << ", " << p.z() << "], R = \n" << transform.linear() << "\n";
}

}  // namespace rviz_visual_tools
