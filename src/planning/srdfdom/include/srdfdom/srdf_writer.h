// An SRDF to change and write: fill the public lists, then ask for the text.
#ifndef SRDFDOM_SRDF_WRITER_H
#define SRDFDOM_SRDF_WRITER_H

#include <memory>

#include <srdfdom/model.h>

namespace srdf
{
class SRDFWriter
{
public:
  SRDFWriter();
  ~SRDFWriter();

  bool initString(const urdf::ModelInterface& robot_model, const std::string& srdf_string);
  void initModel(const urdf::ModelInterface& robot_model, const srdf::Model& srdf_model);
  // srdf_model_ made anew from the lists; throws std::runtime_error when they make no SRDF.
  void updateSRDFModel(const urdf::ModelInterface& robot_model);

  bool writeSRDF(const std::string& file_path);
  std::string getSRDFString();
  void generateSRDF(tinyxml2::XMLDocument& document);

  void createGroupsXML(tinyxml2::XMLElement* root);
  void createLinkSphereApproximationsXML(tinyxml2::XMLElement* root);
  void createCollisionDefaultsXML(tinyxml2::XMLElement* root);
  void createDisabledCollisionPairsXML(tinyxml2::XMLElement* root);
  void createGroupStatesXML(tinyxml2::XMLElement* root);
  void createEndEffectorsXML(tinyxml2::XMLElement* root);
  void createVirtualJointsXML(tinyxml2::XMLElement* root);
  void createPassiveJointsXML(tinyxml2::XMLElement* root);
  void createJointPropertiesXML(tinyxml2::XMLElement* root);

protected:
  void createCollisionPairsXML(tinyxml2::XMLElement* root, const char* tag_name,
                               const std::vector<Model::CollisionPair>& pairs);

public:
  std::vector<Model::Group> groups_;
  std::vector<Model::GroupState> group_states_;
  std::vector<Model::VirtualJoint> virtual_joints_;
  std::vector<Model::EndEffector> end_effectors_;
  std::vector<Model::LinkSpheres> link_sphere_approximations_;
  std::vector<std::string> no_default_collision_links_;
  std::vector<Model::CollisionPair> disabled_collision_pairs_, enabled_collision_pairs_;
  std::vector<Model::PassiveJoint> passive_joints_;
  Model::JointPropertyMap joint_properties_;

  ModelSharedPtr srdf_model_;
  std::string robot_name_;
};
typedef std::shared_ptr<SRDFWriter> SRDFWriterPtr;
}  // namespace srdf

#endif
