#include "planning_tab.hpp"

#include <moveit/robot_state/conversions.h>
#include <moveit_msgs/RobotState.h>
#include <ros/node_handle.h>
#include <ros/param.h>
#include <std_msgs/Empty.h>
#include <std_msgs/String.h>

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <utility>

#include "context_tab.hpp"
#include "objects_tab.hpp"
#include "warehouse.hpp"

namespace moveit_rviz_plugin {
namespace {
const char* const NONE = "None";

template <typename Widget>
Widget* named(Widget* widget, const char* name, const char* tip = "") {
  widget->setObjectName(name);
  widget->setToolTip(tip);
  return widget;
}
}  // namespace

PlanningTab::PlanningTab(Dock* dock) : Tab(dock) {
  setObjectName("planning");
  auto* layout = new QGridLayout(this);
  layout->addWidget(makeCommands(), 0, 0);
  layout->addWidget(makeQuery(), 0, 1);
  layout->addWidget(makeOptions(), 0, 2, 2, 1);
  layout->addWidget(makeConstraints(), 1, 0, 1, 2);
  layout->setRowStretch(2, 1);
}

PlanningTab::~PlanningTab() { external_topics_.clear(); }

QWidget* PlanningTab::makeCommands() {
  auto* box = new QGroupBox("Commands");
  auto* layout = new QVBoxLayout(box);
  plan_button_ = named(new QPushButton("&Plan"), "plan_button");
  execute_button_ = named(new QPushButton("&Execute"), "execute_button", "What was planned last");
  plan_and_execute_button_ = named(new QPushButton("Plan && E&xecute"), "plan_and_execute_button");
  stop_button_ = named(new QPushButton("&Stop"), "stop_button", "Stop the robot");
  result_ = named(new QLabel, "result_label");
  result_->setWordWrap(true);
  clear_octomap_ = named(new QPushButton("Clear octomap"), "clear_octomap_button");
  execute_button_->setEnabled(false);
  stop_button_->setEnabled(false);
  clear_octomap_->setEnabled(false);
  for (QWidget* widget : std::initializer_list<QWidget*>{plan_button_, execute_button_, plan_and_execute_button_, stop_button_,
                                                         result_, clear_octomap_})
    layout->addWidget(widget);
  layout->addStretch(1);
  connect(plan_button_, &QPushButton::clicked, this, [this](bool) { plan(); });
  connect(execute_button_, &QPushButton::clicked, this, [this](bool) { execute(); });
  connect(plan_and_execute_button_, &QPushButton::clicked, this, [this](bool) { planAndExecute(); });
  connect(stop_button_, &QPushButton::clicked, this, [this](bool) { stop(); });
  connect(clear_octomap_, &QPushButton::clicked, this, [this](bool) { clearOctomap(); });
  return box;
}

QWidget* PlanningTab::makeQuery() {
  auto* box = new QGroupBox("Query");
  auto* layout = new QVBoxLayout(box);
  group_ = named(new QComboBox, "planning_group_combo_box");
  layout->addWidget(new QLabel("Planning Group:"));
  layout->addWidget(group_);
  connect(group_, qOverload<int>(&QComboBox::activated), this,
          [this](int) { dock_->display().setGroup(group_->currentText().toStdString()); });
  const char* labels[] = {"Start State:", "Goal State:"};
  const char* names[] = {"start_state_combo_box", "goal_state_combo_box"};
  for (const Which which : {START, GOAL}) {
    states_[which] = named(new QComboBox, names[which]);
    layout->addWidget(new QLabel(labels[which]));
    layout->addWidget(states_[which]);
    connect(states_[which], qOverload<int>(&QComboBox::activated), this,
            [this, which](int) { setQueryTo(which, states_[which]->currentText().toStdString()); });
  }
  layout->addStretch(1);
  return box;
}

QWidget* PlanningTab::makeConstraints() {
  auto* box = new QGroupBox("Path Constraints");
  auto* layout = new QVBoxLayout(box);
  constraints_ = named(new QComboBox, "path_constraints_combo_box", "Constraints of the database, for this robot and group");
  constraints_->addItem(NONE);
  layout->addWidget(constraints_);
  connect(constraints_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    path_constraints_ = moveit_msgs::Constraints();
    const auto model = dock_->display().model();
    if (index <= 0 || !model) return;
    const std::string name = constraints_->currentText().toStdString();
    const Warehouse::Owners owners{{"robot", model->getName()}, {"planning_group", dock_->display().group()}};
    dock_->inBackground([this, name, owners]() {
      const auto found = dock_->warehouse().load<moveit_msgs::Constraints>("constraints", name, owners);
      dock_->later([this, found]() { path_constraints_ = found; });
    });
  });
  return box;
}

