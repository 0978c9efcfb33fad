// A planned path, shown by a robot that goes along it, and as a trail of robots.
#pragma once

#include <moveit_msgs/DisplayTrajectory.h>
#include <ros/ros.h>

#include <QPointer>
#include <functional>
#include <memory>
#include <moveit/robot_state/robot_state.h>
#include <vector>

#include "robot_ghost.hpp"
#include "trajectory_panel.hpp"

namespace rviz {
class BoolProperty;
class ColorProperty;
class Display;
class EditableEnumProperty;
class FloatProperty;
class IntProperty;
class PanelDockWidget;
class RosTopicProperty;
}  // namespace rviz

namespace moveit_rviz_plugin {

class TrajectoryView : public QObject {
 public:
  // The properties are made below `parent`.
  TrajectoryView(rviz::Property* parent, rviz::Display* display);
  ~TrajectoryView() override;

  void initialize(Ogre::SceneNode* node, rviz::DisplayContext* context, const ros::NodeHandle& nh);
  // Null: none. `reference` gives the joints that paths do not name.
  void setModel(const moveit::core::RobotModelConstPtr& model, const std::function<moveit::core::RobotStatePtr()>& reference);
  void setEnabled(bool enabled);
  void update(float wall_dt, float ros_dt);
  // Nothing is shown any more, until the next path comes.
  void drop();
  void setTopic(const QString& topic);
  void rename(const QString& display_name);

 private:
  struct WayPoint {
    moveit::core::RobotStatePtr state;
    double from_previous = 0.0;  // s
  };
  void makeProperties(rviz::Property* parent);
  void makeColorProperties(rviz::Property* parent);
  void subscribe();
  void received(const moveit_msgs::DisplayTrajectory::ConstPtr& message);
  std::vector<WayPoint> wayPoints(const moveit_msgs::DisplayTrajectory& message) const;
  void begin();
  void showPosition();
  void showTrail();
  void applyStyle();
  void applyStyle(RobotGhost& robot, bool shown);
  double secondsTo(std::size_t waypoint) const;
  bool enabledAndThere() const { return enabled_ && model_; }

  rviz::Display* display_;
  rviz::Property* parent_;
  rviz::RosTopicProperty* topic_;
  rviz::BoolProperty* visual_;
  rviz::BoolProperty* collision_;
  rviz::FloatProperty* alpha_;
  rviz::EditableEnumProperty* display_time_;
  rviz::BoolProperty* sim_time_;
  rviz::BoolProperty* loop_;
  rviz::BoolProperty* trail_;
  rviz::IntProperty* trail_step_;
  rviz::BoolProperty* interrupt_;
  rviz::ColorProperty* color_;
  rviz::BoolProperty* color_enabled_;

  rviz::DisplayContext* context_ = nullptr;
  Ogre::SceneNode* node_ = nullptr;
  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;
  moveit::core::RobotModelConstPtr model_;
  std::function<moveit::core::RobotStatePtr()> reference_;
  std::unique_ptr<RobotGhost> robot_;
  std::vector<std::unique_ptr<RobotGhost>> trail_robots_;
  QPointer<TrajectoryPanel> panel_;
  rviz::PanelDockWidget* dock_ = nullptr;
  std::vector<WayPoint> path_, next_path_;
  std::size_t position_ = 0;
  double elapsed_ = 0.0;
  bool enabled_ = false, moving_ = false;
};

}  // namespace moveit_rviz_plugin
