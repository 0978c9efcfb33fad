#include "stored_tabs.hpp"

#include <moveit/robot_state/conversions.h>
#include <moveit_msgs/MotionPlanRequest.h>
#include <moveit_msgs/PlanningScene.h>

#include <QGridLayout>
#include <QGroupBox>
#include <QListWidget>
#include <QPushButton>
#include <QTextEdit>
#include <QTime>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <regex>

#include "objects_tab.hpp"
#include "planning_tab.hpp"
#include "warehouse.hpp"

namespace moveit_rviz_plugin {
namespace {
QPushButton* button(const QString& text, const char* name, QWidget* receiver, std::function<void()> clicked) {
  auto* made = new QPushButton(text);
  made->setObjectName(name);
  QObject::connect(made, &QPushButton::clicked, receiver, [clicked](bool) { clicked(); });
  return made;
}

QGroupBox* group(const QString& title, std::initializer_list<QWidget*> widgets) {
  auto* box = new QGroupBox(title);
  auto* layout = new QVBoxLayout(box);
  for (QWidget* widget : widgets) layout->addWidget(widget);
  return box;
}
}  // namespace

// ---------------------------------------------------------------- scenes

StoredScenesTab::StoredScenesTab(Dock* dock) : Tab(dock) {
  setObjectName("stored_scenes");
  tree_ = new QTreeWidget;
  tree_->setObjectName("planning_scene_tree");
  tree_->setHeaderHidden(true);
  auto* layout = new QGridLayout(this);
  layout->addWidget(group("Planning Scenes and Queries", {tree_}), 0, 0, 3, 1);
  layout->addWidget(group("Current Scene", {button("Save Scene", "save_scene_button", this, [this]() { saveScene(); }),
                                            button("Save Query", "save_query_button", this, [this]() { saveQuery(); })}),
                    0, 1);
  layout->addWidget(group("Saved Scenes", {button("Load &Scene", "load_scene_button", this, [this]() { loadScene(); }),
                                           button("Load &Query", "load_query_button", this, [this]() { loadQuery(); }),
                                           button("Delete Scene", "delete_scene_button", this, [this]() { remove(false); }),
                                           button("Delete Query", "delete_query_button", this, [this]() { remove(true); })}),
                    1, 1);
  layout->setColumnStretch(0, 1);
  layout->setRowStretch(2, 1);
  connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int) {
    if (!filling_) rename(item, item->text(0));
  });
}

QString StoredScenesTab::scene() const {
  QTreeWidgetItem* item = tree_->currentItem();
  if (!item) return QString();
  return (item->parent() ? item->parent() : item)->data(0, Qt::UserRole).toString();
}

QString StoredScenesTab::query() const {
  QTreeWidgetItem* item = tree_->currentItem();
  return item && item->parent() ? item->data(0, Qt::UserRole).toString() : QString();
}

void StoredScenesTab::refresh() {
  dock_->inBackground([this]() {
    Warehouse& warehouse = dock_->warehouse();
    std::vector<std::pair<std::string, std::vector<std::string>>> found;
    for (const std::string& name : warehouse.names("scenes"))
      found.push_back({name, warehouse.names("requests", {{"scene", name}})});
    dock_->later([this, found]() {
      filling_ = true;
      tree_->clear();
      const auto make = [](auto* parent, const std::string& name) {
        auto* item = new QTreeWidgetItem(parent);
        item->setText(0, QString::fromStdString(name));
        item->setData(0, Qt::UserRole, QString::fromStdString(name));
        item->setFlags(item->flags() | Qt::ItemIsEditable);
        return item;
      };
      for (const auto& entry : found) {
        QTreeWidgetItem* item = make(tree_, entry.first);
        for (const std::string& name : entry.second) make(item, name);
        item->setExpanded(true);
      }
      filling_ = false;
    });
  });
}

void StoredScenesTab::saveScene() {
  const auto monitor = dock_->display().monitor();
  if (!monitor) return;
  moveit_msgs::PlanningScene message;
  {
    const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
    scene->getPlanningSceneMsg(message);
  }
  dock_->ask("Save scene", "Name of the scene:", scene(), [this, message](const QString& name) {
    dock_->inBackground([this, message, name = name.toStdString()]() mutable {
      message.name = name;
      dock_->warehouse().save("scenes", name, message);
      dock_->say("Scene '" + name + "' was saved");
      dock_->later([this]() { refresh(); });
    });
  });
}

