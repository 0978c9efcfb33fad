// The tab Scene Objects: what is in the scene here, and sent to move_group when it is published.
#pragma once

#include <moveit_msgs/PlanningScene.h>

#include <set>
#include <string>
#include <utility>

#include "dock.hpp"

class QComboBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QListWidget;
class QListWidgetItem;
class QPushButton;
class QSlider;

namespace moveit_rviz_plugin {

class ObjectsTab : public Tab {
 public:
  explicit ObjectsTab(Dock* dock);
  void robotGone() override;
  void moveGroupCame() override;
  void sceneShown(const planning_scene::PlanningScene& scene) override;

  void publishIfEdited();
  // Objects and colours of a stored scene in place of those that are here; published at once.
  void useScene(const moveit_msgs::PlanningScene& scene);
  void markerCleared();
  void dragged(const Eigen::Isometry3d& pose);

 private:
  // of a scene: objects of its world, attached ones
  static std::pair<std::set<std::string>, std::set<std::string>> names(const planning_scene::PlanningScene& scene);
  QWidget* makeList();
  QWidget* makeAdd();
  QWidget* makePose();
  QWidget* makeFile();
  void fillList(const planning_scene::PlanningScene& scene);
  void followChosen(const planning_scene::PlanningScene& scene);
  std::string chosen() const;
  void choose();
  void add();
  void addMesh(const std::string& resource);
  void addShape(const std::string& kind, const shapes::ShapeConstPtr& shape);
  void remove();
  void clear();
  void poseTyped();
  void showPose(const Eigen::Isometry3d& pose);
  void setPose(const Eigen::Isometry3d& pose);
  void scale(int percent);
  void describe(const planning_scene::PlanningScene& scene, const std::string& id);
  void itemChanged(QListWidgetItem* item);
  void attach(const std::string& id);
  void detach(const std::string& id);
  void rename(const std::string& from, const std::string& to);
  void publish();
  void exportText();
  void importText();
  void edited();
  // Changes the scene here; false without one.
  bool change(const std::function<void(planning_scene::PlanningScene&)>& what);

  QListWidget* list_;
  QComboBox* shapes_;
  QDoubleSpinBox* sizes_[3];
  QDoubleSpinBox* position_[3];
  QDoubleSpinBox* rotation_[3];
  QSlider* scale_;
  QLabel* status_;
  QPushButton* publish_;
  QWidget* pose_box_;
  std::set<std::string> world_, attached_;              // shown in the list
  std::set<std::string> removed_;                       // by hand, since the last publication
  std::set<std::string> known_world_, known_attached_;  // to move_group, when nothing was edited
  std::vector<shapes::ShapeConstPtr> unscaled_;
  Eigen::Isometry3d shown_pose_ = Eigen::Isometry3d::Identity();  // of the one that is chosen
  ros::Publisher publisher_;
  bool edited_ = false, filling_ = false;
};

}  // namespace moveit_rviz_plugin
