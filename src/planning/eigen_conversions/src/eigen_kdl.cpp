#include <eigen_conversions/eigen_kdl.h>

namespace tf {
namespace {

using Row = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;  // KDL keeps a rotation row by row

Eigen::Vector3d vector(const KDL::Vector& k) { return {k.x(), k.y(), k.z()}; }

KDL::Vector vector(const Eigen::Vector3d& e) { return {e.x(), e.y(), e.z()}; }

template <class Transform>
void fill(const KDL::Frame& k, Transform& e) {
  e.setIdentity();
  e.linear() = Eigen::Map<const Row>(k.M.data);
  e.translation() = vector(k.p);
}

template <class Transform>
void fill(const Transform& e, KDL::Frame& k) {
  Eigen::Map<Row>(k.M.data) = e.linear();
  k.p = vector(Eigen::Vector3d(e.translation()));
}

}  // namespace

void quaternionKDLToEigen(const KDL::Rotation& k, Eigen::Quaterniond& e) { k.GetQuaternion(e.x(), e.y(), e.z(), e.w()); }

void quaternionEigenToKDL(const Eigen::Quaterniond& e, KDL::Rotation& k) {
  k = KDL::Rotation::Quaternion(e.x(), e.y(), e.z(), e.w());
}

void transformKDLToEigen(const KDL::Frame& k, Eigen::Affine3d& e) { fill(k, e); }
void transformKDLToEigen(const KDL::Frame& k, Eigen::Isometry3d& e) { fill(k, e); }
void transformEigenToKDL(const Eigen::Affine3d& e, KDL::Frame& k) { fill(e, k); }
void transformEigenToKDL(const Eigen::Isometry3d& e, KDL::Frame& k) { fill(e, k); }

void twistKDLToEigen(const KDL::Twist& k, Eigen::Matrix<double, 6, 1>& e) { e << vector(k.vel), vector(k.rot); }

void twistEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Twist& k) {
  k = {vector(Eigen::Vector3d(e.head<3>())), vector(Eigen::Vector3d(e.tail<3>()))};
}

void wrenchKDLToEigen(const KDL::Wrench& k, Eigen::Matrix<double, 6, 1>& e) { e << vector(k.force), vector(k.torque); }

void wrenchEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Wrench& k) {
  k = {vector(Eigen::Vector3d(e.head<3>())), vector(Eigen::Vector3d(e.tail<3>()))};
}

void vectorKDLToEigen(const KDL::Vector& k, Eigen::Matrix<double, 3, 1>& e) { e = vector(k); }
void vectorEigenToKDL(const Eigen::Matrix<double, 3, 1>& e, KDL::Vector& k) { k = vector(e); }

}  // namespace tf