QWidget* PlanningTab::makeOptions() {
  auto* box = new QGroupBox("Options");
  auto* layout = new QGridLayout(box);
  addOptionNumbers(layout);
  addOptionBoxes(layout);
  layout->setRowStretch(layout->rowCount(), 1);
  return box;
}

void PlanningTab::addOptionNumbers(QGridLayout* layout) {
  time_ = named(new QDoubleSpinBox, "planning_time", "Planning ends when this time or the attempts are used up");
  time_->setRange(0.0, 300.0);
  time_->setDecimals(1);
  time_->setValue(5.0);
  attempts_ = named(new QSpinBox, "planning_attempts", "The best of so many plans is taken");
  attempts_->setRange(1, 1000);
  attempts_->setValue(10);
  velocity_ = named(new QDoubleSpinBox, "velocity_scaling_factor", "Share of the joints' greatest velocities, up to 1");
  acceleration_ =
      named(new QDoubleSpinBox, "acceleration_scaling_factor", "Share of the joints' greatest accelerations, up to 1");
  for (QDoubleSpinBox* factor : {velocity_, acceleration_}) {
    factor->setRange(0.01, 1.0);
    factor->setSingleStep(0.1);
    factor->setValue(0.1);
  }
  const std::pair<const char*, QWidget*> rows[] = {{"Planning Time (s):", time_},
                                                   {"Planning Attempts:", attempts_},
                                                   {"Velocity Scaling:", velocity_},
                                                   {"Accel. Scaling:", acceleration_}};
  for (const auto& row : rows) {
    const int place = layout->rowCount();
    layout->addWidget(new QLabel(row.first), place, 0);
    layout->addWidget(row.second, place, 1);
  }
}

void PlanningTab::addOptionBoxes(QGridLayout* layout) {
  cartesian_ = named(new QCheckBox("Use Cartesian Path"), "use_cartesian_path", "The hand moves on a straight line");
  collision_aware_ =
      named(new QCheckBox("Collision-aware IK"), "collision_aware_ik", "Dragging looks for states that touch nothing");
  approximate_ = named(new QCheckBox("Approx IK Solutions"), "approximate_ik", "Dragging goes as near as there is a way");
  external_ = named(new QCheckBox("External Comm."), "allow_external_program",
                    "Other nodes may plan, execute and set states by "
                    "topics below /rviz/moveit");
  replanning_ = named(new QCheckBox("Replanning"), "allow_replanning", "Plan again when something comes into the way");
  looking_ = named(new QCheckBox("Sensor Positioning"), "allow_looking", "Look around before going where nothing was seen yet");
  collision_aware_->setChecked(true);
  for (QCheckBox* box : {cartesian_, collision_aware_, approximate_, external_, replanning_, looking_})
    layout->addWidget(box, layout->rowCount(), 0, 1, 2);
  connect(collision_aware_, &QCheckBox::toggled, this, [this](bool on) { dock_->display().setCollisionAwareIk(on); });
  connect(approximate_, &QCheckBox::toggled, this, [this](bool on) { dock_->display().setApproximateIk(on); });
  connect(external_, &QCheckBox::toggled, this, [this](bool on) { setExternal(on); });
}

