// The tab Planning: commands, the query, options.
#pragma once

#include <moveit_msgs/ExecuteTrajectoryAction.h>
#include <moveit_msgs/MotionPlanRequest.h>
#include <moveit_msgs/MoveGroupAction.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "action_call.hpp"
#include "dock.hpp"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QGridLayout;
class QGroupBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace moveit_rviz_plugin {

class PlanningTab : public Tab {
 public:
  explicit PlanningTab(Dock* dock);
  ~PlanningTab() override;

  void robotLoaded() override;
  void robotGone() override;
  void moveGroupCame() override;
  void groupChanged() override;
  void queryChanged(Which which, bool by_hand) override;
  void sceneShown(const planning_scene::PlanningScene& scene) override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;
  void warehouseChanged() override;

  void plan();
  void execute();
  void planAndExecute();
  void stop();
  void clearOctomap();
  // "<current>", "<random>", "<random valid>", "<previous>", "<same as start>", "<same as goal>" or a state of the SRDF.
  void setQueryTo(Which which, const std::string& state);
  // As the widgets stand.
  moveit_msgs::MotionPlanRequest request() const;
  moveit_msgs::MoveGroupGoal goal(bool plan_only) const;
  bool busy() const { return busy_ > 0; }
  void update() override;

 private:
  struct Planned {
    moveit_msgs::RobotState start;
    moveit_msgs::RobotTrajectory trajectory;
  };

  struct Line;  // what a straight line of the hand needs

  QWidget* makeCommands();
  QWidget* makeQuery();
  QWidget* makeConstraints();
  QWidget* makeOptions();
  void addOptionNumbers(QGridLayout* layout);
  void addOptionBoxes(QGridLayout* layout);
  void fillStates();
  void show(const QString& text, const QString& why = QString());
  void followCurrent(Which which, const planning_scene::PlanningScene& scene);
  void setRandomValid(Which which);
  void begin();
  void planned(const Planned& plan, double seconds);
  void failed(const std::string& what, const std::string& why);
  void executed(bool good, const std::string& why);
  void setExternal(bool on);
  void readConstraints();
  void offerConstraints(const std::vector<std::string>& names);
  bool wantsLine() const;
  Line line() const;
  // In the background.
  void runPlan(const moveit_msgs::MoveGroupGoal& goal, bool then_execute);
  bool runCartesian(const Line& line, Planned& plan, std::string& why);
  void runLine(const Line& line, bool then_execute);
  bool runTrajectory(const moveit_msgs::RobotTrajectory& trajectory, std::string& why);
  template <typename Action>
  std::shared_ptr<typename ActionCall<Action>::Client> run(ActionCall<Action>& call, const char* name,
                                                           const typename ActionCall<Action>::Goal& goal, std::string& why);
  void inThread(std::function<void()> job);

  QPushButton* plan_button_;
  QPushButton* execute_button_;
  QPushButton* plan_and_execute_button_;
  QPushButton* stop_button_;
  QPushButton* clear_octomap_;
  QLabel* result_;
  QComboBox* group_;
  QComboBox* states_[2];
  QComboBox* constraints_;
  QDoubleSpinBox* time_;
  QSpinBox* attempts_;
  QDoubleSpinBox* velocity_;
  QDoubleSpinBox* acceleration_;
  QCheckBox* cartesian_;
  QCheckBox* collision_aware_;
  QCheckBox* approximate_;
  QCheckBox* external_;
  QCheckBox* replanning_;
  QCheckBox* looking_;

  ActionCall<moveit_msgs::MoveGroupAction> move_group_;
  ActionCall<moveit_msgs::ExecuteTrajectoryAction> executor_;
  std::shared_ptr<Planned> plan_;
  moveit_msgs::Constraints path_constraints_;
  std::vector<ros::Subscriber> external_topics_;
  ros::Publisher stop_publisher_;
  std::optional<std::vector<std::string>> to_offer_;  // names of constraints, when the list is closed again
  std::string database_;                              // its file
  std::filesystem::file_time_type written_;
  ros::WallTime looked_;
  std::atomic<int> busy_{0};
  std::atomic<bool> stopped_{false};
  bool filling_ = false, scaled_ = false, refresh_[2] = {false, false};
};

}  // namespace moveit_rviz_plugin
