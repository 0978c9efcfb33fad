// The objects of a planning scene, octomap included.
#pragma once

#include <QColor>
#include <map>
#include <memory>
#include <moveit/planning_scene/planning_scene.h>
#include <string>
#include <vector>

#include "shape_view.hpp"

namespace moveit_rviz_plugin {

class SceneView {
 public:
  struct Style {
    QColor color{50, 230, 50};  // of objects without a colour of their own
    float alpha = 1.0f;
    std::map<std::string, QColor> marked;  // before all other colours
    VoxelStyle voxels;
  };

  SceneView(Ogre::SceneManager* scene_manager, Ogre::SceneNode* parent);
  ~SceneView();

  void setVisible(bool visible);
  // What is as it was before is left as it is; only new and changed objects are made.
  void show(const planning_scene::PlanningScene& scene, const Style& style);
  void clear() { shown_.clear(); }

 private:
  struct Object {
    std::vector<shapes::ShapeConstPtr> shapes;
    std::vector<std::unique_ptr<ShapeView>> views;
    VoxelStyle voxels;
  };

  Ogre::SceneManager* scene_manager_;
  Ogre::SceneNode* node_;
  std::map<std::string, Object> shown_;
  bool visible_ = true;
};

}  // namespace moveit_rviz_plugin
