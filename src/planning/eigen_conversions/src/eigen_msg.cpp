#include <eigen_conversions/eigen_msg.h>

namespace tf {
namespace {

// geometry_msgs/Point and geometry_msgs/Vector3 differ in name alone.
template <class Triple>
Eigen::Vector3d vector(const Triple& m) {
  return {m.x, m.y, m.z};
}

template <class Triple, class Vector>
void fill(const Vector& e, Triple& m) {
  m.x = e[0];
  m.y = e[1];
  m.z = e[2];
}

template <class Triple, class Transform>
void compose(const Triple& p, const geometry_msgs::Quaternion& q, Transform& e) {
  e = Eigen::Translation3d(vector(p)) * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
}

template <class Triple, class Transform>
void decompose(const Transform& e, Triple& p, geometry_msgs::Quaternion& q) {
  fill(e.translation(), p);
  Eigen::Quaterniond rotation(e.linear());
  // One of the two quaternions of a rotation: the one that upstream sends.
  if (rotation.w() < 0) rotation.coeffs() *= -1;
  quaternionEigenToMsg(rotation, q);
}

}  // namespace

void pointMsgToEigen(const geometry_msgs::Point& m, Eigen::Vector3d& e) { e = vector(m); }
void pointEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Point& m) { fill(e, m); }
void vectorMsgToEigen(const geometry_msgs::Vector3& m, Eigen::Vector3d& e) { e = vector(m); }
void vectorEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Vector3& m) { fill(e, m); }

void quaternionMsgToEigen(const geometry_msgs::Quaternion& m, Eigen::Quaterniond& e) {
  e = Eigen::Quaterniond(m.w, m.x, m.y, m.z);
}

void quaternionEigenToMsg(const Eigen::Quaterniond& e, geometry_msgs::Quaternion& m) {
  fill(e.vec(), m);
  m.w = e.w();
}

void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Affine3d& e) { compose(m.position, m.orientation, e); }
void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Isometry3d& e) { compose(m.position, m.orientation, e); }
void poseEigenToMsg(const Eigen::Affine3d& e, geometry_msgs::Pose& m) { decompose(e, m.position, m.orientation); }
void poseEigenToMsg(const Eigen::Isometry3d& e, geometry_msgs::Pose& m) { decompose(e, m.position, m.orientation); }

void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Affine3d& e) { compose(m.translation, m.rotation, e); }
void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Isometry3d& e) { compose(m.translation, m.rotation, e); }
void transformEigenToMsg(const Eigen::Affine3d& e, geometry_msgs::Transform& m) { decompose(e, m.translation, m.rotation); }
void transformEigenToMsg(const Eigen::Isometry3d& e, geometry_msgs::Transform& m) { decompose(e, m.translation, m.rotation); }

void twistMsgToEigen(const geometry_msgs::Twist& m, Eigen::Matrix<double, 6, 1>& e) {
  e << vector(m.linear), vector(m.angular);
}

void twistEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Twist& m) {
  fill(e.head<3>(), m.linear);
  fill(e.tail<3>(), m.angular);
}

void wrenchMsgToEigen(const geometry_msgs::Wrench& m, Eigen::Matrix<double, 6, 1>& e) {
  e << vector(m.force), vector(m.torque);
}

void wrenchEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Wrench& m) {
  fill(e.head<3>(), m.force);
  fill(e.tail<3>(), m.torque);
}

}  // namespace tf
