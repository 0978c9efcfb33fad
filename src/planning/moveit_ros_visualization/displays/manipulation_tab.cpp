#include "manipulation_tab.hpp"

#include <geometric_shapes/shape_operations.h>
#include <moveit_msgs/PlanningScene.h>
#include <ros/node_handle.h>

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

namespace moveit_rviz_plugin {
namespace {
const char* const AXES[] = {"x", "y", "z"};
const double CENTRE[] = {0.0, 0.0, 0.6}, SIZE[] = {4.0, 1.5, 1.2};  // m, of the region that is looked at
const QColor OBJECT_COLOR(255, 0, 0), SURFACE_COLOR(0, 0, 255);     // of what is chosen
constexpr int LEAST_HEIGHT = 70;                                    // pixels, of a list

QPushButton* button(const QString& text, const char* name, const char* tip) {
  auto* made = new QPushButton(text);
  made->setObjectName(name);
  made->setToolTip(tip);
  return made;
}

QListWidget* list(const char* name, const char* tip) {
  auto* made = new QListWidget;
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setMinimumHeight(LEAST_HEIGHT);
  return made;
}
}  // namespace

ManipulationTab::ManipulationTab(Dock* dock) : Tab(dock) {
  setObjectName("manipulation");
  auto* layout = new QGridLayout(this);
  layout->addWidget(makeObjects(), 0, 0);
  layout->addWidget(makeSurfaces(), 0, 1);
  result_ = new QLabel;
  result_->setObjectName("manipulation_result");
  result_->setWordWrap(true);
  layout->addWidget(result_, 1, 0, 1, 2);
  layout->addWidget(makeRegion(), 2, 0, 1, 2);
  layout->setRowStretch(0, 1);
  connect(detect_, &QPushButton::clicked, this, [this](bool) { detect(); });
  connect(pick_, &QPushButton::clicked, this, [this](bool) { pick(); });
  connect(place_, &QPushButton::clicked, this, [this](bool) { place(); });
  connect(stop_, &QPushButton::clicked, this, [this](bool) { stop(); });
  for (QListWidget* widget : {objects_, surfaces_})
    connect(widget, &QListWidget::itemSelectionChanged, this, [this]() {
      mark();
      enable();
    });
  enable();
}

QWidget* ManipulationTab::makeObjects() {
  auto* box = new QGroupBox("Detected Objects");
  auto* layout = new QVBoxLayout(box);
  objects_ = list("detected_objects_list", "Objects of the scene whose origin is in the region; what is chosen is red");
  detect_ = button("&Detect", "detect_objects_button",
                   "Ask the action /recognize_objects, if a node serves it, and list what is "
                   "in the region");
  layout->addWidget(objects_, 1);
  layout->addWidget(detect_);
  return box;
}

QWidget* ManipulationTab::makeSurfaces() {
  auto* box = new QGroupBox("Support Surfaces");
  auto* layout = new QGridLayout(box);
  surfaces_ = list("support_surfaces_list", "Objects with a level top; what is chosen is blue");
  pick_ = button("&Pick", "pick_button", "Pick up the chosen object, from the chosen surface or the one below it");
  place_ = button("P&lace", "place_button", "Put down what the group holds, on the chosen surface");
  stop_ = button("&Stop", "stop_manipulation_button", "Stop the robot");
  layout->addWidget(surfaces_, 0, 0, 1, 3);
  layout->addWidget(pick_, 1, 0);
  layout->addWidget(place_, 1, 1);
  layout->addWidget(stop_, 1, 2);
  layout->setRowStretch(0, 1);
  return box;
}

QWidget* ManipulationTab::makeRegion() {
  auto* box = new QGroupBox("ROI");
  auto* layout = new QGridLayout(box);
  layout->addWidget(new QLabel("Center (m):"), 0, 0);
  layout->addWidget(new QLabel("Size (m):"), 1, 0);
  for (int i = 0; i < 3; ++i) {
    centre_[i] = new QDoubleSpinBox;
    centre_[i]->setObjectName(QString("roi_center_") + AXES[i]);
    centre_[i]->setRange(-99.0, 99.0);
    centre_[i]->setValue(CENTRE[i]);
    size_[i] = new QDoubleSpinBox;
    size_[i]->setObjectName(QString("roi_size_") + AXES[i]);
    size_[i]->setRange(0.0, 99.0);
    size_[i]->setValue(SIZE[i]);
    for (QDoubleSpinBox* number : {centre_[i], size_[i]}) {
      number->setSingleStep(0.01);
      number->setToolTip(QString("Along %1 of the robot's frame").arg(AXES[i]));
      connect(number, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double) { fillAgain(); });
    }
    layout->addWidget(centre_[i], 0, i + 1);
    layout->addWidget(size_[i], 1, i + 1);
  }
  return box;
}

void ManipulationTab::show(const QString& text) { result_->setText(text); }

// ---------------------------------------------------------------- the lists

void ManipulationTab::robotGone() {
  listing_ = false;
  found_.clear();
  held_.clear();
  in_hand_.clear();
  detected_tables_.clear();
  objects_->clear();
  surfaces_->clear();
  picker_.reset();
  placer_.reset();
  mark();
  enable();
}

