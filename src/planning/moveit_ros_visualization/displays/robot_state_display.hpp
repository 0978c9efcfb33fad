// The display of one state of the robot, from a topic.
#pragma once

#include <moveit_msgs/DisplayRobotState.h>

#include <rviz/display.h>

#include "robot_ghost.hpp"
#include "robot_parameter.hpp"

namespace rviz {
class BoolProperty;
class ColorProperty;
class FloatProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace moveit_rviz_plugin {

class RobotStateDisplay : public rviz::Display {
 public:
  RobotStateDisplay();
  ~RobotStateDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private:
  void subscribe();
  void received(const moveit_msgs::DisplayRobotState::ConstPtr& message);
  void applyStyle();

  rviz::StringProperty* robot_description_;
  rviz::RosTopicProperty* topic_;
  rviz::StringProperty* root_link_;
  rviz::FloatProperty* alpha_;
  rviz::ColorProperty* attached_color_;
  rviz::BoolProperty* highlights_;
  rviz::BoolProperty* visual_;
  rviz::BoolProperty* collision_;
  rviz::BoolProperty* all_links_;

  RobotParameter robot_{this};
  std::unique_ptr<RobotGhost> ghost_;
  moveit::core::RobotStatePtr state_;
  RobotGhost::LinkColors highlighted_;
  ros::Subscriber subscriber_;
  bool hidden_ = false;
};

}  // namespace moveit_rviz_plugin