void PlanningTab::load(const rviz::Config& config) {
  float number;
  int count;
  bool on;
  if (config.mapGetFloat("MoveIt_Planning_Time", &number)) time_->setValue(number);
  if (config.mapGetInt("MoveIt_Planning_Attempts", &count)) attempts_->setValue(count);
  scaled_ = config.mapGetFloat("Velocity_Scaling_Factor", &number);
  if (scaled_) velocity_->setValue(number);
  if (config.mapGetFloat("Acceleration_Scaling_Factor", &number)) acceleration_->setValue(number);
  const std::pair<const char*, QCheckBox*> boxes[] = {{"MoveIt_Allow_Replanning", replanning_},
                                                      {"MoveIt_Allow_Sensor_Positioning", looking_},
                                                      {"MoveIt_Allow_External_Program", external_},
                                                      {"MoveIt_Use_Cartesian_Path", cartesian_},
                                                      {"MoveIt_Use_Constraint_Aware_IK", collision_aware_},
                                                      {"MoveIt_Allow_Approximate_IK", approximate_}};
  for (const auto& item : boxes)
    if (config.mapGetBool(item.first, &on)) item.second->setChecked(on);
}

void PlanningTab::save(rviz::Config config) const {
  config.mapSetValue("MoveIt_Planning_Time", time_->value());
  config.mapSetValue("MoveIt_Planning_Attempts", attempts_->value());
  config.mapSetValue("Velocity_Scaling_Factor", velocity_->value());
  config.mapSetValue("Acceleration_Scaling_Factor", acceleration_->value());
  config.mapSetValue("MoveIt_Allow_Replanning", replanning_->isChecked());
  config.mapSetValue("MoveIt_Allow_Sensor_Positioning", looking_->isChecked());
  config.mapSetValue("MoveIt_Allow_External_Program", external_->isChecked());
  config.mapSetValue("MoveIt_Use_Cartesian_Path", cartesian_->isChecked());
  config.mapSetValue("MoveIt_Use_Constraint_Aware_IK", collision_aware_->isChecked());
  config.mapSetValue("MoveIt_Allow_Approximate_IK", approximate_->isChecked());
}

// ---------------------------------------------------------------- the query

void PlanningTab::robotLoaded() {
  filling_ = true;
  group_->clear();
  for (const std::string& name : dock_->display().model()->getJointModelGroupNames())
    group_->addItem(QString::fromStdString(name));
  filling_ = false;
  if (!scaled_) {  // what the file does not say, the robot does
    std::string key = dock_->display().robotDescription();
    ros::param::search(key, key);
    velocity_->setValue(ros::param::param(key + "_planning/default_velocity_scaling_factor", 0.1));
    acceleration_->setValue(ros::param::param(key + "_planning/default_acceleration_scaling_factor", 0.1));
  }
  groupChanged();
}

void PlanningTab::robotGone() {
  plan_.reset();
  execute_button_->setEnabled(false);
  move_group_.reset();
  executor_.reset();
}

void PlanningTab::moveGroupCame() {
  stop_publisher_ = ros::NodeHandle().advertise<std_msgs::String>(dock_->display().named("trajectory_execution_event"), 1);
  readConstraints();
}

void PlanningTab::groupChanged() {
  const int index = group_->findText(QString::fromStdString(dock_->display().group()));
  if (index >= 0) group_->setCurrentIndex(index);
  fillStates();
  cartesian_->setEnabled(dock_->display().tips().size() == 1);
  constraints_->setCurrentIndex(0);
  path_constraints_ = moveit_msgs::Constraints();
  readConstraints();
}

void PlanningTab::warehouseChanged() { readConstraints(); }

void PlanningTab::readConstraints() {
  const auto model = dock_->display().model();
  if (!model) return;
  const Warehouse::Owners owners{{"robot", model->getName()}, {"planning_group", dock_->display().group()}};
  dock_->inBackground([this, owners]() {
    const std::vector<std::string> names = dock_->warehouse().names("constraints", owners);
    dock_->later([this, names, file = dock_->warehouse().file()]() {
      database_ = file;
      offerConstraints(names);
    });
  });
}

// What was chosen stays, as long as it is there. A list from which somebody chooses at this moment is left as it is.
void PlanningTab::offerConstraints(const std::vector<std::string>& names) {
  if (constraints_->view()->isVisible()) {
    to_offer_ = names;
    return;
  }
  const QString before = constraints_->currentText();
  constraints_->clear();
  constraints_->addItem(NONE);
  for (const std::string& name : names) constraints_->addItem(QString::fromStdString(name));
  const int same = constraints_->findText(before);
  constraints_->setCurrentIndex(std::max(0, same));
  if (same <= 0) path_constraints_ = moveit_msgs::Constraints();
}

