#include "robot_ghost.hpp"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/robot/link_updater.h>
#include <rviz/robot/robot.h>
#include <rviz/robot/robot_link.h>

namespace moveit_rviz_plugin {
namespace {
class Poses : public rviz::LinkUpdater {
 public:
  explicit Poses(const moveit::core::RobotState& state) : state_(state) {}
  bool getLinkTransforms(const std::string& name, Ogre::Vector3& visual_position, Ogre::Quaternion& visual_orientation,
                         Ogre::Vector3& collision_position, Ogre::Quaternion& collision_orientation) const override {
    bool there = false;
    const moveit::core::LinkModel* link = state_.getRobotModel()->getLinkModel(name, &there);
    if (!there || !link) return false;
    const Eigen::Isometry3d& pose = state_.getGlobalLinkTransform(link);
    visual_position = collision_position = toOgre(pose.translation());
    visual_orientation = collision_orientation = toOgre(Eigen::Quaterniond(pose.linear()));
    return true;
  }

 private:
  const moveit::core::RobotState& state_;
};
}  // namespace

RobotGhost::RobotGhost(Ogre::SceneNode* node, rviz::DisplayContext* context, const std::string& name, rviz::Property* parent)
    : context_(context),
      node_(node->createChildSceneNode()),
      bodies_node_(node_->createChildSceneNode()),
      robot_(std::make_unique<rviz::Robot>(node_, context, name, parent)) {}

RobotGhost::~RobotGhost() {
  bodies_.clear();
  robot_.reset();
  node_->getCreator()->destroySceneNode(bodies_node_);
  node_->getCreator()->destroySceneNode(node_);
}

std::string RobotGhost::load(const urdf::ModelInterface& urdf, bool visual, bool collision) {
  robot_->load(urdf, visual, collision);
  robot_->setAlpha(alpha_);
  robot_->setVisible(visible_);
  colors_.clear();
  loaded_ = true;
  std::string errors;
  for (const auto& item : robot_->getLinks()) {
    const std::string& error = item.second->getGeometryErrors();
    if (!error.empty()) errors += (errors.empty() ? "" : "; ") + item.first + ": " + error;
  }
  for (char& letter : errors)
    if (letter == '\n') letter = ' ';
  return errors;
}

void RobotGhost::clear() {
  bodies_.clear();
  robot_->clear();
  colors_.clear();
  loaded_ = false;
}

void RobotGhost::setVisible(bool visible) {
  visible_ = visible;
  robot_->setVisible(visible);
  bodies_node_->setVisible(visible);
}

void RobotGhost::setVisualVisible(bool visible) { robot_->setVisualVisible(visible); }
void RobotGhost::setCollisionVisible(bool visible) { robot_->setCollisionVisible(visible); }

void RobotGhost::setAlpha(float alpha) {
  alpha_ = alpha;
  robot_->setAlpha(alpha);
  colorBodies();
}

void RobotGhost::setAttachedColor(const QColor& color) {
  attached_color_ = color;
  colorBodies();
}

void RobotGhost::setColors(const LinkColors& colors) {
  if (colors == colors_) return;
  for (const auto& item : robot_->getLinks()) {
    const auto found = colors.find(item.first);
    if (found == colors.end()) {
      item.second->unsetColor();
      continue;
    }
    const QColor& color = found->second;
    item.second->setColor(static_cast<float>(color.redF()), static_cast<float>(color.greenF()),
                          static_cast<float>(color.blueF()));
  }
  colors_ = colors;
}

void RobotGhost::show(const moveit::core::RobotState& state) {
  if (!loaded_) return;
  robot_->update(Poses(state));
  showBodies(state);
}

void RobotGhost::showBodies(const moveit::core::RobotState& state) {
  std::vector<const moveit::core::AttachedBody*> attached;
  state.getAttachedBodies(attached);
  for (auto it = bodies_.begin(); it != bodies_.end();)
    it = state.hasAttachedBody(it->first) ? std::next(it) : bodies_.erase(it);
  bool added = false;
  for (const moveit::core::AttachedBody* body : attached) {
    Body& shown = bodies_[body->getName()];
    if (shown.shapes != body->getShapes()) {
      shown.shapes = body->getShapes();
      shown.views.clear();
      for (const shapes::ShapeConstPtr& shape : shown.shapes)
        shown.views.push_back(std::make_unique<ShapeView>(*shape, VoxelStyle(), context_->getSceneManager(), bodies_node_));
      added = true;
    }
    const EigenSTL::vector_Isometry3d& poses = body->getGlobalCollisionBodyTransforms();
    for (std::size_t i = 0; i < shown.views.size() && i < poses.size(); ++i) shown.views[i]->setPose(poses[i]);
  }
  if (!added) return;
  colorBodies();
  bodies_node_->setVisible(visible_);
}

void RobotGhost::colorBodies() {
  const Ogre::ColourValue color(static_cast<float>(attached_color_.redF()), static_cast<float>(attached_color_.greenF()),
                                static_cast<float>(attached_color_.blueF()), alpha_);
  for (auto& item : bodies_)
    for (auto& view : item.second.views) view->setColor(color);
}

}  // namespace moveit_rviz_plugin
