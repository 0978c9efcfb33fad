#pragma once

#include <moveit/robot_model/joint_model.h>

namespace moveit
{
namespace core
{
class PrismaticJointModel : public JointModel
{
public:
  const Eigen::Vector3d& getAxis() const;  // in the joint's frame

private:
  friend class RobotModel;
  using JointModel::JointModel;
};
}  // namespace core
}  // namespace moveit
