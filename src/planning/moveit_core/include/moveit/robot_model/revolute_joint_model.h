#pragma once

#include <moveit/robot_model/joint_model.h>

namespace moveit
{
namespace core
{
class RevoluteJointModel : public JointModel
{
public:
  bool isContinuous() const;
  void setContinuous(bool flag);
  const Eigen::Vector3d& getAxis() const;  // in the joint's frame

private:
  friend class RobotModel;
  using JointModel::JointModel;
};
}  // namespace core
}  // namespace moveit
