// The tab Joints: a slider and a number for each joint of the group, in the start or the goal.
#pragma once

#include "dock.hpp"

class QComboBox;
class QDoubleSpinBox;
class QGridLayout;
class QSlider;

namespace moveit_rviz_plugin {

class JointsTab : public Tab {
 public:
  explicit JointsTab(Dock* dock);
  void robotGone() override;
  void groupChanged() override;
  void queryChanged(Which which, bool by_hand) override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  struct Row {
    int variable;  // of the robot
    bool angle;
    double low, high;  // rad or m
    QSlider* slider;
    QDoubleSpinBox* number;
  };
  void makeRows();
  void addRow(const moveit::core::JointModel* joint, const std::string& variable);
  void show();
  void moved(std::size_t row, double value);
  double factor(const Row& row) const;

  QGridLayout* grid_;
  QWidget* rows_widget_ = nullptr;
  QComboBox* which_;
  QComboBox* unit_;
  std::vector<Row> rows_;
  bool filling_ = false;
};

}  // namespace moveit_rviz_plugin
