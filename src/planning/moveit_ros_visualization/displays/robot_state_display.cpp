#include "robot_state_display.hpp"

#include <moveit/robot_state/conversions.h>

#include <rviz/display_context.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/robot/robot.h>
#include <rviz/robot/robot_link.h>

#include "properties.hpp"

namespace moveit_rviz_plugin {

RobotStateDisplay::RobotStateDisplay() {
  const auto style = [this]() { applyStyle(); };
  robot_description_ =
      when(new rviz::StringProperty("Robot Description", "robot_description", "Parameter that holds the URDF", this), this,
           [this]() { reset(); });
  topic_ = when(new rviz::RosTopicProperty("Robot State Topic", "display_robot_state",
                                           ros::message_traits::datatype<moveit_msgs::DisplayRobotState>(),
                                           "Topic of the states to show", this),
                this, [this]() { subscribe(); });
  root_link_ = new rviz::StringProperty("Robot Root Link", "", "Root link of the robot", this);
  root_link_->setReadOnly(true);
  alpha_ = when(new rviz::FloatProperty("Robot Alpha", 1.0f, "Opacity of the robot", this), this, style);
  alpha_->setMin(0.0f);
  alpha_->setMax(1.0f);
  attached_color_ =
      when(new rviz::ColorProperty("Attached Body Color", QColor(150, 50, 150), "Of attached objects", this), this, style);
  highlights_ = when(new rviz::BoolProperty("Show Highlights", true, "Use the colours of the message", this), this, style);
  visual_ = when(new rviz::BoolProperty("Visual Enabled", true, "Show the robot's meshes", this), this, style);
  collision_ = when(new rviz::BoolProperty("Collision Enabled", false, "Show the shapes that collide", this), this, style);
  all_links_ = when(new rviz::BoolProperty("Show All Links", true, "All links, or none", this), this, [this]() {
    if (!ghost_) return;
    for (const auto& link : ghost_->robot().getLinks()) link.second->getLinkProperty()->setValue(all_links_->getBool());
  });
}

RobotStateDisplay::~RobotStateDisplay() { subscriber_.shutdown(); }

void RobotStateDisplay::onInitialize() { ghost_ = std::make_unique<RobotGhost>(scene_node_, context_, "Robot State", this); }

void RobotStateDisplay::onEnable() {
  if (!robot_.model()) robot_.want(robot_description_->getStdString());
  subscribe();
  applyStyle();
}

void RobotStateDisplay::onDisable() {
  subscriber_.shutdown();
  robot_.stop();
  if (ghost_) ghost_->setVisible(false);
}

void RobotStateDisplay::reset() {
  Display::reset();
  if (!initialized() || !isEnabled()) return;
  state_.reset();
  ghost_->clear();
  robot_.want(robot_description_->getStdString());
}

void RobotStateDisplay::setTopic(const QString& topic, const QString& /*datatype*/) { topic_->setString(topic); }

void RobotStateDisplay::subscribe() {
  subscriber_.shutdown();
  if (!initialized() || !isEnabled() || !robot_.model() || topic_->getTopicStd().empty()) return;
  subscriber_ = update_nh_.subscribe(topic_->getTopicStd(), 10, &RobotStateDisplay::received, this);
}

void RobotStateDisplay::received(const moveit_msgs::DisplayRobotState::ConstPtr& message) {
  if (!state_) return;
  highlighted_.clear();
  std::string unknown;
  for (const moveit_msgs::ObjectColor& entry : message->highlight_links) {
    const auto part = [](float value) { return static_cast<int>(255 * std::min(1.0f, std::max(0.0f, value))); };
    if (!robot_.model()->hasLinkModel(entry.id)) unknown = entry.id;
    highlighted_[entry.id] = QColor(part(entry.color.r), part(entry.color.g), part(entry.color.b));
  }
  hidden_ = message->hide;
  const bool good = moveit::core::robotStateMsgToRobotState(message->state, *state_);
  if (!good) setStatus(rviz::StatusProperty::Error, "RobotState", "The state of the message does not fit this robot");
  else if (!unknown.empty())
    setStatusStd(rviz::StatusProperty::Warn, "RobotState", "The robot has no link '" + unknown + "', which is highlighted");
  else setStatus(rviz::StatusProperty::Ok, "RobotState", "");
  applyStyle();
  ghost_->show(*state_);
}

void RobotStateDisplay::applyStyle() {
  if (!ghost_ || !ghost_->loaded()) return;
  ghost_->setAlpha(alpha_->getFloat());
  ghost_->setAttachedColor(attached_color_->getColor());
  ghost_->setColors(highlights_->getBool() ? highlighted_ : RobotGhost::LinkColors());
  ghost_->setVisualVisible(visual_->getBool());
  ghost_->setCollisionVisible(collision_->getBool());
  ghost_->setVisible(isEnabled() && !hidden_);
}

void RobotStateDisplay::update(float wall_dt, float /*ros_dt*/) {
  if (robot_.update(wall_dt)) {
    state_ = std::make_shared<moveit::core::RobotState>(robot_.model());
    state_->setToDefaultValues();
    root_link_->setStdString(robot_.model()->getRootLinkName());
    ghost_->load(*robot_.model()->getURDF());
    highlighted_.clear();
    applyStyle();
    ghost_->show(*state_);
    subscribe();
  }
  robot_.place(scene_node_, context_, fixed_frame_);
}

}  // namespace moveit_rviz_plugin
