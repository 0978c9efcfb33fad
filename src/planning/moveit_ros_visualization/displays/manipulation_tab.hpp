// The tab Manipulation: objects are found, picked up and put down, by move_group's actions `pickup` and `place`.
#pragma once

#include <moveit_msgs/PickupAction.h>
#include <moveit_msgs/PlaceAction.h>
#include <object_recognition_msgs/ObjectRecognitionAction.h>
#include <object_recognition_msgs/RecognizedObjectArray.h>
#include <object_recognition_msgs/TableArray.h>

#include <atomic>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "action_call.hpp"
#include "dock.hpp"
#include "support_surfaces.hpp"

class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QListWidget;
class QPushButton;

namespace moveit_rviz_plugin {

class ManipulationTab : public Tab {
 public:
  explicit ManipulationTab(Dock* dock);

  void robotGone() override;
  void moveGroupCame() override;
  void groupChanged() override { enable(); }
  void sceneShown(const planning_scene::PlanningScene& scene) override;

  bool busy() const { return busy_ > 0; }

 private:
  struct Held {  // what is known of an object since it was picked up here
    Eigen::Quaterniond turn;
    moveit_msgs::Grasp grasp;
  };
  struct Pick {
    moveit_msgs::PickupGoal goal;
    moveit_msgs::CollisionObject object;
    Eigen::Quaterniond turn;
  };

  QWidget* makeObjects();
  QWidget* makeSurfaces();
  QWidget* makeRegion();
  void show(const QString& text);
  void enable();
  void mark();
  bool inRegion(const Eigen::Vector3d& point) const;
  static std::string chosen(const QListWidget* list);
  void fill(const planning_scene::PlanningScene& scene);
  void fillAgain();
  void detect();
  void tablesCame(const object_recognition_msgs::TableArray& tables);
  void pick();
  void place();
  void stop();
  std::string held(const planning_scene::PlanningScene& scene) const;
  moveit_msgs::PlaceLocation location(const std::string& object) const;
  void inThread(std::function<void()> job);
  // In threads.
  void recognize();
  void runPick(Pick pick);
  void runPlace(const moveit_msgs::PlaceGoal& goal);
  template <typename Action>
  std::shared_ptr<typename ActionCall<Action>::Client> run(ActionCall<Action>& call, const char* name,
                                                           const typename ActionCall<Action>::Goal& goal);
  void ended(const std::string& result, bool good);

  QListWidget* objects_;
  QListWidget* surfaces_;
  QPushButton* detect_;
  QPushButton* pick_;
  QPushButton* place_;
  QPushButton* stop_;
  QLabel* result_;
  QDoubleSpinBox* centre_[3];
  QDoubleSpinBox* size_[3];

  ActionCall<object_recognition_msgs::ObjectRecognitionAction> recognizer_;
  ActionCall<moveit_msgs::PickupAction> picker_;
  ActionCall<moveit_msgs::PlaceAction> placer_;
  ros::Publisher scene_publisher_;
  ros::Subscriber tables_topic_, objects_topic_;
  std::vector<Surface> found_;
  std::set<std::string> detected_tables_;  // that are in the scene
  std::map<std::string, Held> held_;
  std::string in_hand_;  // of the group
  std::atomic<int> busy_{0};
  std::atomic<bool> stopped_{false};
  bool listing_ = false;  // from the first press of Detect on
};

}  // namespace moveit_rviz_plugin
