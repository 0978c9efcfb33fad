#include "srdfdom/model.h"

#include <console_bridge/console.h>

#include <fstream>
#include <sstream>

#include "motion/srdf.hpp"

namespace srdf
{
Model::Model() : core_(std::make_shared<motion::Srdf>()) {}
Model::~Model() = default;

void Model::clear() { *this = Model(); }

bool Model::initString(const urdf::ModelInterface& urdf_model, const std::string& xmlstring)
{
  clear();
  try
  {
    std::vector<std::string> warnings;
    core_ = std::make_shared<motion::Srdf>(motion::Srdf::parse(xmlstring, warnings));
    for (const std::string& warning : warnings)
      CONSOLE_BRIDGE_logWarn("%s", warning.c_str());
  }
  catch (const motion::Error& error)
  {
    CONSOLE_BRIDGE_logError("%s", error.what());
    return false;
  }
  if (core_->name != urdf_model.getName())
    CONSOLE_BRIDGE_logError("Semantic description is not specified for the same robot as the URDF ('%s', '%s')",
                            core_->name.c_str(), urdf_model.getName().c_str());
  fill();
  return true;
}

bool Model::initXml(const urdf::ModelInterface& urdf_model, tinyxml2::XMLElement* xml)
{
  if (!xml)
    return initString(urdf_model, "");
  tinyxml2::XMLPrinter printer;
  xml->Accept(&printer);
  return initString(urdf_model, printer.CStr());
}

bool Model::initXml(const urdf::ModelInterface& urdf_model, tinyxml2::XMLDocument* xml)
{
  return initXml(urdf_model, xml ? xml->FirstChildElement("robot") : nullptr);
}

bool Model::initFile(const urdf::ModelInterface& urdf_model, const std::string& filename)
{
  std::ifstream file(filename);
  if (!file)
  {
    clear();
    CONSOLE_BRIDGE_logError("Could not open file [%s] for parsing.", filename.c_str());
    return false;
  }
  std::ostringstream text;
  text << file.rdbuf();
  return initString(urdf_model, text.str());
}

const Model::PropertyMap& Model::getJointProperties(const std::string& joint_name) const
{
  static const PropertyMap none;
  const auto found = joint_properties_.find(joint_name);
  return found == joint_properties_.end() ? none : found->second;
}

namespace
{
std::vector<Model::CollisionPair> pairs(const std::vector<motion::Srdf::LinkPair>& from)
{
  std::vector<Model::CollisionPair> to;
  for (const auto& p : from)
    to.push_back({p.link1, p.link2, p.reason});
  return to;
}
}  // namespace

void Model::fill()
{
  name_ = core_->name;
  for (const auto& g : core_->groups)
    groups_.push_back({g.name, g.joints, g.links, g.chains, g.subgroups});
  for (const auto& s : core_->states)
    group_states_.push_back({s.name, s.group, s.joints});
  for (const auto& v : core_->virtual_joints)
    virtual_joints_.push_back({v.name, v.type, v.parent_frame, v.child_link});
  for (const auto& e : core_->end_effectors)
    end_effectors_.push_back({e.name, e.parent_link, e.parent_group, e.group});
  for (const auto& s : core_->spheres)
  {
    LinkSpheres link{s.link, {}};
    for (const auto& sphere : s.spheres)
      link.spheres_.push_back({sphere.first.x(), sphere.first.y(), sphere.first.z(), sphere.second});
    link_sphere_approximations_.push_back(link);
  }
  no_default_collision_links_ = core_->no_default_collision;
  enabled_collision_pairs_ = pairs(core_->enabled);
  disabled_collision_pairs_ = pairs(core_->disabled);
  for (const auto& name : core_->passive_joints)
    passive_joints_.push_back({name});
  for (const auto& p : core_->joint_properties)
    joint_properties_[p.joint][p.property] = p.value;
}
}  // namespace srdf