void ManipulationTab::moveGroupCame() {
  ros::NodeHandle nh;
  scene_publisher_ = nh.advertise<moveit_msgs::PlanningScene>(dock_->display().named("planning_scene"), 5);
  tables_topic_ = nh.subscribe<object_recognition_msgs::TableArray>(
      "table_array", 1, [this](const object_recognition_msgs::TableArray::ConstPtr& tables) { tablesCame(*tables); });
  objects_topic_ = nh.subscribe<object_recognition_msgs::RecognizedObjectArray>(
      dock_->display().named("recognized_object_array"), 1,
      [this](const object_recognition_msgs::RecognizedObjectArray::ConstPtr&) {
        listing_ = true;
        fillAgain();
      });
}

void ManipulationTab::enable() {
  // From a button that cannot be pressed any more the keys would go on to the numbers below, and the page scroll to them.
  for (const QPushButton* pressed : {detect_, pick_, place_, stop_})
    if (pressed->hasFocus()) objects_->setFocus();
  pick_->setEnabled(!busy() && !chosen(objects_).empty());
  place_->setEnabled(!busy() && !in_hand_.empty() && !chosen(surfaces_).empty());
  stop_->setEnabled(busy());
}

std::string ManipulationTab::chosen(const QListWidget* list) {
  const QList<QListWidgetItem*> items = list->selectedItems();
  return items.empty() ? "" : items.front()->text().toStdString();
}

void ManipulationTab::mark() {
  std::map<std::string, QColor> marked;
  if (!chosen(surfaces_).empty()) marked[chosen(surfaces_)] = SURFACE_COLOR;
  if (!chosen(objects_).empty()) marked[chosen(objects_)] = OBJECT_COLOR;
  dock_->display().markObjects(marked);
}

bool ManipulationTab::inRegion(const Eigen::Vector3d& point) const {
  for (int i = 0; i < 3; ++i)
    if (std::abs(point[i] - centre_[i]->value()) > 0.5 * size_[i]->value()) return false;
  return true;
}

// The object of the group's hand: the first, as a hand mostly has one.
std::string ManipulationTab::held(const planning_scene::PlanningScene& scene) const {
  const std::string group = dock_->display().group();
  std::vector<const moveit::core::AttachedBody*> bodies;
  scene.getCurrentState().getAttachedBodies(bodies);
  if (!scene.getRobotModel()->hasJointModelGroup(group)) return "";
  for (const moveit::core::AttachedBody* body : bodies)
    if (scene.getRobotModel()->getJointModelGroup(group)->isLinkUpdated(body->getAttachedLinkName())) return body->getName();
  return "";
}

void ManipulationTab::sceneShown(const planning_scene::PlanningScene& scene) {
  const std::string now = held(scene);
  if (now != in_hand_) {
    in_hand_ = now;
    enable();
  }
  if (listing_) fill(scene);
}

void ManipulationTab::fill(const planning_scene::PlanningScene& scene) {
  const auto show = [](QListWidget* list, const std::vector<std::string>& names) {
    std::vector<std::string> before;
    for (int i = 0; i < list->count(); ++i) before.push_back(list->item(i)->text().toStdString());
    if (names == before) return;
    const std::string kept = chosen(list);
    list->clear();  // what was chosen and is gone is chosen no more
    for (const std::string& name : names) {
      auto* item = new QListWidgetItem(QString::fromStdString(name), list);
      item->setToolTip(item->text());
      if (name == kept) list->setCurrentItem(item);
    }
  };
  std::vector<std::string> objects, surfaces;
  for (const auto& item : *scene.getWorld())
    if (item.first != planning_scene::PlanningScene::OCTOMAP_NS && !detected_tables_.count(item.first) &&
        inRegion(item.second->pose_.translation()))
      objects.push_back(item.first);
  found_ = surfacesOf(*scene.getWorld());
  for (const Surface& surface : found_)
    if (inRegion(scene.getWorld()->getObject(surface.id)->pose_.translation())) surfaces.push_back(surface.id);
  show(objects_, objects);
  show(surfaces_, surfaces);
}

void ManipulationTab::fillAgain() {
  const auto monitor = dock_->display().monitor();
  if (!listing_ || !monitor) return;
  const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
  fill(*scene.operator->());
}

// ---------------------------------------------------------------- tables

// Tables that a node detected become objects of move_group's scene, in place of those of the last message.
void ManipulationTab::tablesCame(const object_recognition_msgs::TableArray& tables) {
  moveit_msgs::PlanningScene message;
  message.is_diff = message.robot_state.is_diff = true;
  std::set<std::string> names;
  for (const object_recognition_msgs::Table& table : tables.tables) {
    moveit_msgs::CollisionObject object;
    object.id = "table_" + std::to_string(names.size());
    object.header = table.header.frame_id.empty() ? tables.header : table.header;
    object.operation = moveit_msgs::CollisionObject::ADD;
    shapes::ShapeMsg shape;
    const shapes::ShapeConstPtr board = boardOf(table);
    if (!board || !shapes::constructMsgFromShape(board.get(), shape)) {
      dock_->say("a table on the topic table_array has no outline: left out", true);
      continue;
    }
    object.pose = table.pose;
    object.meshes.push_back(boost::get<shape_msgs::Mesh>(shape));
    object.mesh_poses.resize(1);
    object.mesh_poses[0].orientation.w = 1.0;
    message.world.collision_objects.push_back(object);
    names.insert(object.id);
  }
  for (const std::string& name : detected_tables_)
    if (!names.count(name)) {
      moveit_msgs::CollisionObject gone;
      gone.id = name;
      gone.operation = moveit_msgs::CollisionObject::REMOVE;
      message.world.collision_objects.push_back(gone);
    }
  detected_tables_ = names;
  if (!message.world.collision_objects.empty()) scene_publisher_.publish(message);
}

}  // namespace moveit_rviz_plugin
