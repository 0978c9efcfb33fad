#include "scene_view.hpp"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

namespace moveit_rviz_plugin {

SceneView::SceneView(Ogre::SceneManager* scene_manager, Ogre::SceneNode* parent)
    : scene_manager_(scene_manager), node_(parent->createChildSceneNode()) {}

SceneView::~SceneView() {
  clear();
  scene_manager_->destroySceneNode(node_);
}

void SceneView::setVisible(bool visible) {
  visible_ = visible;
  node_->setVisible(visible);
}

void SceneView::show(const planning_scene::PlanningScene& scene, const Style& style) {
  const collision_detection::World& world = *scene.getWorld();
  for (auto it = shown_.begin(); it != shown_.end();) it = world.hasObject(it->first) ? std::next(it) : shown_.erase(it);
  for (const auto& item : world) {
    const collision_detection::World::Object& object = *item.second;
    Object& shown = shown_[item.first];
    if (shown.shapes != object.shapes_ || !(shown.voxels == style.voxels)) {
      shown.shapes = object.shapes_;
      shown.voxels = style.voxels;
      shown.views.clear();
      for (const shapes::ShapeConstPtr& shape : object.shapes_)
        shown.views.push_back(std::make_unique<ShapeView>(*shape, style.voxels, scene_manager_, node_));
    }
    Ogre::ColourValue color(static_cast<float>(style.color.redF()), static_cast<float>(style.color.greenF()),
                            static_cast<float>(style.color.blueF()), style.alpha);
    if (scene.hasObjectColor(item.first)) {
      const std_msgs::ColorRGBA& own = scene.getObjectColor(item.first);
      color = Ogre::ColourValue(own.r, own.g, own.b, own.a * style.alpha);
    }
    const auto marked = style.marked.find(item.first);
    if (marked != style.marked.end())
      color = Ogre::ColourValue(static_cast<float>(marked->second.redF()), static_cast<float>(marked->second.greenF()),
                                static_cast<float>(marked->second.blueF()), 1.0f);
    for (std::size_t i = 0; i < shown.views.size(); ++i) {
      shown.views[i]->setPose(object.global_shape_poses_[i]);
      shown.views[i]->setColor(color);
    }
  }
  node_->setVisible(visible_);
}

}  // namespace moveit_rviz_plugin
