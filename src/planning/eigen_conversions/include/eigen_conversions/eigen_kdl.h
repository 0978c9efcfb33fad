// Between Eigen's types and those of KDL. Each function overwrites its second argument.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <kdl/frames.hpp>

namespace tf {

void quaternionKDLToEigen(const KDL::Rotation& k, Eigen::Quaterniond& e);
void quaternionEigenToKDL(const Eigen::Quaterniond& e, KDL::Rotation& k);

void transformKDLToEigen(const KDL::Frame& k, Eigen::Affine3d& e);
void transformKDLToEigen(const KDL::Frame& k, Eigen::Isometry3d& e);
void transformEigenToKDL(const Eigen::Affine3d& e, KDL::Frame& k);
void transformEigenToKDL(const Eigen::Isometry3d& e, KDL::Frame& k);

// Linear part first, then angular; force first, then torque.
void twistKDLToEigen(const KDL::Twist& k, Eigen::Matrix<double, 6, 1>& e);
void twistEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Twist& k);
void wrenchKDLToEigen(const KDL::Wrench& k, Eigen::Matrix<double, 6, 1>& e);
void wrenchEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Wrench& k);

void vectorKDLToEigen(const KDL::Vector& k, Eigen::Matrix<double, 3, 1>& e);
void vectorEigenToKDL(const Eigen::Matrix<double, 3, 1>& e, KDL::Vector& k);

}  // namespace tf
