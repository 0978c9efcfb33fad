#include "srdfdom/srdf_writer.h"

#include <initializer_list>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace srdf
{
namespace
{
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

XMLElement* add(XMLElement* parent, const char* tag, std::initializer_list<std::pair<const char*, std::string>> attributes)
{
  XMLElement* element = parent->GetDocument()->NewElement(tag);
  for (const auto& a : attributes)
    element->SetAttribute(a.first, a.second.c_str());
  parent->InsertEndChild(element);
  return element;
}

void comment(XMLElement* root, const char* text) { root->InsertEndChild(root->GetDocument()->NewComment(text)); }

std::string numbers(std::initializer_list<double> values)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(12);
  const char* separator = "";
  for (double value : values)
  {
    out << separator << value;
    separator = " ";
  }
  return out.str();
}

std::string numbers(const std::vector<double>& values)
{
  std::string out;
  for (double value : values)
    out += (out.empty() ? "" : " ") + numbers({value});
  return out;
}
}  // namespace

SRDFWriter::SRDFWriter() : srdf_model_(std::make_shared<Model>()) {}
SRDFWriter::~SRDFWriter() = default;

bool SRDFWriter::initString(const urdf::ModelInterface& robot_model, const std::string& srdf_string)
{
  auto model = std::make_shared<Model>();
  if (!model->initString(robot_model, srdf_string))
    return false;
  initModel(robot_model, *model);
  return true;
}

void SRDFWriter::initModel(const urdf::ModelInterface& robot_model, const srdf::Model& srdf_model)
{
  srdf_model_ = std::make_shared<Model>(srdf_model);
  no_default_collision_links_ = srdf_model.getNoDefaultCollisionLinks();
  disabled_collision_pairs_ = srdf_model.getDisabledCollisionPairs();
  enabled_collision_pairs_ = srdf_model.getEnabledCollisionPairs();
  link_sphere_approximations_ = srdf_model.getLinkSphereApproximations();
  groups_ = srdf_model.getGroups();
  virtual_joints_ = srdf_model.getVirtualJoints();
  end_effectors_ = srdf_model.getEndEffectors();
  group_states_ = srdf_model.getGroupStates();
  passive_joints_ = srdf_model.getPassiveJoints();
  joint_properties_ = srdf_model.getJointProperties();
  robot_name_ = robot_model.getName();
}

void SRDFWriter::updateSRDFModel(const urdf::ModelInterface& robot_model)
{
  if (!srdf_model_->initString(robot_model, getSRDFString()))
    throw std::runtime_error("Unable to update the SRDF Model");
}

bool SRDFWriter::writeSRDF(const std::string& file_path)
{
  XMLDocument document;
  generateSRDF(document);
  return document.SaveFile(file_path.c_str()) == tinyxml2::XML_SUCCESS;
}

std::string SRDFWriter::getSRDFString()
{
  XMLDocument document;
  generateSRDF(document);
  tinyxml2::XMLPrinter printer;
  document.Accept(&printer);
  return printer.CStr();
}

void SRDFWriter::generateSRDF(XMLDocument& document)
{
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* root = document.NewElement("robot");
  root->SetAttribute("name", robot_name_.c_str());
  document.InsertEndChild(root);
  createGroupsXML(root);
  createGroupStatesXML(root);
  createEndEffectorsXML(root);
  createVirtualJointsXML(root);
  createPassiveJointsXML(root);
  createJointPropertiesXML(root);
  createLinkSphereApproximationsXML(root);
  createCollisionDefaultsXML(root);
  createCollisionPairsXML(root, "enable_collisions", enabled_collision_pairs_);
  createDisabledCollisionPairsXML(root);
}

