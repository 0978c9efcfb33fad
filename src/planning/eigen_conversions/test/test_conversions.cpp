#include <eigen_conversions/eigen_kdl.h>
#include <eigen_conversions/eigen_msg.h>
#include <gtest/gtest.h>

namespace {

const Eigen::Quaterniond ROTATION(Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, -2, 3).normalized()));
const Eigen::Isometry3d POSE = Eigen::Translation3d(1, 2, 3) * ROTATION;

TEST(Messages, PosesAndTransformsComeBack) {
  geometry_msgs::Pose pose;
  tf::poseEigenToMsg(POSE, pose);
  EXPECT_EQ(pose.position.y, 2);
  EXPECT_NEAR(pose.orientation.w, std::cos(1.25), 1e-12);
  Eigen::Affine3d affine;
  tf::poseMsgToEigen(pose, affine);
  EXPECT_TRUE(affine.matrix().isApprox(POSE.matrix(), 1e-12));
  geometry_msgs::Transform transform;
  tf::transformEigenToMsg(affine, transform);
  Eigen::Isometry3d isometry;
  tf::transformMsgToEigen(transform, isometry);
  EXPECT_TRUE(isometry.matrix().isApprox(POSE.matrix(), 1e-12));
}

TEST(Messages, TwistsAndWrenchesAreLinearFirst) {
  Eigen::Matrix<double, 6, 1> six;
  six << 1, 2, 3, 4, 5, 6;
  geometry_msgs::Twist twist;
  tf::twistEigenToMsg(six, twist);
  EXPECT_EQ(twist.linear.x, 1);
  EXPECT_EQ(twist.angular.z, 6);
  geometry_msgs::Wrench wrench;
  tf::wrenchEigenToMsg(six, wrench);
  EXPECT_EQ(wrench.force.y, 2);
  EXPECT_EQ(wrench.torque.x, 4);
  Eigen::Matrix<double, 6, 1> back;
  tf::twistMsgToEigen(twist, back);
  EXPECT_EQ(back, six);
  tf::wrenchMsgToEigen(wrench, back);
  EXPECT_EQ(back, six);
}

TEST(Messages, MatricesGoRowByRow) {
  Eigen::MatrixXd matrix(2, 3);
  matrix << 1, 2, 3, 4, 5, 6;
  std_msgs::Float64MultiArray array;
  tf::matrixEigenToMsg(matrix, array);
  EXPECT_EQ(array.data, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(array.layout.dim[0].size, 2u);
  EXPECT_EQ(array.layout.dim[0].stride, 6u);
  EXPECT_EQ(array.layout.dim[1].stride, 3u);
}

TEST(Kdl, FramesComeBack) {
  KDL::Frame frame;
  tf::transformEigenToKDL(POSE, frame);
  const KDL::Vector moved = frame * KDL::Vector(1, 0, 0);
  const Eigen::Vector3d expected = POSE * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(moved.z(), expected.z(), 1e-12);
  Eigen::Affine3d affine;
  tf::transformKDLToEigen(frame, affine);
  EXPECT_TRUE(affine.matrix().isApprox(POSE.matrix(), 1e-12));
  Eigen::Quaterniond quaternion;
  tf::quaternionKDLToEigen(frame.M, quaternion);
  EXPECT_NEAR(std::abs(quaternion.dot(ROTATION)), 1, 1e-12);
  KDL::Rotation rotation;
  tf::quaternionEigenToKDL(ROTATION, rotation);
  EXPECT_TRUE(KDL::Equal(rotation, frame.M, 1e-12));
  Eigen::Matrix<double, 6, 1> six, back;
  six << 1, 2, 3, 4, 5, 6;
  KDL::Twist twist;
  tf::twistEigenToKDL(six, twist);
  tf::twistKDLToEigen(twist, back);
  EXPECT_EQ(back, six);
  EXPECT_EQ(twist.rot.x(), 4);
  KDL::Wrench wrench;
  tf::wrenchEigenToKDL(six, wrench);
  EXPECT_EQ(wrench.torque.z(), 6);
}

}  // namespace
