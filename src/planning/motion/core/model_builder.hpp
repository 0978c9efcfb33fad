// Makes a RobotModel of a parsed URDF and SRDF.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <set>

#include "motion/robot_model.hpp"

namespace motion
{
// Parses with urdfdom; its complaints become one ModelError. The root link's names etc. are checked there.
// `faults` takes the first fault of each part that urdfdom left out.
urdf::ModelInterfaceSharedPtr parseUrdf(const std::string& text, std::vector<std::string>& faults);

class ModelBuilder
{
public:
  ModelBuilder(urdf::ModelInterfaceSharedPtr urdf, const RobotModel::Options& options, RobotModel& model)
    : urdf_(std::move(urdf))
    , options_(options)
    , model_(model)
  {
  }
  void build();  // model.srdf and model.warnings are set already

private:
  void buildRootJoint();
  void addLink(const urdf::Link& link, int parent_joint);
  void addJoint(const urdf::Joint& joint, int parent_link);
  void addVariables(JointModel& joint);
  void addShapes(const urdf::Link& link, LinkModel& out);
  ShapePtr shape(const urdf::Geometry& geometry, const std::string& link);
  void resolveMimics();
  void applyProperties();
  std::pair<JointModel*, int> variableNamed(const std::string& name);
  void warnOfLimits(const std::string& name);
  void applyLimits();
  void finishVariables();
  void findDescendants();
  void warn(const std::string& text) { model_.warnings.push_back(text); }
  void error(const std::string& text)
  {
    warn("error: " + text);
  }  // some of the robot cannot be planned for; who logs it tells by the mark

  // groups (groups.cpp)
  void buildGroups();
  bool buildGroup(const Srdf::Group& group, std::set<std::string>& in_progress);
  std::set<int> jointsOfChain(const std::string& base, const std::string& tip, const std::string& group);
  void finishGroup(JointModelGroup& group, const std::set<int>& joints);
  void findTips(JointModelGroup& group);
  void buildStates();
  void buildEndEffectors();

  urdf::ModelInterfaceSharedPtr urdf_;
  const RobotModel::Options& options_;
  RobotModel& model_;
  std::map<std::string, ShapePtr> meshes_;
  std::map<std::string, std::pair<std::string, std::pair<double, double>>> mimics_;
};
}  // namespace motion
