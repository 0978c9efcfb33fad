// URDF and SRDF from the parameter server or from texts.
#pragma once

#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <srdfdom/model.h>
#include <urdf/model.h>

namespace rdf_loader
{
MOVEIT_CLASS_FORWARD(RDFLoader);

class RDFLoader
{
public:
  // Parameters <robot_description> and <robot_description>_semantic, searched upward from the node's private namespace.
  RDFLoader(const std::string& robot_description = "robot_description");
  RDFLoader(const std::string& urdf_string, const std::string& srdf_string);

  const std::string& getRobotDescription() const { return robot_description_; }  // where it was found
  const urdf::ModelInterfaceSharedPtr& getURDF() const { return urdf_; }         // null if there is none
  const srdf::ModelSharedPtr& getSRDF() const { return srdf_; }

  static bool isXacroFile(const std::string& path);
  static bool loadFileToString(std::string& buffer, const std::string& path);
  static bool loadXacroFileToString(std::string& buffer, const std::string& path, const std::vector<std::string>& xacro_args);
  static bool loadXmlFileToString(std::string& buffer, const std::string& path, const std::vector<std::string>& xacro_args);
  static bool loadPkgFileToString(std::string& buffer, const std::string& package_name, const std::string& relative_path,
                                  const std::vector<std::string>& xacro_args);

private:
  void parse(const std::string& urdf, const std::string& srdf);

  std::string robot_description_;
  srdf::ModelSharedPtr srdf_;
  urdf::ModelInterfaceSharedPtr urdf_;
};
}  // namespace rdf_loader
