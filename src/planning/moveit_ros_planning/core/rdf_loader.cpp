#include <moveit/rdf_loader/rdf_loader.h>

#include <ros/package.h>
#include <ros/ros.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "log_names.hpp"

namespace rdf_loader
{
RDFLoader::RDFLoader(const std::string& robot_description)
{
  const ros::NodeHandle nh("~");
  std::string urdf, srdf;
  if (!nh.searchParam(robot_description, robot_description_) || !nh.getParam(robot_description_, urdf))
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "Robot model parameter not found! Did you remap '%s'?", robot_description.c_str());
    return;
  }
  if (!nh.getParam(robot_description_ + "_semantic", srdf))
    ROS_ERROR_NAMED(log_names::RDF_LOADER,
                    "Robot semantic description not found. Did you forget to define or remap '%s_semantic'?",
                    robot_description_.c_str());
  parse(urdf, srdf);
}

RDFLoader::RDFLoader(const std::string& urdf_string, const std::string& srdf_string) { parse(urdf_string, srdf_string); }

void RDFLoader::parse(const std::string& urdf, const std::string& srdf)
{
  const auto model = std::make_shared<urdf::Model>();
  if (!model->initString(urdf))
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "Unable to parse URDF%s%s", robot_description_.empty() ? "" : " from parameter ",
                    robot_description_.c_str());
    return;
  }
  urdf_ = model;
  srdf_ = std::make_shared<srdf::Model>();
  if (!srdf.empty() && !srdf_->initString(*urdf_, srdf))
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "Unable to parse SRDF%s%s%s", robot_description_.empty() ? "" : " from parameter ",
                    robot_description_.c_str(), robot_description_.empty() ? "" : "_semantic");
    srdf_.reset();
  }
}

// ---------------------------------------------------------------- files

bool RDFLoader::isXacroFile(const std::string& path)
{
  const std::string end = ".xacro";
  return path.size() >= end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
}

bool RDFLoader::loadFileToString(std::string& buffer, const std::string& path)
{
  std::ifstream file(path);
  if (path.empty() || !file)
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "Unable to load path: '%s'", path.c_str());
    return false;
  }
  std::ostringstream text;
  text << file.rdbuf();
  buffer = text.str();
  return true;
}

bool RDFLoader::loadXacroFileToString(std::string& buffer, const std::string& path, const std::vector<std::string>& xacro_args)
{
  buffer.clear();
  if (path.empty() || !std::ifstream(path))
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "File does not exist: '%s'", path.c_str());
    return false;
  }
  std::string command = "rosrun xacro xacro '" + path + "'";
  for (const std::string& argument : xacro_args)
    command += " " + argument;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe)
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "Unable to run xacro on '%s'", path.c_str());
    return false;
  }
  char part[4096];
  for (std::size_t read; (read = fread(part, 1, sizeof(part), pipe)) > 0;)
    buffer.append(part, read);
  return pclose(pipe) == 0;
}

bool RDFLoader::loadXmlFileToString(std::string& buffer, const std::string& path, const std::vector<std::string>& xacro_args)
{
  return isXacroFile(path) ? loadXacroFileToString(buffer, path, xacro_args) : loadFileToString(buffer, path);
}

bool RDFLoader::loadPkgFileToString(std::string& buffer, const std::string& package_name, const std::string& relative_path,
                                    const std::vector<std::string>& xacro_args)
{
  const std::string folder = ros::package::getPath(package_name);
  if (folder.empty())
  {
    ROS_ERROR_NAMED(log_names::RDF_LOADER, "There is no package '%s'", package_name.c_str());
    return false;
  }
  return loadXmlFileToString(buffer, folder + "/" + relative_path, xacro_args);
}
}  // namespace rdf_loader
