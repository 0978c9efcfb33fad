#include <moveit/robot_model_loader/robot_model_loader.h>

#include <ros/ros.h>

#include <algorithm>

#include "log_names.hpp"

namespace robot_model_loader
{
RobotModelLoader::RobotModelLoader(const std::string& robot_description, bool load_kinematics_solvers)
{
  Options options(robot_description);
  options.load_kinematics_solvers_ = load_kinematics_solvers;
  configure(options);
}

RobotModelLoader::RobotModelLoader(const Options& opt) { configure(opt); }

RobotModelLoader::~RobotModelLoader() = default;

void RobotModelLoader::configure(const Options& opt)
{
  const ros::WallTime start = ros::WallTime::now();
  if (!opt.urdf_string_.empty() && !opt.srdf_string_.empty())
    rdf_loader_ = std::make_shared<rdf_loader::RDFLoader>(opt.urdf_string_, opt.srdf_string_);
  else
    rdf_loader_ = std::make_shared<rdf_loader::RDFLoader>(opt.robot_description_);
  if (!getURDF())
    return;
  try
  {
    model_ = std::make_shared<moveit::core::RobotModel>(getURDF(), getSRDF() ? getSRDF() : std::make_shared<srdf::Model>());
  }
  catch (const std::exception&)
  {
    return;  // said already
  }
  if (!getRobotDescription().empty())
    readLimits();
  if (opt.load_kinematics_solvers_)
    loadKinematicsSolvers();
  ROS_DEBUG_STREAM_NAMED(log_names::ROBOT_MODEL_LOADER,
                         "Loaded kinematic model in " << (ros::WallTime::now() - start).toSec() << " seconds");
}

namespace
{
// The table of a variable: that of `base/x` is below `base`.
XmlRpc::XmlRpcValue* tableOf(XmlRpc::XmlRpcValue& limits, const std::string& variable)
{
  XmlRpc::XmlRpcValue* table = &limits;
  for (std::size_t at = 0, next; at <= variable.size(); at = next + 1)
  {
    next = std::min(variable.find('/', at), variable.size());
    const std::string part = variable.substr(at, next - at);
    if (table->getType() != XmlRpc::XmlRpcValue::TypeStruct || !table->hasMember(part))
      return nullptr;
    table = &(*table)[part];
  }
  return table->getType() == XmlRpc::XmlRpcValue::TypeStruct ? table : nullptr;
}

bool readNumber(XmlRpc::XmlRpcValue& table, const std::string& key, double& value)
{
  if (!table.hasMember(key))
    return false;
  XmlRpc::XmlRpcValue& item = table[key];
  if (item.getType() == XmlRpc::XmlRpcValue::TypeInt)
    value = static_cast<int>(item);
  else if (item.getType() == XmlRpc::XmlRpcValue::TypeDouble)
    value = static_cast<double>(item);
  else
    return false;
  return true;
}

// A limit counts without its flag, which can take it back, but makes none.
void readLimit(XmlRpc::XmlRpcValue& table, const std::string& what, const std::string& joint, double& value, std::uint8_t& has)
{
  const std::string key = "max_" + what, flag = "has_" + what + "_limits";
  if (readNumber(table, key, value))
    has = true;
  if (!table.hasMember(flag) || table[flag].getType() != XmlRpc::XmlRpcValue::TypeBoolean)
    return;
  if (!static_cast<bool>(table[flag]))
    has = false;
  else if (!has)
    ROS_WARN_NAMED(log_names::ROBOT_MODEL_LOADER, "joint_limits: joint '%s' has %s: true, but no %s: it counts as not limited",
                   joint.c_str(), flag.c_str(), key.c_str());
}

bool isAngle(const moveit::core::JointModel& joint, std::size_t variable)
{
  return (joint.getType() == moveit::core::JointModel::PLANAR && variable == 2) ||
         (joint.getType() == moveit::core::JointModel::FLOATING && variable > 2) ||
         (joint.getType() == moveit::core::JointModel::REVOLUTE &&
          static_cast<const moveit::core::RevoluteJointModel&>(joint).isContinuous());
}
}  // namespace

// <robot_description>_planning/joint_limits wins over the URDF.
void RobotModelLoader::readLimits()
{
  XmlRpc::XmlRpcValue limits;
  if (!ros::param::get(getRobotDescription() + "_planning/joint_limits", limits) ||
      limits.getType() != XmlRpc::XmlRpcValue::TypeStruct)
    return;
  for (moveit::core::JointModel* joint : model_->getJointModels())
  {
    std::vector<moveit_msgs::JointLimits> all = joint->getVariableBoundsMsg();
    bool changed = false;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      XmlRpc::XmlRpcValue* given = tableOf(limits, all[i].joint_name);
      if (!given)
        continue;
      moveit_msgs::JointLimits limit = all[i];
      const bool low = readNumber(*given, "min_position", limit.min_position);
      const bool high = readNumber(*given, "max_position", limit.max_position);
      if ((low || high) && isAngle(*joint, i))
      {
        ROS_WARN_NAMED(log_names::ROBOT_MODEL_LOADER,
                       "joint_limits: position limits of joint '%s' are left out: it turns without end",
                       limit.joint_name.c_str());
        limit.min_position = all[i].min_position;
        limit.max_position = all[i].max_position;
      }
      else if (low || high)
        limit.has_position_limits = true;
      readLimit(*given, "velocity", limit.joint_name, limit.max_velocity, limit.has_velocity_limits);
      readLimit(*given, "acceleration", limit.joint_name, limit.max_acceleration, limit.has_acceleration_limits);
      if (limit.min_position > limit.max_position)
      {
        ROS_ERROR_NAMED(log_names::ROBOT_MODEL_LOADER,
                        "joint_limits of '%s': min_position %g is above max_position %g; the limits of the URDF stay",
                        limit.joint_name.c_str(), limit.min_position, limit.max_position);
        continue;
      }
      all[i] = limit;
      changed = true;
    }
    if (changed)
      joint->setVariableBounds(all);
  }
}

void RobotModelLoader::loadKinematicsSolvers(const kinematics_plugin_loader::KinematicsPluginLoaderPtr& kloader)
{
  if (!model_)
    return;
  kinematics_loader_ = kloader ? kloader
                               : std::make_shared<kinematics_plugin_loader::KinematicsPluginLoader>(
                                     getRobotDescription().empty() ? "robot_description" : getRobotDescription());
  const moveit::core::SolverAllocatorFn allocator = kinematics_loader_->getLoaderFunction(getSRDF());
  std::map<std::string, moveit::core::SolverAllocatorFn> by_group;
  for (const std::string& name : kinematics_loader_->getKnownGroups())
    if (model_->hasJointModelGroup(name))
      by_group[name] = allocator;
  model_->setKinematicsAllocators(by_group);
  kinematics_loader_->solveFor(*model_);
  for (const auto& timeout : kinematics_loader_->getIKTimeout())
    if (model_->hasJointModelGroup(timeout.first))
      model_->getJointModelGroup(timeout.first)->setDefaultIKTimeout(timeout.second);
}
}  // namespace robot_model_loader
