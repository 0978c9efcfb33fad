// A robot from the parameter server: description, semantics, limits, kinematics solvers.
#pragma once

#include <moveit/kinematics_plugin_loader/kinematics_plugin_loader.h>
#include <moveit/macros/class_forward.h>
#include <moveit/rdf_loader/rdf_loader.h>
#include <moveit/robot_model/robot_model.h>

namespace robot_model_loader
{
MOVEIT_CLASS_FORWARD(RobotModelLoader);

class RobotModelLoader
{
public:
  struct Options
  {
    Options(const std::string& robot_description = "robot_description") : robot_description_(robot_description) {}
    Options(const std::string& urdf_string, const std::string& srdf_string)
      : urdf_string_(urdf_string)
      , srdf_string_(srdf_string)
    {
    }
    std::string robot_description_;
    std::string urdf_string_, srdf_string_;  // if there: instead of the parameters
    bool load_kinematics_solvers_ = true;
  };

  RobotModelLoader(const Options& opt = Options());
  RobotModelLoader(const std::string& robot_description, bool load_kinematics_solvers = true);
  ~RobotModelLoader();

  // Null when it could not be loaded; the log says why.
  const moveit::core::RobotModelPtr& getModel() const { return model_; }
  const std::string& getRobotDescription() const { return rdf_loader_->getRobotDescription(); }
  const urdf::ModelInterfaceSharedPtr& getURDF() const { return rdf_loader_->getURDF(); }
  const srdf::ModelSharedPtr& getSRDF() const { return rdf_loader_->getSRDF(); }
  const rdf_loader::RDFLoaderPtr& getRDFLoader() const { return rdf_loader_; }
  const kinematics_plugin_loader::KinematicsPluginLoaderPtr& getKinematicsPluginLoader() const { return kinematics_loader_; }
  void loadKinematicsSolvers(const kinematics_plugin_loader::KinematicsPluginLoaderPtr& kloader =
                                 kinematics_plugin_loader::KinematicsPluginLoaderPtr());

private:
  void configure(const Options& opt);
  void readLimits();

  moveit::core::RobotModelPtr model_;
  rdf_loader::RDFLoaderPtr rdf_loader_;
  kinematics_plugin_loader::KinematicsPluginLoaderPtr kinematics_loader_;
};
}  // namespace robot_model_loader
