// How well the goal's hand can be moved, as a text beside it.
#include <Eigen/SVD>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>

#include "motion_planning_display.hpp"
#include "properties.hpp"

namespace moveit_rviz_plugin {
namespace {
// Product and ratio (smallest by largest) of the singular values of the Jacobian.
std::pair<double, double> manipulability(const moveit::core::RobotState& state, const Tip& tip) {
  const moveit::core::JointModelGroup* group = state.getJointModelGroup(tip.group);
  const moveit::core::LinkModel* link = state.getLinkModel(tip.link);
  Eigen::MatrixXd jacobian;
  if (!group->isChain() || !group->hasLinkModel(tip.link) || !state.getJacobian(group, link, Eigen::Vector3d::Zero(), jacobian))
    return {0.0, 0.0};
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian).singularValues();
  if (values.size() == 0 || values[0] <= 0.0) return {0.0, 0.0};
  return {values.prod(), values[values.size() - 1] / values[0]};
}
}  // namespace

void MotionPlanningDisplay::makeMetricsProperties(rviz::Property* category) {
  const auto redraw = [this]() { queries_[GOAL].dirty = true; };
  const auto missing = [this](rviz::BoolProperty* property) {
    when(property, this, [this, property]() {
      if (property->getBool())
        setStatus(rviz::StatusProperty::Warn, property->getName(), "Needs the robot's dynamics, which are not computed here");
      else deleteStatus(property->getName());
    });
  };
  missing(new rviz::BoolProperty("Show Weight Limit", false, "Not computed here", category));
  manipulability_index_ = when(new rviz::BoolProperty("Show Manipulability Index", false,
                                                      "Product of the singular values of the "
                                                      "goal's Jacobian",
                                                      category),
                               this, redraw);
  manipulability_ = when(
      new rviz::BoolProperty("Show Manipulability", false, "Smallest singular value by the largest", category), this, redraw);
  missing(new rviz::BoolProperty("Show Joint Torques", false, "Not computed here", category));
  payload_ = new rviz::FloatProperty("Payload", 1.0f, "In the hand, kg", category);
  payload_->setMin(0.0f);
  text_height_ = when(new rviz::FloatProperty("TextHeight", 0.08f, "Of the text, m", category), this, redraw);
  text_height_->setMin(0.001f);
}

void MotionPlanningDisplay::fillMetrics() {
  const Query& goal = queries_[GOAL];
  const bool wanted = manipulability_index_->getBool() || manipulability_->getBool();
  const bool possible = wanted && goal.state && goal.shown->getBool() && !tips_.empty() && isEnabled();
  if (!possible) {
    if (text_node_) text_node_->setVisible(false);
    return;
  }
  const std::pair<double, double> values = manipulability(*goal.state, tips_.front());
  QString text;
  if (manipulability_index_->getBool()) text += QString("manipulability index %1\n").arg(values.first, 0, 'g', 3);
  if (manipulability_->getBool()) text += QString("manipulability %1").arg(values.second, 0, 'g', 3);
  if (!text_node_) {
    text_node_ = modelNode()->createChildSceneNode();
    text_ = std::make_unique<rviz::MovableText>(text.toStdString());
    text_->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_ABOVE);
    text_node_->attachObject(text_.get());
  }
  text_->setCaption(text.trimmed().toStdString());
  text_->setCharacterHeight(text_height_->getFloat());
  const Eigen::Vector3d tip = goal.state->getGlobalLinkTransform(tips_.front().link).translation();
  text_node_->setPosition(toOgre(tip + Eigen::Vector3d(0.0, 0.0, 2.0 * text_height_->getFloat())));
  text_node_->setVisible(true);
}

void MotionPlanningDisplay::dropMetrics() {
  if (text_node_) text_node_->detachAllObjects();
  text_.reset();
}

}  // namespace moveit_rviz_plugin