void StoredScenesTab::saveQuery() {
  const QString of = scene();
  if (of.isEmpty()) return dock_->say("choose the scene that the query belongs to, or save it first", true);
  if (!dock_->display().query(GOAL) || dock_->display().group().empty()) return dock_->say("there is no query yet", true);
  const moveit_msgs::MotionPlanRequest request = dock_->planning().request();
  dock_->ask("Save query", "Name of the query:", query(), [this, request, of = of.toStdString()](const QString& name) {
    dock_->inBackground([this, request, of, name = name.toStdString()]() {
      dock_->warehouse().save("requests", name, request, {{"scene", of}});
      dock_->later([this]() { refresh(); });
    });
  });
}

void StoredScenesTab::loadScene() {
  const std::string name = scene().toStdString();
  if (name.empty()) return dock_->say("choose a scene first", true);
  dock_->inBackground([this, name]() {
    const auto message = dock_->warehouse().load<moveit_msgs::PlanningScene>("scenes", name);
    dock_->later([this, message]() { dock_->objects().useScene(message); });
  });
}

void StoredScenesTab::loadQuery() {
  const std::string of = scene().toStdString(), name = query().toStdString();
  if (name.empty()) return dock_->say("choose a query first", true);
  dock_->inBackground([this, of, name]() {
    const auto request = dock_->warehouse().load<moveit_msgs::MotionPlanRequest>("requests", name, {{"scene", of}});
    dock_->later([this, request]() {
      MotionPlanningDisplay& display = dock_->display();
      const moveit::core::RobotStatePtr start = display.query(START);
      if (!start) return;
      display.setGroup(request.group_name);
      moveit::core::robotStateMsgToRobotState(request.start_state, *start);
      const moveit::core::RobotStatePtr goal = std::make_shared<moveit::core::RobotState>(*start);
      for (const moveit_msgs::Constraints& constraints : request.goal_constraints)
        for (const moveit_msgs::JointConstraint& joint : constraints.joint_constraints)
          if (goal->getRobotModel()->hasJointModel(joint.joint_name))
            goal->setVariablePosition(joint.joint_name, joint.position);
      for (const Which which : {START, GOAL}) dock_->planning().queryChanged(which, true);
      display.setQuery(START, *start);
      display.setQuery(GOAL, *goal);
    });
  });
}

void StoredScenesTab::remove(bool whole_query) {
  const std::string of = scene().toStdString(), name = query().toStdString();
  if (of.empty() || (whole_query && name.empty())) return dock_->say("choose what is to be removed first", true);
  dock_->inBackground([this, of, name, whole_query]() {
    Warehouse& warehouse = dock_->warehouse();
    if (whole_query) {
      warehouse.remove("requests", name, {{"scene", of}});
    } else {
      warehouse.remove("scenes", of);
      warehouse.clear("requests", {{"scene", of}});
      warehouse.clear("results", {{"scene", of}});
    }
    dock_->later([this]() { refresh(); });
  });
}

void StoredScenesTab::rename(QTreeWidgetItem* item, const QString& to) {
  const std::string from = item->data(0, Qt::UserRole).toString().toStdString();
  const std::string of = item->parent() ? item->parent()->data(0, Qt::UserRole).toString().toStdString() : "";
  dock_->inBackground([this, from, of, to = to.trimmed().toStdString()]() {
    Warehouse& warehouse = dock_->warehouse();
    dock_->later([this]() { refresh(); });
    if (!of.empty()) return warehouse.rename("requests", from, to, {{"scene", of}});
    warehouse.rename("scenes", from, to);
    for (const std::string& name : warehouse.names("requests", {{"scene", from}})) {
      warehouse.save("requests", name, warehouse.load<moveit_msgs::MotionPlanRequest>("requests", name, {{"scene", from}}),
                     {{"scene", to}});
      warehouse.remove("requests", name, {{"scene", from}});
    }
  });
}

// ---------------------------------------------------------------- states

