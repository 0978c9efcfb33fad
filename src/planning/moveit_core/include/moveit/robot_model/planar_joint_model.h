#pragma once

#include <moveit/robot_model/joint_model.h>

namespace moveit
{
namespace core
{
// x, y (m), theta (rad).
class PlanarJointModel : public JointModel
{
public:
  enum MotionModel
  {
    HOLONOMIC,
    DIFF_DRIVE
  };
  double getAngularDistanceWeight() const;
  void setAngularDistanceWeight(double weight);
  double getMinTranslationalDistance() const;
  void setMinTranslationalDistance(double min_translational_distance);
  MotionModel getMotionModel() const;
  void setMotionModel(MotionModel model);
  bool normalizeRotation(double* values) const;  // theta into [-pi, pi]; was it outside?

private:
  friend class RobotModel;
  using JointModel::JointModel;
};
}  // namespace core
}  // namespace moveit
