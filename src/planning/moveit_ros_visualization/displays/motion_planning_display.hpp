// The display MotionPlanning: a planning scene, the start and the goal of a query that are dragged, the planned path, and the
// panel that plans and moves.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>

#include <QPointer>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "drag_markers.hpp"
#include "ik_follower.hpp"
#include "scene_display.hpp"
#include "trajectory_view.hpp"

namespace rviz {
class MovableText;
class PanelDockWidget;
class Shape;
}  // namespace rviz

namespace moveit_rviz_plugin {
class Dock;

enum Which { START, GOAL };

class MotionPlanningDisplay : public PlanningSceneDisplay {
 public:
  MotionPlanningDisplay();
  ~MotionPlanningDisplay() override;

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;
  void update(float wall_dt, float ros_dt) override;
  void setName(const QString& name) override;

  // ------------------------------------------------------------ for the panel; in the window's thread
  std::string group() const;
  void setGroup(const std::string& name);
  // Copies. Null without a robot.
  moveit::core::RobotStatePtr query(Which which) const;
  void setQuery(Which which, const moveit::core::RobotState& state);
  // The start of the last plan.
  moveit::core::RobotStatePtr previous() const { return previous_; }
  void rememberStart() { previous_ = query(START); }
  bool shown(Which which) const;
  const std::vector<Tip>& tips() const { return tips_; }
  void dropPath() { path_->drop(); }
  // Centre and edges of a box in the model frame, m.
  void setWorkspace(const Eigen::Vector3d& centre, const Eigen::Vector3d& size);
  void setCollisionAwareIk(bool on) { collision_aware_ = on; }
  void setApproximateIk(bool on) { approximate_ = on; }
  // /rviz/moveit/move_marker/{start,goal}_<link>
  void setMarkerTopics(bool on);
  // A marker of the panel, for an object that is moved; "" takes it away.
  void setObjectMarker(const std::string& id, const Eigen::Isometry3d& pose, double size);
  void moveObjectMarker(const Eigen::Isometry3d& pose);
  // Where an object may be put down, m in the model frame.
  void showPlaces(const std::vector<Eigen::Vector3d>& places);

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;
  void fixedFrameChanged() override;
  void robotLoaded() override;
  void robotGone() override;
  void moveGroupCame() override;
  void moveGroupGone() override;
  void sceneShown(const planning_scene::PlanningScene& scene) override;

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedbackConstPtr;
  struct Query {
    const char* name;
    moveit::core::RobotStatePtr state;
    std::unique_ptr<RobotGhost> ghost;
    std::unique_ptr<IkFollower> follower;
    std::unique_ptr<interactive_markers::MenuHandler> menu;
    std::string dragged;  // the marker in the hand
    bool out_of_reach = false, dirty = false;
    rviz::BoolProperty* shown;
    rviz::FloatProperty* alpha;
    rviz::ColorProperty* color;
  };
  void makeProperties();
  void makeQueryProperties(rviz::Property* category);
  void makeMetricsProperties(rviz::Property* category);
  void takeAttached(Query& query, const moveit::core::RobotState& current);
  void groupChanged();
  void placeWorkspace();
  void insertMarkers();
  void insertMarkers(Which which);
  void fillMenu(Which which);
  void placeMarkers(Which which);
  void processFeedback(Which which, const Tip& tip, const Feedback& feedback);
  void dragTo(Which which, const Tip& tip, const Eigen::Isometry3d& pose);
  void answered(Which which, const IkFollower::Answer& answer);
  bool toModelFrame(const std::string& frame, const geometry_msgs::Pose& pose, Eigen::Isometry3d& in_model) const;
  void drawQueries();
  RobotGhost::LinkColors colorsOf(const Query& query) const;
  void applyQueryVisibility();
  void fillMetrics();
  void dropMetrics();
  std::string markerName(Which which, const std::string& link) const;

  std::array<Query, 2> queries_;
  rviz::EnumProperty* group_;
  rviz::BoolProperty* workspace_shown_;
  rviz::FloatProperty* marker_size_;
  rviz::ColorProperty* colliding_color_;
  rviz::ColorProperty* violation_color_;
  rviz::Property* metrics_category_;
  rviz::BoolProperty* manipulability_index_;
  rviz::BoolProperty* manipulability_;
  rviz::FloatProperty* payload_;
  rviz::FloatProperty* text_height_;

  std::unique_ptr<TrajectoryView> path_;
  QPointer<Dock> dock_;
  rviz::PanelDockWidget* dock_panel_ = nullptr;
  rviz::Display* marker_display_ = nullptr;
  std::unique_ptr<interactive_markers::InteractiveMarkerServer> server_;
  std::unique_ptr<rviz::Shape> workspace_;
  std::vector<std::unique_ptr<rviz::Shape>> places_;
  std::unique_ptr<rviz::MovableText> text_;
  Ogre::SceneNode* text_node_ = nullptr;  // the model node's child
  Eigen::Vector3d workspace_centre_ = Eigen::Vector3d::Zero(), workspace_size_ = Eigen::Vector3d::Constant(2.0);
  std::vector<Tip> tips_;
  std::string object_;
  moveit::core::RobotStatePtr previous_;
  std::vector<ros::Subscriber> marker_topics_;
  bool collision_aware_ = true, approximate_ = false, markers_changed_ = false, marker_topics_wanted_ = false;
  std::string last_group_;
};

}  // namespace moveit_rviz_plugin