StoredStatesTab::StoredStatesTab(Dock* dock) : Tab(dock) {
  setObjectName("stored_states");
  list_ = new QListWidget;
  list_->setObjectName("list_states");
  auto* layout = new QGridLayout(this);
  layout->addWidget(list_, 0, 0, 4, 1);
  layout->addWidget(group("Stored Robot States", {button("Load", "load_state_button", this,
                                                         [this]() {
                                                           dock_->ask(
                                                               "Load states", "Names to load (a regular expression):", ".*",
                                                               [this](const QString& pattern) { read(pattern.toStdString()); });
                                                         }),
                                                  button("Clear", "clear_states_button", this,
                                                         [this]() {
                                                           states_.clear();
                                                           show();
                                                         })}),
                    0, 1);
  layout->addWidget(
      group("Selected Robot State", {button("Set as Start", "set_as_start_state_button", this, [this]() { use(START); }),
                                     button("Set as Goal", "set_as_goal_state_button", this, [this]() { use(GOAL); }),
                                     button("Remove", "remove_state_button", this, [this]() { remove(); })}),
      1, 1);
  layout->addWidget(
      group("Current Robot State", {button("Save Start", "save_start_state_button", this, [this]() { save(START); }),
                                    button("Save Goal", "save_goal_state_button", this, [this]() { save(GOAL); })}),
      2, 1);
  layout->setColumnStretch(0, 1);
  layout->setRowStretch(3, 1);
}

void StoredStatesTab::show() {
  list_->clear();
  for (const auto& item : states_) list_->addItem(QString::fromStdString(item.first));
}

void StoredStatesTab::read(const std::string& pattern) {
  const auto model = dock_->display().model();
  if (!model) return;
  dock_->inBackground([this, pattern, robot = model->getName()]() {
    std::map<std::string, moveit_msgs::RobotState> found;
    std::regex fits;
    try {
      fits = std::regex(pattern);
    } catch (const std::regex_error&) {
      throw std::runtime_error("'" + pattern + "' is no regular expression");
    }
    for (const std::string& name : dock_->warehouse().names("states", {{"robot", robot}}))
      if (std::regex_match(name, fits))
        found[name] = dock_->warehouse().load<moveit_msgs::RobotState>("states", name, {{"robot", robot}});
    dock_->later([this, found]() {
      states_ = found;
      show();
    });
  });
}

void StoredStatesTab::save(Which which) {
  const moveit::core::RobotStatePtr state = dock_->display().query(which);
  if (!state) return;
  moveit_msgs::RobotState message;
  moveit::core::robotStateToRobotStateMsg(*state, message);
  dock_->ask("Save state", "Name of the state:", "",
             [this, message, robot = state->getRobotModel()->getName()](const QString& name) {
               dock_->inBackground([this, message, robot, name = name.toStdString()]() {
                 dock_->warehouse().save("states", name, message, {{"robot", robot}});
                 dock_->say("State '" + name + "' was saved in " + dock_->warehouse().file());
                 dock_->later([this, message, name]() {
                   states_[name] = message;
                   show();
                 });
               });
             });
}

void StoredStatesTab::use(Which which) {
  QListWidgetItem* item = list_->currentItem();
  const moveit::core::RobotStatePtr state = dock_->display().query(which);
  if (!item || !state) return dock_->say("choose a state first", true);
  moveit::core::robotStateMsgToRobotState(states_[item->text().toStdString()], *state);
  dock_->planning().queryChanged(which, true);
  dock_->display().setQuery(which, *state);
}

void StoredStatesTab::remove() {
  QListWidgetItem* item = list_->currentItem();
  const auto model = dock_->display().model();
  if (!item || !model) return dock_->say("choose a state first", true);
  const std::string name = item->text().toStdString();
  states_.erase(name);
  show();
  dock_->inBackground([this, name, robot = model->getName()]() {
    dock_->warehouse().remove("states", name, {{"robot", robot}});
  });
}

// ---------------------------------------------------------------- status

StatusTab::StatusTab(Dock* dock) : Tab(dock) {
  setObjectName("status");
  text_ = new QTextEdit;
  text_->setObjectName("status_text");
  text_->setReadOnly(true);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(text_);
}

void StatusTab::add(const QString& line, bool error) {
  const QString time = QTime::currentTime().toString("HH:mm:ss ");
  text_->append(error ? "<span style='color:red'>" + time + line.toHtmlEscaped() + "</span>" : time + line.toHtmlEscaped());
}

}  // namespace moveit_rviz_plugin
