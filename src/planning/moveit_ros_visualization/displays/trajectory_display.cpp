#include "trajectory_display.hpp"

#include <rviz/properties/string_property.h>

#include "properties.hpp"

namespace moveit_rviz_plugin {

TrajectoryDisplay::TrajectoryDisplay() {
  robot_description_ =
      when(new rviz::StringProperty("Robot Description", "robot_description", "Parameter that holds the URDF", this), this,
           [this]() { reset(); });
  view_ = std::make_unique<TrajectoryView>(this, this);
}

TrajectoryDisplay::~TrajectoryDisplay() = default;

void TrajectoryDisplay::onInitialize() { view_->initialize(scene_node_, context_, update_nh_); }

void TrajectoryDisplay::forget() {
  if (robot_.model()) view_->setModel(nullptr, nullptr);
  robot_.clear();
}

void TrajectoryDisplay::onEnable() {
  view_->setEnabled(true);
  if (!robot_.model()) robot_.want(robot_description_->getStdString());
}

void TrajectoryDisplay::onDisable() {
  view_->setEnabled(false);
  robot_.stop();
}

void TrajectoryDisplay::reset() {
  Display::reset();
  if (!initialized() || !isEnabled()) return;
  forget();
  robot_.want(robot_description_->getStdString());
}

void TrajectoryDisplay::setTopic(const QString& topic, const QString& /*datatype*/) { view_->setTopic(topic); }

void TrajectoryDisplay::setName(const QString& name) {
  Display::setName(name);
  if (view_) view_->rename(name);
}

void TrajectoryDisplay::update(float wall_dt, float ros_dt) {
  if (robot_.update(wall_dt)) view_->setModel(robot_.model(), nullptr);
  if (robot_.place(scene_node_, context_, fixed_frame_)) view_->update(wall_dt, ros_dt);
}

}  // namespace moveit_rviz_plugin
