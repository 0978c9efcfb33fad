// A robot in a state of the library, as RViz draws robots, with what is attached to it.
#pragma once

#include <QColor>
#include <map>
#include <memory>
#include <moveit/robot_state/robot_state.h>
#include <string>
#include <vector>

#include "shape_view.hpp"

namespace Ogre {
class SceneNode;
}
namespace rviz {
class DisplayContext;
class Property;
class Robot;
}  // namespace rviz

namespace moveit_rviz_plugin {

class RobotGhost {
 public:
  using LinkColors = std::map<std::string, QColor>;

  // `parent` gets the property "Links"; it may be null.
  RobotGhost(Ogre::SceneNode* node, rviz::DisplayContext* context, const std::string& name, rviz::Property* parent);
  ~RobotGhost();

  // Meshes and shapes; what could not be loaded, link by link, is returned in one line, "" if all could.
  std::string load(const urdf::ModelInterface& urdf, bool visual = true, bool collision = true);
  void clear();
  bool loaded() const { return loaded_; }

  void setVisible(bool visible);
  void setVisualVisible(bool visible);
  void setCollisionVisible(bool visible);
  bool visible() const { return visible_; }
  void setAlpha(float alpha);
  void setAttachedColor(const QColor& color);
  // Those links that are named; all others get their own colours back. Nothing is done if nothing changed.
  void setColors(const LinkColors& colors);

  // Where the state has the links; in the frame of the node.
  void show(const moveit::core::RobotState& state);
  rviz::Robot& robot() { return *robot_; }

 private:
  struct Body {
    std::vector<shapes::ShapeConstPtr> shapes;
    std::vector<std::unique_ptr<ShapeView>> views;
  };
  void showBodies(const moveit::core::RobotState& state);
  void colorBodies();

  rviz::DisplayContext* context_;
  Ogre::SceneNode* node_;
  Ogre::SceneNode* bodies_node_;
  std::unique_ptr<rviz::Robot> robot_;
  std::map<std::string, Body> bodies_;
  LinkColors colors_;
  QColor attached_color_{150, 50, 150};
  float alpha_ = 1.0f;
  bool loaded_ = false, visible_ = true;
};

}  // namespace moveit_rviz_plugin
