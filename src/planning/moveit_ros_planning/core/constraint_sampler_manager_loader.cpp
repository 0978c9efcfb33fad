#include <moveit/constraint_sampler_manager_loader/constraint_sampler_manager_loader.h>

#include <pluginlib/class_loader.hpp>
#include <ros/ros.h>

#include <sstream>

namespace constraint_sampler_manager_loader
{
using constraint_samplers::ConstraintSamplerAllocator;

class ConstraintSamplerManagerLoader::Loader : public pluginlib::ClassLoader<ConstraintSamplerAllocator>
{
public:
  Loader() : ClassLoader("moveit_core", "constraint_samplers::ConstraintSamplerAllocator") {}
};

ConstraintSamplerManagerLoader::ConstraintSamplerManagerLoader(const constraint_samplers::ConstraintSamplerManagerPtr& csm)
  : manager_(csm)
{
  std::string names;
  if (!ros::param::get("~constraint_samplers", names))
    return;
  loader_ = std::make_shared<Loader>();
  std::istringstream words(names);
  for (std::string word; words >> word;)
    try
    {
      manager_->registerSamplerAllocator(loader_->createUniqueInstance(word));
      ROS_INFO("Loaded constraint sampling method %s", word.c_str());
    }
    catch (const pluginlib::PluginlibException& error)
    {
      ROS_ERROR("Exception while loading constraint sampler '%s': %s", word.c_str(), error.what());
    }
}
}  // namespace constraint_sampler_manager_loader
