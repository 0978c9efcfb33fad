#include <moveit/dynamics_solver/dynamics_solver.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <ros/console.h>

#include <cmath>
#include <limits>

#include <moveit/robot_model/joint_model_group.h>
#include <moveit/robot_model/robot_model.h>

#include "log_names.hpp"

namespace dynamics_solver
{
namespace
{
KDL::JntArray array(const std::vector<double>& values)
{
  KDL::JntArray out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    out(i) = values[i];
  return out;
}
}  // namespace

DynamicsSolver::DynamicsSolver(const moveit::core::RobotModelConstPtr& robot_model, const std::string& group_name,
                               const geometry_msgs::Vector3& gravity_vector)
  : robot_model_(robot_model)
  , group_(robot_model->getJointModelGroup(group_name))
  , gravity_(gravity_vector.x, gravity_vector.y, gravity_vector.z)
{
  if (!group_)
    return;  // the model has said that there is no such group
  if (!group_->isChain())
    refuse("is not a chain");
  else if (!group_->getMimicJointModels().empty())
    refuse("has a mimic joint");
  else if (!group_->getJointRoots()[0]->getParentLinkModel())
    refuse("does not have a parent link");
  if (!group_)
    return;
  KDL::Tree tree;
  const std::string base = group_->getJointRoots()[0]->getParentLinkModel()->getName();
  if (!kdl_parser::treeFromUrdfModel(*robot_model_->getURDF(), tree) ||
      !tree.getChain(base, group_->getLinkModelNames().back(), chain_) || chain_.getNrOfJoints() != group_->getVariableCount())
  {
    refuse("cannot be made a chain of KDL's with one value for each joint");
    return;
  }
  for (const KDL::Segment& segment : chain_.segments)
    if (segment.getJoint().getType() != KDL::Joint::None)
    {
      const auto joint = robot_model_->getURDF()->getJoint(segment.getJoint().getName());
      max_torques_.push_back(joint && joint->limits ? joint->limits->effort : 0.0);
    }
}

bool DynamicsSolver::refuse(const std::string& reason)
{
  ROS_ERROR_NAMED(log_names::DYNAMICS_SOLVER, "Group '%s' %s. Will not initialize dynamics solver", group_->getName().c_str(),
                  reason.c_str());
  group_ = nullptr;
  return false;
}

bool DynamicsSolver::fits(const std::vector<double>& values, const char* what) const
{
  if (!group_)
    return false;
  if (values.size() != chain_.getNrOfJoints())
    ROS_ERROR_NAMED(log_names::DYNAMICS_SOLVER, "%s: %zu values for the %u joints of group '%s'", what, values.size(),
                    chain_.getNrOfJoints(), group_->getName().c_str());
  return values.size() == chain_.getNrOfJoints();
}

bool DynamicsSolver::getTorques(const std::vector<double>& joint_angles, const std::vector<double>& joint_velocities,
                                const std::vector<double>& joint_accelerations,
                                const std::vector<geometry_msgs::Wrench>& wrenches, std::vector<double>& torques) const
{
  if (!fits(joint_angles, "joint angles") || !fits(joint_velocities, "joint velocities") ||
      !fits(joint_accelerations, "joint accelerations") || !fits(torques, "torques"))
    return false;
  if (wrenches.size() != chain_.getNrOfSegments())
  {
    ROS_ERROR_NAMED(log_names::DYNAMICS_SOLVER, "%zu wrenches for the %u segments of group '%s'", wrenches.size(),
                    chain_.getNrOfSegments(), group_->getName().c_str());
    return false;
  }
  KDL::Wrenches forces;
  for (const geometry_msgs::Wrench& w : wrenches)
    forces.emplace_back(KDL::Vector(w.force.x, w.force.y, w.force.z), KDL::Vector(w.torque.x, w.torque.y, w.torque.z));
  KDL::ChainIdSolver_RNE solver(chain_, gravity_);  // keeps scratch data: one for each question, asked from any thread
  KDL::JntArray result(chain_.getNrOfJoints());
  if (solver.CartToJnt(array(joint_angles), array(joint_velocities), array(joint_accelerations), forces, result) < 0)
    return false;
  for (std::size_t i = 0; i < torques.size(); ++i)
    torques[i] = result(i);
  return true;
}

bool DynamicsSolver::getPayloadTorques(const std::vector<double>& joint_angles, double payload,
                                       std::vector<double>& joint_torques) const
{
  if (!fits(joint_angles, "joint angles") || !fits(joint_torques, "torques"))
    return false;
  KDL::Frame tip;
  KDL::ChainFkSolverPos_recursive(chain_).JntToCart(array(joint_angles), tip);
  const KDL::Vector weight = tip.M.Inverse(gravity_ * payload);
  std::vector<geometry_msgs::Wrench> wrenches(chain_.getNrOfSegments());
  wrenches.back().force.x = weight.x();
  wrenches.back().force.y = weight.y();
  wrenches.back().force.z = weight.z();
  const std::vector<double> still(joint_angles.size(), 0.0);
  return getTorques(joint_angles, still, still, wrenches, joint_torques);
}

bool DynamicsSolver::getMaxPayload(const std::vector<double>& joint_angles, double& payload,
                                   unsigned int& joint_saturated) const
{
  std::vector<double> empty(joint_angles.size()), loaded(joint_angles.size());
  if (!getPayloadTorques(joint_angles, 0.0, empty) || !getPayloadTorques(joint_angles, 1.0, loaded))
    return false;
  payload = std::numeric_limits<double>::max();
  joint_saturated = 0;
  for (std::size_t i = 0; i < empty.size(); ++i)
  {
    const double for_one_kg = loaded[i] - empty[i];
    double most = std::numeric_limits<double>::max();  // what does not load the joint can be as heavy as it likes
    if (std::abs(empty[i]) >= max_torques_[i])
      most = 0.0;
    else if (std::abs(for_one_kg) > 1e-9)
      most = (std::copysign(max_torques_[i], for_one_kg) - empty[i]) / for_one_kg;
    if (most < payload)
    {
      payload = most;
      joint_saturated = static_cast<unsigned int>(i);
    }
  }
  return true;
}
}  // namespace dynamics_solver
