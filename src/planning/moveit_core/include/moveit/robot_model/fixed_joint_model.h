#pragma once

#include <moveit/robot_model/joint_model.h>

namespace moveit
{
namespace core
{
class FixedJointModel : public JointModel
{
  friend class RobotModel;
  using JointModel::JointModel;
};
}  // namespace core
}  // namespace moveit
