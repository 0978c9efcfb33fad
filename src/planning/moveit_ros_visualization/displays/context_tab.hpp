// The tab Context: the planning library, its planner and parameters, the database, the workspace.
#pragma once

#include <moveit_msgs/PlannerInterfaceDescription.h>
#include <moveit_msgs/WorkspaceParameters.h>

#include <map>

#include "dock.hpp"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace moveit_rviz_plugin {

class ContextTab : public Tab {
 public:
  explicit ContextTab(Dock* dock);
  void robotGone() override;
  void moveGroupCame() override;
  void moveGroupGone() override;
  void groupChanged() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

  // "" for the default.
  std::string pipeline() const;
  std::string planner() const;
  moveit_msgs::WorkspaceParameters workspace() const;

 private:
  QWidget* makeLibrary();
  QWidget* makeWarehouse();
  QWidget* makeWorkspace();
  void fillPipelines(const std::vector<moveit_msgs::PlannerInterfaceDescription>& found, const std::string& usual);
  void fillPlanners();
  void askParameters();
  void showParameters(const std::map<std::string, std::string>& parameters);
  void sendParameters();
  void workspaceChanged();
  void connectWarehouse();

  QLabel* library_;
  QComboBox* pipelines_;
  QComboBox* planners_;
  QTableWidget* parameters_;
  QLineEdit* host_;
  QSpinBox* port_;
  QPushButton* connect_;
  QPushButton* reset_;
  QDoubleSpinBox* centre_[3];
  QDoubleSpinBox* size_[3];
  std::vector<moveit_msgs::PlannerInterfaceDescription> found_;
  bool filling_ = false;
};

}  // namespace moveit_rviz_plugin
