// A solver as vendors write them: of a SCARA arm, in closed form, with the elbow on the side that a parameter says.
#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_model/robot_model.h>
#include <pluginlib/class_list_macros.hpp>

#include <cmath>

namespace moveit_kinematics_tests
{
class Scara : public kinematics::KinematicsBase
{
public:
  bool initialize(const moveit::core::RobotModel& robot_model, const std::string& group_name, const std::string& base_frame,
                  const std::vector<std::string>& tip_frames, double search_discretization) override
  {
    storeValues(robot_model, group_name, base_frame, tip_frames, search_discretization);
    const moveit::core::JointModelGroup* group = robot_model.getJointModelGroup(group_name);
    joints_ = group->getActiveJointModelNames();
    if (joints_.size() != 4)
      return false;
    upper_ = robot_model.getLinkModel("forearm")->getJointOriginTransform().translation().x();
    lower_ = robot_model.getLinkModel("slide")->getJointOriginTransform().translation().x();
    std::string elbow;
    lookupParam<std::string>("elbow", elbow, "left");
    side_ = elbow == "right" ? -1.0 : 1.0;
    lookupParam("stretch", stretch_, 1.0);
    return true;
  }

  const std::vector<std::string>& getJointNames() const override { return joints_; }
  const std::vector<std::string>& getLinkNames() const override { return tip_frames_; }

  using KinematicsBase::getPositionIK;
  bool getPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, std::vector<double>& solution,
                     moveit_msgs::MoveItErrorCodes& code, const kinematics::KinematicsQueryOptions& options) const override
  {
    return searchPositionIK(pose, seed, 0.0, std::vector<double>(), solution, IKCallbackFn(), code, options);
  }
  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        std::vector<double>& solution, moveit_msgs::MoveItErrorCodes& code,
                        const kinematics::KinematicsQueryOptions& options) const override
  {
    return searchPositionIK(pose, seed, timeout, std::vector<double>(), solution, IKCallbackFn(), code, options);
  }
  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        const std::vector<double>& consistency, std::vector<double>& solution,
                        moveit_msgs::MoveItErrorCodes& code, const kinematics::KinematicsQueryOptions& options) const override
  {
    return searchPositionIK(pose, seed, timeout, consistency, solution, IKCallbackFn(), code, options);
  }
  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        std::vector<double>& solution, const IKCallbackFn& callback, moveit_msgs::MoveItErrorCodes& code,
                        const kinematics::KinematicsQueryOptions& options) const override
  {
    return searchPositionIK(pose, seed, timeout, std::vector<double>(), solution, callback, code, options);
  }
  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& /*seed*/, double /*timeout*/,
                        const std::vector<double>& /*consistency*/, std::vector<double>& solution, const IKCallbackFn& callback,
                        moveit_msgs::MoveItErrorCodes& code,
                        const kinematics::KinematicsQueryOptions& /*options*/) const override
  {
    code.val = moveit_msgs::MoveItErrorCodes::NO_IK_SOLUTION;
    const double x = stretch_ * pose.position.x, y = stretch_ * pose.position.y;
    const double cosine = (x * x + y * y - upper_ * upper_ - lower_ * lower_) / (2.0 * upper_ * lower_);
    if (std::abs(cosine) > 1.0)
      return false;
    const double bend = side_ * std::acos(cosine);
    const double turn = std::atan2(y, x) - std::atan2(lower_ * std::sin(bend), upper_ + lower_ * std::cos(bend));
    const double yaw = 2.0 * std::atan2(pose.orientation.z, pose.orientation.w);
    solution = { std::remainder(turn, 2.0 * M_PI), bend, pose.position.z - 0.4, std::remainder(yaw - turn - bend, 2.0 * M_PI) };
    code.val = moveit_msgs::MoveItErrorCodes::SUCCESS;
    if (callback)
      callback(pose, solution, code);
    return code.val == moveit_msgs::MoveItErrorCodes::SUCCESS;
  }

  bool getPositionFK(const std::vector<std::string>& /*links*/, const std::vector<double>& /*angles*/,
                     std::vector<geometry_msgs::Pose>& /*poses*/) const override
  {
    return false;
  }

private:
  std::vector<std::string> joints_;
  double upper_ = 0.0, lower_ = 0.0, side_ = 1.0;
  double stretch_ = 1.0;  // other than 1: a solver for a robot of another size
};
}  // namespace moveit_kinematics_tests

PLUGINLIB_EXPORT_CLASS(moveit_kinematics_tests::Scara, kinematics::KinematicsBase)