// Other nodes write into the database, too.
void PlanningTab::update() {
  if (to_offer_ && !constraints_->view()->isVisible()) offerConstraints(*std::exchange(to_offer_, std::nullopt));
  const ros::WallTime now = ros::WallTime::now();
  if (database_.empty() || (now - looked_).toSec() < 1.0) return;
  looked_ = now;
  std::error_code error;
  const auto written = std::filesystem::last_write_time(database_, error);
  if (error || written == written_) return;
  if (written_ != std::filesystem::file_time_type()) readConstraints();
  written_ = written;
}

void PlanningTab::fillStates() {
  filling_ = true;
  const auto model = dock_->display().model();
  for (const Which which : {START, GOAL}) {
    const QString before = states_[which]->currentText();
    states_[which]->clear();
    for (const char* name :
         {"<random valid>", "<random>", "<current>", which == START ? "<same as goal>" : "<same as start>", "<previous>"})
      states_[which]->addItem(name);
    if (model && model->hasJointModelGroup(dock_->display().group()))
      for (const std::string& name : model->getJointModelGroup(dock_->display().group())->getDefaultStateNames())
        states_[which]->addItem(QString::fromStdString(name));
    const int same = states_[which]->findText(before.isEmpty() ? "<current>" : before);
    states_[which]->setCurrentIndex(same >= 0 ? same : states_[which]->findText("<current>"));
  }
  filling_ = false;
}

void PlanningTab::queryChanged(Which which, bool by_hand) {
  if (by_hand) states_[which]->setCurrentIndex(-1);  // it is none of the list any more
}

void PlanningTab::sceneShown(const planning_scene::PlanningScene& scene) {
  clear_octomap_->setEnabled(scene.getWorld()->hasObject(planning_scene::PlanningScene::OCTOMAP_NS));
  for (const Which which : {START, GOAL}) followCurrent(which, scene);
}

void PlanningTab::followCurrent(Which which, const planning_scene::PlanningScene& scene) {
  if (states_[which]->currentText() != "<current>") return;
  const moveit::core::RobotStatePtr shown = dock_->display().query(which);
  const moveit::core::RobotState& now = scene.getCurrentState();
  if (!shown || (shown->distance(now) < 1e-5 && moveit::core::haveSameAttachedObjects(*shown, now))) return;
  dock_->display().setQuery(which, now);
}

void PlanningTab::setQueryTo(Which which, const std::string& state) {
  MotionPlanningDisplay& display = dock_->display();
  moveit::core::RobotStatePtr query = display.query(which);
  if (filling_ || !query) return;
  states_[which]->setCurrentIndex(states_[which]->findText(QString::fromStdString(state)));
  const moveit::core::JointModelGroup* group =
      query->getRobotModel()->hasJointModelGroup(display.group()) ? query->getJointModelGroup(display.group()) : nullptr;
  if (state == "<current>") query = display.currentState();
  else if (state == "<same as goal>" || state == "<same as start>")
    query = display.query(state == "<same as goal>" ? GOAL : START);
  else if (state == "<previous>") query = display.previous();
  else if (!group) return dock_->say("choose a planning group first", true);
  else if (state == "<random valid>") return setRandomValid(which);
  else if (state == "<random>") query->setToRandomPositions(group);
  else if (!query->setToDefaultValues(group, state))
    return dock_->say("group '" + display.group() + "' has no state '" + state + "'", true);
  if (query) display.setQuery(which, *query);
}

void PlanningTab::setRandomValid(Which which) {
  const planning_scene_monitor::PlanningSceneMonitorPtr monitor = dock_->display().monitor();
  const moveit::core::RobotStatePtr state = dock_->display().query(which);
  const std::string group = dock_->display().group();
  dock_->inBackground([this, monitor, state, group, which]() {
    const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
    constexpr int TRIES = 100;
    for (int i = 0; i < TRIES; ++i) {
      state->setToRandomPositions(state->getJointModelGroup(group));
      state->update();
      if (!scene->isStateValid(*state, group)) continue;
      return dock_->later([this, state, which]() { dock_->display().setQuery(which, *state); });
    }
    throw std::runtime_error("no random state of '" + group + "' without a collision in " + std::to_string(TRIES) + " tries");
  });
}

}  // namespace moveit_rviz_plugin
