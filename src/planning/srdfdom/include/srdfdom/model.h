// A semantic robot description (SRDF) as C++ programs read it: names, as they are written. What does not fit the URDF is
// found out, and said, when a robot is made of the two.
#ifndef SRDFDOM_MODEL_H
#define SRDFDOM_MODEL_H

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <tinyxml2.h>
#include <urdf/model.h>

namespace motion
{
struct Srdf;
}

namespace srdf
{
class Model
{
public:
  using PropertyMap = std::map<std::string, std::string>;
  using JointPropertyMap = std::map<std::string, PropertyMap>;  // by joint

  Model();
  ~Model();

  // All of these: false, and one line in the log, when the text is no SRDF; the model is empty then.
  bool initXml(const urdf::ModelInterface& urdf_model, tinyxml2::XMLElement* xml);
  bool initXml(const urdf::ModelInterface& urdf_model, tinyxml2::XMLDocument* xml);
  bool initFile(const urdf::ModelInterface& urdf_model, const std::string& filename);
  bool initString(const urdf::ModelInterface& urdf_model, const std::string& xmlstring);

  struct Group
  {
    std::string name_;
    std::vector<std::string> joints_, links_;
    std::vector<std::pair<std::string, std::string>> chains_;  // base link, tip link
    std::vector<std::string> subgroups_;
  };
  struct VirtualJoint
  {
    std::string name_, type_, parent_frame_, child_link_;
  };
  struct EndEffector
  {
    std::string name_, parent_link_, parent_group_, component_group_;
  };
  struct GroupState
  {
    std::string name_, group_;
    std::map<std::string, std::vector<double>> joint_values_;
  };
  struct Sphere
  {
    double center_x_, center_y_, center_z_, radius_;
  };
  struct LinkSpheres
  {
    std::string link_;
    std::vector<Sphere> spheres_;
  };
  struct CollisionPair
  {
    std::string link1_, link2_, reason_;
  };
  using DisabledCollision = CollisionPair;  // its name until Noetic
  struct PassiveJoint
  {
    std::string name_;
  };

  const std::string& getName() const { return name_; }
  const std::vector<std::string>& getNoDefaultCollisionLinks() const { return no_default_collision_links_; }
  const std::vector<CollisionPair>& getEnabledCollisionPairs() const { return enabled_collision_pairs_; }
  const std::vector<CollisionPair>& getDisabledCollisionPairs() const { return disabled_collision_pairs_; }
  const std::vector<Group>& getGroups() const { return groups_; }
  const std::vector<VirtualJoint>& getVirtualJoints() const { return virtual_joints_; }
  const std::vector<EndEffector>& getEndEffectors() const { return end_effectors_; }
  const std::vector<GroupState>& getGroupStates() const { return group_states_; }
  const std::vector<PassiveJoint>& getPassiveJoints() const { return passive_joints_; }
  const std::vector<LinkSpheres>& getLinkSphereApproximations() const { return link_sphere_approximations_; }
  const PropertyMap& getJointProperties(const std::string& joint_name) const;
  const JointPropertyMap& getJointProperties() const { return joint_properties_; }

  void clear();

  // The same description, as the motion library reads it; never null.
  const std::shared_ptr<const motion::Srdf>& core() const { return core_; }

private:
  void fill();

  std::shared_ptr<const motion::Srdf> core_;
  std::string name_;
  std::vector<Group> groups_;
  std::vector<GroupState> group_states_;
  std::vector<VirtualJoint> virtual_joints_;
  std::vector<EndEffector> end_effectors_;
  std::vector<LinkSpheres> link_sphere_approximations_;
  std::vector<std::string> no_default_collision_links_;
  std::vector<CollisionPair> enabled_collision_pairs_, disabled_collision_pairs_;
  std::vector<PassiveJoint> passive_joints_;
  JointPropertyMap joint_properties_;
};
typedef std::shared_ptr<Model> ModelSharedPtr;
typedef std::shared_ptr<const Model> ModelConstSharedPtr;
}  // namespace srdf

#endif
