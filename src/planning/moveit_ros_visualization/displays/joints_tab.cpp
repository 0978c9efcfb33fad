#include "joints_tab.hpp"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "planning_tab.hpp"

namespace moveit_rviz_plugin {
namespace {
constexpr int STEPS = 10000;      // of a slider
constexpr double ENDLESS = M_PI;  // sliders of joints without limits, rad or m
}  // namespace

JointsTab::JointsTab(Dock* dock) : Tab(dock) {
  setObjectName("joints");
  auto* layout = new QVBoxLayout(this);
  auto* head = new QHBoxLayout;
  which_ = new QComboBox;
  which_->setObjectName("joints_query_combo_box");
  which_->addItems({"Start state", "Goal state"});
  which_->setCurrentIndex(GOAL);
  unit_ = new QComboBox;
  unit_->setObjectName("joints_unit_combo_box");
  unit_->addItems({"Degrees", "Radians"});
  head->addWidget(new QLabel("Joints of the"));
  head->addWidget(which_);
  head->addStretch(1);
  head->addWidget(unit_);
  layout->addLayout(head);
  rows_widget_ = new QWidget;
  grid_ = new QGridLayout(rows_widget_);
  auto* scroll = new QScrollArea;  // some robots have many joints
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(rows_widget_);
  layout->addWidget(scroll, 1);
  connect(which_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int) { show(); });
  connect(unit_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int) { makeRows(); });
}

void JointsTab::robotGone() { makeRows(); }
void JointsTab::groupChanged() { makeRows(); }

void JointsTab::queryChanged(Which which, bool by_hand) {
  if (filling_) return;
  if (by_hand) which_->setCurrentIndex(which);
  if (which_->currentIndex() == which) show();
}

void JointsTab::load(const rviz::Config& config) {
  bool radians = false;
  if (config.mapGetBool("JointsTab_Use_Radians", &radians)) unit_->setCurrentIndex(radians ? 1 : 0);
}

void JointsTab::save(rviz::Config config) const { config.mapSetValue("JointsTab_Use_Radians", unit_->currentIndex() == 1); }

double JointsTab::factor(const Row& row) const { return row.angle && unit_->currentIndex() == 0 ? 180.0 / M_PI : 1.0; }

void JointsTab::makeRows() {
  rows_.clear();
  while (QLayoutItem* item = grid_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  const auto model = dock_->display().model();
  if (!model || !model->hasJointModelGroup(dock_->display().group())) return;
  for (const moveit::core::JointModel* joint : model->getJointModelGroup(dock_->display().group())->getActiveJointModels())
    for (const std::string& variable : joint->getVariableNames())
      if (variable.find("rot_") == std::string::npos) addRow(joint, variable);  // quaternions are not set one by one
  show();
}

void JointsTab::addRow(const moveit::core::JointModel* joint, const std::string& variable) {
  const auto model = dock_->display().model();
  const moveit::core::VariableBounds& bounds = joint->getVariableBounds(variable);
  const bool last = variable.size() > 5 && variable.substr(variable.size() - 5) == "theta";
  Row row;
  row.variable = model->getVariableIndex(variable);
  row.angle = joint->getType() == moveit::core::JointModel::REVOLUTE || last;
  row.low = bounds.position_bounded_ ? bounds.min_position_ : -ENDLESS;
  row.high = bounds.position_bounded_ ? bounds.max_position_ : ENDLESS;
  row.slider = new QSlider(Qt::Horizontal);
  row.slider->setObjectName(QString::fromStdString("joint_slider_" + variable));
  row.slider->setRange(0, STEPS);
  row.number = new QDoubleSpinBox;
  row.number->setObjectName(QString::fromStdString("joint_value_" + variable));
  row.number->setDecimals(row.angle && unit_->currentIndex() == 0 ? 1 : 4);
  row.number->setRange(row.low * factor(row), row.high * factor(row));
  row.number->setSingleStep(row.angle && unit_->currentIndex() == 0 ? 1.0 : 0.01);
  row.number->setSuffix(!row.angle ? " m" : unit_->currentIndex() == 0 ? QString::fromUtf8("\u00b0") : QString(" rad"));
  const std::size_t index = rows_.size();
  const int place = static_cast<int>(index);
  grid_->addWidget(new QLabel(QString::fromStdString(variable)), place, 0);
  grid_->addWidget(row.slider, place, 1);
  grid_->addWidget(row.number, place, 2);
  grid_->setColumnStretch(1, 1);
  connect(row.slider, &QSlider::valueChanged, this, [this, index](int step) {
    if (!filling_) moved(index, rows_[index].low + (rows_[index].high - rows_[index].low) * step / STEPS);
  });
  connect(row.number, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, index](double value) {
    if (!filling_) moved(index, value / factor(rows_[index]));
  });
  rows_.push_back(row);
}

void JointsTab::show() {
  const moveit::core::RobotStatePtr state = dock_->display().query(static_cast<Which>(which_->currentIndex()));
  if (!state) return;
  filling_ = true;
  for (const Row& row : rows_) {
    const double value = state->getVariablePosition(row.variable);
    row.number->setValue(value * factor(row));
    row.slider->setValue(static_cast<int>(std::lround(STEPS * (value - row.low) / std::max(1e-9, row.high - row.low))));
  }
  filling_ = false;
}

void JointsTab::moved(std::size_t index, double value) {
  const Which which = static_cast<Which>(which_->currentIndex());
  const moveit::core::RobotStatePtr state = dock_->display().query(which);
  if (!state) return;
  state->setVariablePosition(rows_[index].variable, value);
  dock_->planning().queryChanged(which, true);
  dock_->display().setQuery(which, *state);
}

}  // namespace moveit_rviz_plugin
