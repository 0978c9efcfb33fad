#include "solver_plugins.hpp"

#include <dlfcn.h>
#include <pluginlib/class_loader.hpp>

#include <memory>
#include <mutex>
#include <stdexcept>

#include "motion/robot_model.hpp"

namespace kinematics_plugin_loader
{
namespace
{
using Loader = pluginlib::ClassLoader<kinematics::KinematicsBase>;

std::mutex one_at_a_time;

// Never destroyed: solvers may live until the process ends, and their code with them.
Loader& loader()
{
  static Loader* const made = new Loader("moveit_core", "kinematics::KinematicsBase");
  return *made;
}

std::string oneLine(std::string text)
{
  for (char& c : text)
    if (c == '\n')
      c = ' ';
  return text.substr(0, 300);
}

// What a library lacks would end the process when it is first called: all of it is looked up now.
void demandWholeLibrary(const std::string& path)
{
  if (!path.empty() && !dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL))
    throw std::runtime_error(oneLine(dlerror()));
}

std::vector<std::string> tipsOf(const moveit::core::JointModelGroup& group)
{
  std::vector<std::string> tips;
  for (int tip : group.core().tips)
    tips.push_back(group.getParentModel().getLinkModel(tip)->getName());
  if (tips.empty() && !group.getLinkModelNames().empty())
    tips.push_back(group.getLinkModelNames().back());
  return tips;
}
}  // namespace

bool isExported(const std::string& plugin)
{
  std::lock_guard<std::mutex> lock(one_at_a_time);
  return loader().isClassAvailable(plugin);
}

std::string packageOf(const std::string& plugin)
{
  std::lock_guard<std::mutex> lock(one_at_a_time);
  return loader().isClassAvailable(plugin) ? loader().getClassPackage(plugin) : "";
}

kinematics::KinematicsBasePtr makeSolver(const SolverRequest& request, const moveit::core::JointModelGroup& group)
{
  kinematics::KinematicsBasePtr solver;
  {
    std::lock_guard<std::mutex> lock(one_at_a_time);
    try
    {
      demandWholeLibrary(loader().getClassLibraryPath(request.plugin));
      solver = loader().createUniqueInstance(request.plugin);
    }
    catch (const pluginlib::PluginlibException& error)
    {
      throw std::runtime_error(oneLine(error.what()));
    }
  }
  const std::vector<std::string> tips = request.tips.empty() ? tipsOf(group) : request.tips;
  const moveit::core::LinkModel* link = group.getJointModels().front()->getParentLinkModel();
  const std::string base = link ? link->getName() : group.getParentModel().getModelFrame();
  // Old solvers know the second way alone.
  if (!solver->initialize(group.getParentModel(), group.getName(), base, tips, request.resolution) &&
      !solver->initialize(request.robot_description, group.getName(), base, tips, request.resolution))
    throw std::runtime_error("kinematics solver '" + request.plugin + "' could not be initialized for group '" +
                             group.getName() + "'");
  std::string why;
  if (!solver->supportsGroup(&group, &why))
    throw std::runtime_error("kinematics solver '" + request.plugin + "' does not support group '" + group.getName() +
                             "': " + oneLine(why));
  return solver;
}
}  // namespace kinematics_plugin_loader
