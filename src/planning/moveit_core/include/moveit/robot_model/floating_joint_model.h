#pragma once

#include <moveit/robot_model/joint_model.h>

namespace moveit
{
namespace core
{
// trans_x, trans_y, trans_z (m), rot_x, rot_y, rot_z, rot_w (a quaternion).
class FloatingJointModel : public JointModel
{
public:
  double getAngularDistanceWeight() const;
  void setAngularDistanceWeight(double weight);
  bool normalizeRotation(double* values) const;  // the quaternion to length 1; was it not?
  double distanceRotation(const double* values1, const double* values2) const;
  double distanceTranslation(const double* values1, const double* values2) const;

private:
  friend class RobotModel;
  using JointModel::JointModel;
};
}  // namespace core
}  // namespace moveit
