#include "trajectory_view.hpp"

#include <moveit/robot_state/conversions.h>
#include <moveit/robot_trajectory/robot_trajectory.h>

#include <rviz/display.h>
#include <rviz/display_context.h>
#include <rviz/panel_dock_widget.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/editable_enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/robot/robot.h>
#include <rviz/window_manager_interface.h>

#include "properties.hpp"

namespace moveit_rviz_plugin {
namespace {
constexpr std::size_t MOST_ROBOTS = 200;  // of a trail
const char* const SLIDER_TITLE = " - Trajectory Slider";
}  // namespace

TrajectoryView::TrajectoryView(rviz::Property* parent, rviz::Display* display) : display_(display), parent_(parent) {
  makeProperties(parent);
  makeColorProperties(parent);
}

TrajectoryView::~TrajectoryView() {
  subscriber_.shutdown();
  trail_robots_.clear();
  robot_.reset();
  if (dock_) delete dock_;
  else delete panel_.data();
}

void TrajectoryView::makeProperties(rviz::Property* parent) {
  const auto style = [this]() { applyStyle(); };
  topic_ = when(new rviz::RosTopicProperty("Trajectory Topic", "move_group/display_planned_path",
                                           ros::message_traits::datatype<moveit_msgs::DisplayTrajectory>(),
                                           "Topic of planned paths", parent),
                this, [this]() { subscribe(); });
  visual_ = when(new rviz::BoolProperty("Show Robot Visual", true, "Show the robot's meshes", parent), this, style);
  collision_ = when(new rviz::BoolProperty("Show Robot Collision", false, "Show the shapes that collide", parent), this, style);
  alpha_ = when(new rviz::FloatProperty("Robot Alpha", 0.5f, "Opacity of the robot", parent), this, style);
  alpha_->setMin(0.0f);
  alpha_->setMax(1.0f);
  display_time_ = new rviz::EditableEnumProperty(
      "State Display Time", "3x", "Speed: as a factor of the path's own times (3x), or seconds for each way point (0.05s)",
      parent);
  for (const char* option : {"3x", "1x", "0.5x", "0.05s", "0.1s", "0.5s"}) display_time_->addOption(option);
  sim_time_ = new rviz::BoolProperty("Use Sim Time", false, "Simulation time in place of wall time", parent);
  loop_ = when(new rviz::BoolProperty("Loop Animation", false, "Show the last path again and again", parent), this, [this]() {
    if (loop_->getBool() && !path_.empty()) begin();
  });
  trail_ =
      when(new rviz::BoolProperty("Show Trail", false, "Show all way points at once", parent), this, [this]() { showTrail(); });
}

void TrajectoryView::makeColorProperties(rviz::Property* parent) {
  const auto style = [this]() { applyStyle(); };
  trail_step_ = when(new rviz::IntProperty("Trail Step Size", 1, "Every how many way points a robot is shown", parent), this,
                     [this]() { showTrail(); });
  trail_step_->setMin(1);
  interrupt_ =
      new rviz::BoolProperty("Interrupt Display", false, "Show a new path at once, not after the one that is shown", parent);
  color_ = when(new rviz::ColorProperty("Robot Color", QColor(150, 50, 150), "Of the robot on the path", parent), this, style);
  color_enabled_ = when(new rviz::BoolProperty("Color Enabled", false, "Whether that colour is used", parent), this, style);
}

void TrajectoryView::initialize(Ogre::SceneNode* node, rviz::DisplayContext* context, const ros::NodeHandle& nh) {
  node_ = node;
  context_ = context;
  nh_ = nh;
  robot_ = std::make_unique<RobotGhost>(node, context, "Planned Path", parent_);
  robot_->setVisible(false);
  panel_ = new TrajectoryPanel();
  panel_->moved = [this]() {
    if (path_.empty()) return;
    if (panel_->paused()) position_ = static_cast<std::size_t>(panel_->position());
    moving_ = true;
    elapsed_ = 0.0;
    showPosition();
  };
  if (rviz::WindowManagerInterface* window = context->getWindowManager())
    dock_ = window->addPane(display_->getName() + SLIDER_TITLE, panel_.data());
  if (dock_) QObject::connect(dock_, &QObject::destroyed, this, [this]() { dock_ = nullptr; });
}

void TrajectoryView::rename(const QString& display_name) {
  if (!dock_) return;
  dock_->setWindowTitle(display_name + SLIDER_TITLE);
  dock_->setObjectName(display_name + SLIDER_TITLE);  // by which RViz saves where it is
}

void TrajectoryView::setTopic(const QString& topic) { topic_->setString(topic); }

void TrajectoryView::setModel(const moveit::core::RobotModelConstPtr& model,
                              const std::function<moveit::core::RobotStatePtr()>& reference) {
  drop();
  model_ = model;
  reference_ = reference;
  if (!model) {
    robot_->clear();
    subscriber_.shutdown();
    return;
  }
  robot_->load(*model->getURDF());
  applyStyle();
  subscribe();
}

void TrajectoryView::setEnabled(bool enabled) {
  enabled_ = enabled;
  if (!enabled) {
    subscriber_.shutdown();
    drop();
  } else {
    subscribe();
  }
}

void TrajectoryView::subscribe() {
  subscriber_.shutdown();
  if (!enabledAndThere() || topic_->getTopicStd().empty()) return;
  try {
    subscriber_ = nh_.subscribe(topic_->getTopicStd(), 2, &TrajectoryView::received, this);
    display_->deleteStatus("Trajectory Topic");
  } catch (const ros::Exception& error) {
    display_->setStatusStd(rviz::StatusProperty::Error, "Trajectory Topic", error.what());
  }
}

// ---------------------------------------------------------------- paths

void TrajectoryView::received(const moveit_msgs::DisplayTrajectory::ConstPtr& message) {
  if (!model_) return;
  if (!message->model_id.empty() && message->model_id != model_->getName())
    display_->setStatusStd(rviz::StatusProperty::Warn, "Trajectory",
                           "The path is of robot '" + message->model_id + "', this is '" + model_->getName() + "'");
  else display_->deleteStatus("Trajectory");
  next_path_ = wayPoints(*message);
  if (next_path_.empty()) return;
  if (!moving_ || interrupt_->getBool()) {
    path_.swap(next_path_);
    next_path_.clear();
    begin();
  }
}

std::vector<TrajectoryView::WayPoint> TrajectoryView::wayPoints(const moveit_msgs::DisplayTrajectory& message) const {
  std::vector<WayPoint> points;
  moveit::core::RobotStatePtr start = reference_ ? reference_() : nullptr;
  if (!start) {
    start = std::make_shared<moveit::core::RobotState>(model_);
    start->setToDefaultValues();
  }
  moveit::core::robotStateMsgToRobotState(message.trajectory_start, *start);
  for (const moveit_msgs::RobotTrajectory& part : message.trajectory) {
    robot_trajectory::RobotTrajectory path(model_);
    path.setRobotTrajectoryMsg(points.empty() ? *start : *points.back().state, part);
    for (std::size_t i = 0; i < path.getWayPointCount(); ++i)
      points.push_back({path.getWayPointPtr(i), path.getWayPointDurationFromPrevious(i)});
  }
  return points;
}

void TrajectoryView::begin() {
  position_ = 0;
  elapsed_ = 0.0;
  moving_ = true;
  if (panel_) panel_->setWayPointCount(static_cast<int>(path_.size()));
  showTrail();
  showPosition();
}

void TrajectoryView::drop() {
  moving_ = false;
  path_.clear();
  next_path_.clear();
  trail_robots_.clear();
  if (robot_) robot_->setVisible(false);
  if (panel_) panel_->setWayPointCount(0);
}

// "3x": a factor; "0.05 s": a time; what cannot be read counts as 1x, and so does "REALTIME" of old files.
double TrajectoryView::secondsTo(std::size_t waypoint) const {
  const QString text = display_time_->getString().simplified().toLower().remove(' ');
  const bool seconds = text.endsWith('s');
  bool good = false;
  const double value = (seconds || text.endsWith('x') ? text.left(text.size() - 1) : text).toDouble(&good);
  if (seconds && good && value > 0.0) return value;
  return path_[waypoint].from_previous / (good && value > 0.0 ? value : 1.0);
}

void TrajectoryView::update(float wall_dt, float ros_dt) {
  if (!moving_ || path_.empty() || (panel_ && panel_->paused())) return;
  const std::size_t before = position_;
  elapsed_ += sim_time_->getBool() ? ros_dt : wall_dt;
  while (position_ + 1 < path_.size() && elapsed_ >= secondsTo(position_ + 1)) elapsed_ -= secondsTo(++position_);
  if (position_ + 1 < path_.size() || elapsed_ < 0.2) {  // the last state can be seen for a moment
    if (position_ != before) showPosition();
    return;
  }
  if (!next_path_.empty()) {
    path_.swap(next_path_);
    next_path_.clear();
    begin();
  } else if (loop_->getBool()) {
    position_ = 0;
    elapsed_ = 0.0;
    showPosition();
  } else {
    moving_ = false;
    robot_->setVisible(false);
  }
}

// ---------------------------------------------------------------- robots

void TrajectoryView::showPosition() {
  if (position_ >= path_.size()) return;
  if (panel_) panel_->setPosition(static_cast<int>(position_));
  if (!robot_->visible()) robot_->setVisible(true);
  robot_->show(*path_[position_].state);
}

void TrajectoryView::applyStyle(RobotGhost& robot, bool shown) {
  robot.setVisualVisible(visual_->getBool());
  robot.setCollisionVisible(collision_->getBool());
  robot.setAlpha(alpha_->getFloat());
  RobotGhost::LinkColors colors;
  if (color_enabled_->getBool())
    for (const std::string& link : model_->getLinkModelNames()) colors[link] = color_->getColor();
  robot.setColors(colors);
  robot.setVisible(shown);
}

void TrajectoryView::applyStyle() {
  if (!model_ || !robot_) return;
  applyStyle(*robot_, enabled_ && moving_);
  for (const auto& robot : trail_robots_) applyStyle(*robot, enabled_);
}

void TrajectoryView::showTrail() {
  trail_robots_.clear();
  if (!enabledAndThere() || !trail_->getBool() || path_.empty()) return;
  std::size_t step = static_cast<std::size_t>(trail_step_->getInt());
  if (path_.size() / step > MOST_ROBOTS) step = path_.size() / MOST_ROBOTS + 1;
  for (std::size_t i = 0; i < path_.size(); i += step) {
    trail_robots_.push_back(std::make_unique<RobotGhost>(node_, context_, "Trail " + std::to_string(i), nullptr));
    trail_robots_.back()->load(*model_->getURDF());
    applyStyle(*trail_robots_.back(), true);
    trail_robots_.back()->show(*path_[i].state);
  }
}

}  // namespace moveit_rviz_plugin
