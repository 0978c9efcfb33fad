// The display of a planning scene: its robot and its objects.
#pragma once

#ifndef Q_MOC_RUN
#include <rviz/display.h>

#include <atomic>
#include <map>
#include <memory>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <string>

#include "jobs.hpp"
#include "robot_ghost.hpp"
#include "scene_view.hpp"
#endif

namespace rviz {
class BoolProperty;
class ColorProperty;
class EnumProperty;
class FloatProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace moveit_rviz_plugin {

// Waits for the robot on the parameter server and for move_group, in whichever order they come, and says in its status what
// it waits for.
class PlanningSceneDisplay : public rviz::Display {
 public:
  PlanningSceneDisplay();
  ~PlanningSceneDisplay() override;

  void load(const rviz::Config& config) override;
  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

  Jobs& jobs() { return jobs_; }
  rviz::DisplayContext* context() { return context_; }
  const planning_scene_monitor::PlanningSceneMonitorPtr& monitor() const { return monitor_; }
  // Null as long as there is none.
  moveit::core::RobotModelConstPtr model() const;
  std::string robotDescription() const;
  // A name of move_group's in its namespace.
  std::string named(const std::string& name) const;
  // The state of the scene's robot; a default state before the first message. Null without a robot.
  moveit::core::RobotStatePtr currentState() const;
  // The scene was changed here.
  void sceneEdited() { dirty_ = true; }
  // Objects in these colours, in this display only.
  void markObjects(const std::map<std::string, QColor>& marked) {
    marked_ = marked;
    dirty_ = true;
  }
  bool moveGroupThere() const { return move_group_there_; }

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;
  void fixedFrameChanged() override;

  // All called in the window's thread.
  virtual void robotLoaded() {}
  virtual void robotGone() {}
  virtual void moveGroupCame() {}
  virtual void moveGroupGone() {}
  virtual void sceneShown(const planning_scene::PlanningScene& /*scene*/) {}
  // Parent of everything that is drawn in the model's frame.
  Ogre::SceneNode* modelNode() { return model_node_; }
  void applyVisibility();

  Jobs jobs_;

 private:
  void makeSceneProperties();
  void makeRobotProperties();
  void startLoading();
  void loadInBackground(int generation, const std::string& description, const std::string& name);
  void adopt(const planning_scene_monitor::PlanningSceneMonitorPtr& monitor);
  void watchMoveGroup(int generation);
  void forget();
  void listen();
  void placeModel();
  void showScene();
  void tell(rviz::StatusProperty::Level level, const std::string& about, const std::string& text);

  rviz::StringProperty* move_group_ns_;
  rviz::StringProperty* robot_description_;
  rviz::RosTopicProperty* scene_topic_;
  rviz::Property* scene_category_;
  rviz::StringProperty* scene_name_;
  rviz::BoolProperty* scene_enabled_;
  rviz::FloatProperty* scene_alpha_;
  rviz::ColorProperty* scene_color_;
  rviz::EnumProperty* voxel_rendering_;
  rviz::EnumProperty* voxel_coloring_;
  rviz::FloatProperty* scene_display_time_;
  rviz::Property* robot_category_;
  rviz::BoolProperty* robot_visual_;
  rviz::BoolProperty* robot_collision_;
  rviz::FloatProperty* robot_alpha_;
  rviz::ColorProperty* attached_color_;

  planning_scene_monitor::PlanningSceneMonitorPtr monitor_;
  Ogre::SceneNode* model_node_ = nullptr;
  std::unique_ptr<SceneView> scene_view_;
  std::unique_ptr<RobotGhost> scene_robot_;
  std::atomic<int> generation_{0};
  std::atomic<bool> dirty_{false};
  bool move_group_there_ = false;
  float since_shown_ = 0.0f;
  std::map<std::string, QColor> marked_;
  Told told_waiting_, told_robot_;
};

}  // namespace moveit_rviz_plugin
