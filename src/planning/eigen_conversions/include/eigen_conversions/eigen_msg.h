// Between Eigen's types and those of geometry_msgs. Each function overwrites its second argument. Quaternions are taken as
// they are: nothing is normalised.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <std_msgs/Float64MultiArray.h>

namespace tf {

void pointMsgToEigen(const geometry_msgs::Point& m, Eigen::Vector3d& e);
void pointEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Point& m);

void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Affine3d& e);
void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Isometry3d& e);
void poseEigenToMsg(const Eigen::Affine3d& e, geometry_msgs::Pose& m);
void poseEigenToMsg(const Eigen::Isometry3d& e, geometry_msgs::Pose& m);

void quaternionMsgToEigen(const geometry_msgs::Quaternion& m, Eigen::Quaterniond& e);
void quaternionEigenToMsg(const Eigen::Quaterniond& e, geometry_msgs::Quaternion& m);

void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Affine3d& e);
void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Isometry3d& e);
void transformEigenToMsg(const Eigen::Affine3d& e, geometry_msgs::Transform& m);
void transformEigenToMsg(const Eigen::Isometry3d& e, geometry_msgs::Transform& m);

// Linear part first, then angular; force first, then torque.
void twistMsgToEigen(const geometry_msgs::Twist& m, Eigen::Matrix<double, 6, 1>& e);
void twistEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Twist& m);
void wrenchMsgToEigen(const geometry_msgs::Wrench& m, Eigen::Matrix<double, 6, 1>& e);
void wrenchEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Wrench& m);

void vectorMsgToEigen(const geometry_msgs::Vector3& m, Eigen::Vector3d& e);
void vectorEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Vector3& m);

/// The matrix row by row, with rows and columns as the two dimensions of the layout.
template <class Derived>
void matrixEigenToMsg(const Eigen::MatrixBase<Derived>& e, std_msgs::Float64MultiArray& m) {
  m.layout.dim.resize(2);
  m.layout.dim[0].size = e.rows();
  m.layout.dim[0].stride = e.size();
  m.layout.dim[1].size = m.layout.dim[1].stride = e.cols();
  m.data.clear();
  m.data.reserve(e.size());
  for (Eigen::Index row = 0; row < e.rows(); ++row)
    for (Eigen::Index column = 0; column < e.cols(); ++column) m.data.push_back(e.coeff(row, column));
}

}  // namespace tf