void SRDFWriter::createGroupsXML(XMLElement* root)
{
  if (!groups_.empty())
    comment(root,
            "GROUPS: sets of joints and links that are planned for together; by links (their parent joints), joints, "
            "a chain between two links, or other groups");
  for (const auto& group : groups_)
  {
    XMLElement* element = add(root, "group", {{"name", group.name_}});
    for (const auto& link : group.links_)
      add(element, "link", {{"name", link}});
    for (const auto& joint : group.joints_)
      add(element, "joint", {{"name", joint}});
    for (const auto& chain : group.chains_)
      add(element, "chain", {{"base_link", chain.first}, {"tip_link", chain.second}});
    for (const auto& subgroup : group.subgroups_)
      add(element, "group", {{"name", subgroup}});
  }
}

void SRDFWriter::createGroupStatesXML(XMLElement* root)
{
  if (!group_states_.empty())
    comment(root, "GROUP STATES: named joint values of a group");
  for (const auto& state : group_states_)
  {
    XMLElement* element = add(root, "group_state", {{"name", state.name_}, {"group", state.group_}});
    for (const auto& joint : state.joint_values_)
      add(element, "joint", {{"name", joint.first}, {"value", numbers(joint.second)}});
  }
}

void SRDFWriter::createEndEffectorsXML(XMLElement* root)
{
  if (!end_effectors_.empty())
    comment(root, "END EFFECTOR: what a group of links is to the arm that carries it");
  for (const auto& effector : end_effectors_)
  {
    XMLElement* element =
        add(root, "end_effector",
            {{"name", effector.name_}, {"parent_link", effector.parent_link_}, {"group", effector.component_group_}});
    if (!effector.parent_group_.empty())
      element->SetAttribute("parent_group", effector.parent_group_.c_str());
  }
}

void SRDFWriter::createVirtualJointsXML(XMLElement* root)
{
  if (!virtual_joints_.empty())
    comment(root, "VIRTUAL JOINT: between the robot and the frame outside that it stands or moves in");
  for (const auto& joint : virtual_joints_)
    add(root, "virtual_joint",
        {{"name", joint.name_},
         {"type", joint.type_},
         {"parent_frame", joint.parent_frame_},
         {"child_link", joint.child_link_}});
}

void SRDFWriter::createPassiveJointsXML(XMLElement* root)
{
  if (!passive_joints_.empty())
    comment(root, "PASSIVE JOINT: one without a motor");
  for (const auto& joint : passive_joints_)
    add(root, "passive_joint", {{"name", joint.name_}});
}

void SRDFWriter::createJointPropertiesXML(XMLElement* root)
{
  if (!joint_properties_.empty())
    comment(root, "JOINT PROPERTIES: what planners want to know of a joint");
  for (const auto& joint : joint_properties_)
    for (const auto& property : joint.second)
      add(root, "joint_property", {{"joint_name", joint.first}, {"property_name", property.first}, {"value", property.second}});
}

void SRDFWriter::createLinkSphereApproximationsXML(XMLElement* root)
{
  for (const auto& link : link_sphere_approximations_)
  {
    if (link.spheres_.empty())
      continue;
    XMLElement* element = add(root, "link_sphere_approximation", {{"link", link.link_}});
    for (const auto& s : link.spheres_)
      add(element, "sphere", {{"center", numbers({s.center_x_, s.center_y_, s.center_z_})}, {"radius", numbers({s.radius_})}});
  }
}

void SRDFWriter::createCollisionDefaultsXML(XMLElement* root)
{
  if (!no_default_collision_links_.empty())
    comment(root, "DEFAULT COLLISIONS: links that are not checked against others unless enabled below");
  for (const auto& link : no_default_collision_links_)
    add(root, "disable_default_collisions", {{"link", link}});
}

void SRDFWriter::createDisabledCollisionPairsXML(XMLElement* root)
{
  if (!disabled_collision_pairs_.empty())
    comment(root, "DISABLE COLLISIONS: pairs of links that may touch, or never do");
  createCollisionPairsXML(root, "disable_collisions", disabled_collision_pairs_);
}

void SRDFWriter::createCollisionPairsXML(XMLElement* root, const char* tag_name, const std::vector<Model::CollisionPair>& pairs)
{
  for (const auto& pair : pairs)
    add(root, tag_name, {{"link1", pair.link1_}, {"link2", pair.link2_}, {"reason", pair.reason_}});
}
}  // namespace srdf
