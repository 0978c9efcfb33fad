#include <moveit/kinematics_plugin_loader/kinematics_plugin_loader.h>

#include <moveit/rdf_loader/rdf_loader.h>
#include <ros/ros.h>

#include <mutex>
#include <sstream>

#include "log_names.hpp"
#include "plugin_solver.hpp"
#include "solver_plugins.hpp"

namespace kinematics_plugin_loader
{
namespace
{
constexpr char OWN[] = "moveit_kinematics";  // exports the motion library's under the names of MoveIt's: no detour for those
constexpr char LIBRARY[] = "kdl_kinematics_plugin/KDLKinematicsPlugin";  // the motion library's own, by its best known name

struct GroupSettings
{
  std::vector<std::string> solvers;  // the first that works
  std::vector<std::string> tips;
  double resolution = kinematics::KinematicsBase::DEFAULT_SEARCH_DISCRETIZATION;
  double timeout = 0.0;
};

// A number, whole or not.
bool number(const std::string& name, double& value)
{
  int whole;
  if (ros::param::get(name, value))
    return true;
  if (!ros::param::get(name, whole))
    return false;
  value = whole;
  return true;
}

// Parameter `key` of a group: below ~<group>, else below <robot_description>_kinematics/<group>; "" when it is not set.
std::string find(const ros::NodeHandle& nh, const std::string& description, const std::string& group, const std::string& key)
{
  std::string where;
  if (nh.searchParam(group + "/" + key, where) || nh.searchParam(description + "_kinematics/" + group + "/" + key, where))
    return where;
  return "";
}
}  // namespace

class KinematicsPluginLoader::KinematicsLoaderImpl
{
public:
  std::string robot_description;
  std::map<std::string, GroupSettings> groups;

  // Solvers are made once for each group of each robot and shared, as long as the robot lives.
  kinematics::KinematicsBasePtr make(const moveit::core::JointModelGroup* group)
  {
    if (!group)
      return nullptr;
    const auto settings = groups.find(group->getName());
    if (settings == groups.end())
    {
      ROS_DEBUG_NAMED(log_names::KINEMATICS_PLUGIN_LOADER, "No kinematics solver is configured for group '%s'",
                      group->getName().c_str());
      return nullptr;
    }
    SolverRequest request;
    request.robot_description = robot_description;
    request.tips = settings->second.tips;
    request.resolution = settings->second.resolution;
    std::string why;
    for (const std::string& plugin : settings->second.solvers)
    {
      request.plugin = plugin;
      try
      {
        return makeSolver(request, *group);
      }
      catch (const std::exception& error)
      {
        why = error.what();
      }
    }
    request.plugin = LIBRARY;
    try
    {
      const kinematics::KinematicsBasePtr solver = makeSolver(request, *group);
      ROS_WARN_NAMED(log_names::KINEMATICS_PLUGIN_LOADER,
                     "Kinematics solver '%s' of group '%s' is not there; the motion library's takes its place (%s)",
                     settings->second.solvers[0].c_str(), group->getName().c_str(), why.c_str());
      return solver;
    }
    catch (const std::exception& error)
    {
      ROS_ERROR_NAMED(log_names::KINEMATICS_PLUGIN_LOADER, "Kinematics solver could not be instantiated for joint group %s: %s",
                      group->getName().c_str(), error.what());
    }
    return nullptr;
  }
};

KinematicsPluginLoader::KinematicsPluginLoader(const std::string& robot_description, double default_search_resolution)
  : robot_description_(robot_description)
  , default_search_resolution_(default_search_resolution)
{
}

KinematicsPluginLoader::KinematicsPluginLoader(const std::string& solver_plugin, double solve_timeout,
                                               unsigned int /*ik_attempts*/, const std::string& robot_description,
                                               double default_search_resolution)
  : robot_description_(robot_description)
  , default_search_resolution_(default_search_resolution)
  , default_solver_plugin_(solver_plugin)
  , default_solver_timeout_(solve_timeout)
{
}

moveit::core::SolverAllocatorFn KinematicsPluginLoader::getLoaderFunction()
{
  if (loader_)
  {
    const KinematicsLoaderImplPtr loader = loader_;
    return [loader](const moveit::core::JointModelGroup* group) { return loader->make(group); };
  }
  rdf_loader::RDFLoader rdf(robot_description_);
  robot_description_ = rdf.getRobotDescription();
  return getLoaderFunction(rdf.getSRDF());
}

moveit::core::SolverAllocatorFn KinematicsPluginLoader::getLoaderFunction(const srdf::ModelSharedPtr& srdf_model)
{
  if (!loader_)
  {
    loader_ = std::make_shared<KinematicsLoaderImpl>();
    loader_->robot_description = robot_description_;
    const ros::NodeHandle nh("~");
    for (const srdf::Model::Group& group : srdf_model ? srdf_model->getGroups() : std::vector<srdf::Model::Group>())
    {
      GroupSettings settings;
      std::string names = default_solver_plugin_;
      settings.timeout = default_solver_timeout_;
      if (default_search_resolution_ > 0.0)
        settings.resolution = default_search_resolution_;
      const std::string solver = find(nh, robot_description_, group.name_, "kinematics_solver");
      if (!solver.empty())
      {
        ros::param::get(solver, names);
        const std::string prefix = solver.substr(0, solver.rfind('/') + 1);
        number(prefix + "kinematics_solver_timeout", settings.timeout);
        number(prefix + "kinematics_solver_search_resolution", settings.resolution);
        ros::param::get(prefix + "kinematics_solver_ik_links", settings.tips);
      }
      std::istringstream words(names);
      for (std::string word; words >> word;)
        settings.solvers.push_back(word);
      if (settings.solvers.empty())
        continue;
      groups_.push_back(group.name_);
      if (settings.timeout > 0.0)
        ik_timeout_[group.name_] = settings.timeout;
      loader_->groups[group.name_] = settings;
    }
    if (groups_.empty() && srdf_model && !srdf_model->getGroups().empty())
      ROS_WARN_NAMED(log_names::KINEMATICS_PLUGIN_LOADER, "No kinematics plugins defined. Fill and load kinematics.yaml!");
  }
  return getLoaderFunction();
}

void KinematicsPluginLoader::solveFor(const moveit::core::RobotModel& model) const
{
  if (!loader_)
    return;
  for (const auto& [group, settings] : loader_->groups)
    for (const std::string& plugin : settings.solvers)
    {
      const std::string package = packageOf(plugin);
      if (package.empty())
        continue;
      SolverRequest request;
      request.plugin = plugin;
      request.robot_description = robot_description_;
      request.tips = settings.tips;
      request.resolution = settings.resolution;
      request.timeout = settings.timeout;
      if (package != OWN && model.hasJointModelGroup(group))
        installSolverLate(model, group, request);
      break;
    }
}

void KinematicsPluginLoader::status() const
{
  if (!loader_)
    ROS_INFO_NAMED(log_names::KINEMATICS_PLUGIN_LOADER, "Loader function was never required");
  else
    for (const auto& group : loader_->groups)
      for (const std::string& solver : group.second.solvers)
        ROS_INFO_NAMED(log_names::KINEMATICS_PLUGIN_LOADER, "Solver for group '%s': '%s' (search resolution = %lf)",
                       group.first.c_str(), solver.c_str(), group.second.resolution);
}
}  // namespace kinematics_plugin_loader
