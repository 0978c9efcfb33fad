#include "motion/srdf.hpp"

#include <tinyxml2.h>

#include <sstream>

namespace motion
{
namespace
{
using tinyxml2::XMLElement;

class Reader
{
public:
  Reader(Srdf& srdf, std::vector<std::string>& warnings) : srdf_(srdf), warnings_(warnings) {}

  void read(const XMLElement& root)
  {
    if (const char* name = root.Attribute("name"))
      srdf_.name = name;
    for (const XMLElement* e = root.FirstChildElement(); e; e = e->NextSiblingElement())
      element(*e);
  }

private:
  void element(const XMLElement& e)
  {
    const std::string tag = e.Name();
    if (tag == "group")
      group(e);
    else if (tag == "group_state")
      state(e);
    else if (tag == "end_effector")
      endEffector(e);
    else if (tag == "virtual_joint")
      virtualJoint(e);
    else if (tag == "passive_joint")
      one(e, "name", srdf_.passive_joints);
    else if (tag == "disable_default_collisions")
      one(e, "link", srdf_.no_default_collision);
    else if (tag == "disable_collisions")
      pair(e, srdf_.disabled);
    else if (tag == "enable_collisions")
      pair(e, srdf_.enabled);
    else if (tag == "joint_property")
      property(e);
    else if (tag == "link_sphere_approximation")
      spheres(e);
  }

  // The attribute, or "" and a warning that the element is left out.
  std::string need(const XMLElement& e, const char* attribute)
  {
    const char* value = e.Attribute(attribute);
    if (value && *value)
      return value;
    warn(e, std::string("has no ") + attribute + "; left out");
    return "";
  }

  static std::string maybe(const XMLElement& e, const char* attribute)
  {
    const char* value = e.Attribute(attribute);
    return value ? value : "";
  }

  void warn(const XMLElement& e, const std::string& what)
  {
    warnings_.push_back("SRDF line " + std::to_string(e.GetLineNum()) + ": <" + e.Name() + "> " + what);
  }

  void one(const XMLElement& e, const char* attribute, std::vector<std::string>& into)
  {
    const std::string value = need(e, attribute);
    if (!value.empty())
      into.push_back(value);
  }

  void pair(const XMLElement& e, std::vector<Srdf::LinkPair>& into)
  {
    Srdf::LinkPair pair{need(e, "link1"), need(e, "link2"), maybe(e, "reason")};
    if (!pair.link1.empty() && !pair.link2.empty())
      into.push_back(pair);
  }

  void group(const XMLElement& e)
  {
    Srdf::Group group;
    group.name = need(e, "name");
    if (group.name.empty())
      return;
    for (const XMLElement* c = e.FirstChildElement(); c; c = c->NextSiblingElement())
    {
      const std::string tag = c->Name();
      if (tag == "joint")
        one(*c, "name", group.joints);
      else if (tag == "link")
        one(*c, "name", group.links);
      else if (tag == "group")
        one(*c, "name", group.subgroups);
      else if (tag == "chain")
      {
        const std::string base = need(*c, "base_link"), tip = need(*c, "tip_link");
        if (!base.empty() && !tip.empty())
          group.chains.emplace_back(base, tip);
      }
    }
    srdf_.groups.push_back(group);
  }

  void state(const XMLElement& e)
  {
    Srdf::GroupState state;
    state.name = need(e, "name");
    state.group = need(e, "group");
    if (state.name.empty() || state.group.empty())
      return;
    for (const XMLElement* c = e.FirstChildElement("joint"); c; c = c->NextSiblingElement("joint"))
    {
      const std::string name = need(*c, "name"), text = need(*c, "value");
      std::istringstream stream(text);
      stream.imbue(std::locale::classic());
      std::vector<double> values;
      double value;
      while (stream >> value)
        values.push_back(value);
      if (!stream.eof() || values.empty())
        warn(*c, "of state '" + state.name + "': '" + text.substr(0, 40) + "' is not a number; joint '" + name + "' left out");
      else if (!name.empty())
        state.joints[name] = values;
    }
    srdf_.states.push_back(state);
  }

  void endEffector(const XMLElement& e)
  {
    Srdf::EndEffector effector{need(e, "name"), need(e, "group"), need(e, "parent_link"), maybe(e, "parent_group")};
    if (!effector.name.empty() && !effector.group.empty() && !effector.parent_link.empty())
      srdf_.end_effectors.push_back(effector);
  }

  void virtualJoint(const XMLElement& e)
  {
    Srdf::VirtualJoint joint;
    joint.name = need(e, "name");
    joint.type = maybe(e, "type");
    joint.parent_frame = maybe(e, "parent_frame");
    joint.child_link = need(e, "child_link");
    if (joint.name.empty() || joint.child_link.empty())
      return;
    if (joint.type != "fixed" && joint.type != "planar" && joint.type != "floating")
    {
      warn(e, "'" + joint.name + "': type '" + joint.type + "' is none of fixed, planar, floating; taken as fixed");
      joint.type = "fixed";
    }
    srdf_.virtual_joints.push_back(joint);
  }

  void property(const XMLElement& e)
  {
    Srdf::JointProperty property{need(e, "joint_name"), need(e, "property_name"), need(e, "value")};
    if (!property.joint.empty() && !property.property.empty() && !property.value.empty())
      srdf_.joint_properties.push_back(property);
  }

  void spheres(const XMLElement& e)
  {
    Srdf::SphereApproximation approximation;
    approximation.link = need(e, "link");
    for (const XMLElement* c = e.FirstChildElement("sphere"); c; c = c->NextSiblingElement("sphere"))
    {
      std::istringstream centre(maybe(*c, "center"));
      centre.imbue(std::locale::classic());
      Vector3 p;
      double radius = 0;
      if (centre >> p.x() >> p.y() >> p.z() && c->QueryDoubleAttribute("radius", &radius) == tinyxml2::XML_SUCCESS)
        approximation.spheres.emplace_back(p, radius);
      else
        warn(*c, "needs center=\"x y z\" and radius; left out");
    }
    if (!approximation.link.empty())
      srdf_.spheres.push_back(approximation);
  }

  Srdf& srdf_;
  std::vector<std::string>& warnings_;
};
}  // namespace

Srdf Srdf::parse(const std::string& text, std::vector<std::string>& warnings)
{
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS)
    throw ModelError("SRDF is not well-formed XML near line " + std::to_string(document.ErrorLineNum()) + " (" +
                     tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID()) + ")");
  const XMLElement* root = document.FirstChildElement("robot");
  if (!root)
    throw ModelError("SRDF has no <robot> element at its root");
  Srdf srdf;
  Reader(srdf, warnings).read(*root);
  return srdf;
}
}  // namespace motion
