#include "objects_tab.hpp"

#include <geometric_shapes/mesh_operations.h>
#include <ros/node_handle.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QGroupBox>
#include <QInputDialog>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <fstream>
#include <sstream>

namespace moveit_rviz_plugin {
namespace {
const char* const AXES[] = {"x", "y", "z"};

template <typename Button>
Button* button(const QString& text, const char* name, const char* tip, QWidget* receiver, std::function<void()> clicked) {
  auto* made = new Button;
  made->setText(text);
  made->setObjectName(name);
  made->setToolTip(tip);
  QObject::connect(made, &Button::clicked, receiver, [clicked](bool) { clicked(); });
  return made;
}
}  // namespace

std::pair<std::set<std::string>, std::set<std::string>> ObjectsTab::names(const planning_scene::PlanningScene& scene) {
  std::set<std::string> world, attached;
  for (const std::string& id : scene.getWorld()->getObjectIds())
    if (id != planning_scene::PlanningScene::OCTOMAP_NS) world.insert(id);
  std::vector<const moveit::core::AttachedBody*> bodies;
  scene.getCurrentState().getAttachedBodies(bodies);
  for (const moveit::core::AttachedBody* body : bodies) attached.insert(body->getName());
  return {world, attached};
}

ObjectsTab::ObjectsTab(Dock* dock) : Tab(dock) {
  setObjectName("scene_objects");
  auto* layout = new QGridLayout(this);
  layout->addWidget(makeList(), 0, 0);
  layout->addWidget(makeAdd(), 1, 0);
  auto* right = new QVBoxLayout;
  right->addWidget(makePose());
  auto* status = new QGroupBox("Object status");
  auto* inside = new QVBoxLayout(status);
  status_ = new QLabel;
  status_->setObjectName("object_status");
  status_->setWordWrap(true);
  status_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  inside->addWidget(status_);
  right->addWidget(status, 1);
  layout->addLayout(right, 0, 1);
  layout->addWidget(makeFile(), 1, 1);
  layout->setRowStretch(0, 1);
}

QWidget* ObjectsTab::makeList() {
  auto* box = new QGroupBox("Current Scene Objects");
  auto* layout = new QVBoxLayout(box);
  list_ = new QListWidget;
  list_->setObjectName("collision_objects_list");
  list_->setToolTip("A tick: attached to a link. A double click renames");
  layout->addWidget(list_);
  connect(list_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem*, QListWidgetItem*) {
    if (!filling_) choose();
  });
  connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    if (!filling_) itemChanged(item);
  });
  return box;
}

QWidget* ObjectsTab::makeAdd() {
  auto* box = new QGroupBox("Add/Remove scene object(s)");
  auto* layout = new QGridLayout(box);
  for (int i = 0; i < 3; ++i) {
    sizes_[i] = new QDoubleSpinBox;
    sizes_[i]->setObjectName(QString("shape_size_%1_spin_box").arg(AXES[i]));
    sizes_[i]->setToolTip(i == 0 ? "Edge along x, diameter, or scale of a mesh, m" : QString("Along %1, m").arg(AXES[i]));
    sizes_[i]->setRange(0.001, 1000.0);
    sizes_[i]->setDecimals(3);
    sizes_[i]->setSingleStep(0.05);
    sizes_[i]->setValue(0.2);
    layout->addWidget(sizes_[i], 0, i);
  }
  shapes_ = new QComboBox;
  shapes_->setObjectName("shapes_combo_box");
  shapes_->addItems({"Box", "Sphere", "Cylinder", "Cone", "Mesh from file", "Mesh from URL"});
  auto* row = new QHBoxLayout;
  row->addWidget(shapes_, 1);
  row->addWidget(button<QToolButton>("Add", "add_object_button", "Add the object at the origin", this, [this]() { add(); }));
  row->addWidget(button<QToolButton>("Del", "remove_object_button", "Remove what is chosen", this, [this]() { remove(); }));
  row->addWidget(button<QToolButton>("Clr", "clear_scene_button", "Remove all objects", this, [this]() { clear(); }));
  layout->addLayout(row, 1, 0, 1, 3);
  connect(shapes_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
    sizes_[1]->setEnabled(index == 0);
    sizes_[2]->setEnabled(index == 0 || index == 2 || index == 3);
    if (index >= 4) sizes_[0]->setValue(1.0);
  });
  return box;
}

QWidget* ObjectsTab::makePose() {
  auto* box = new QGroupBox("Change object pose/scale");
  auto* layout = new QGridLayout(box);
  layout->addWidget(new QLabel("Position:"), 0, 0);
  layout->addWidget(new QLabel("Rotation:"), 1, 0);
  for (int i = 0; i < 3; ++i) {
    position_[i] = new QDoubleSpinBox;
    position_[i]->setObjectName(QString("object_") + AXES[i]);
    position_[i]->setRange(-999.99, 999.99);
    rotation_[i] = new QDoubleSpinBox;
    rotation_[i]->setObjectName(QString("object_r") + AXES[i]);
    rotation_[i]->setRange(-3.15, 3.15);
    for (QDoubleSpinBox* number : {position_[i], rotation_[i]}) {
      number->setDecimals(3);
      number->setSingleStep(0.1);
      number->setMinimumWidth(60);
      connect(number, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double) {
        if (!filling_) poseTyped();
      });
    }
    layout->addWidget(position_[i], 0, i + 1);
    layout->addWidget(rotation_[i], 1, i + 1);
  }
  scale_ = new QSlider(Qt::Horizontal);
  scale_->setObjectName("scene_scale");
  scale_->setRange(1, 200);
  scale_->setValue(100);
  layout->addWidget(new QLabel("Scale: 0%"), 2, 0);
  layout->addWidget(scale_, 2, 1, 1, 2);
  layout->addWidget(new QLabel("200%"), 2, 3);
  connect(scale_, &QSlider::valueChanged, this, [this](int percent) {
    if (!filling_) scale(percent);
  });
  connect(scale_, &QSlider::sliderReleased, this, [this]() { choose(); });
  pose_box_ = box;
  box->setEnabled(false);
  return box;
}

QWidget* ObjectsTab::makeFile() {
  auto* box = new QGroupBox("Scene Geometry");
  auto* layout = new QHBoxLayout(box);
  publish_ = button<QPushButton>("&Publish", "publish_current_scene_button", "Send the objects to move_group", this,
                                 [this]() { publish(); });
  layout->addWidget(publish_);
  layout->addWidget(button<QPushButton>("&Export", "export_scene_geometry_text_button", "Write the objects to a .scene file",
                                        this, [this]() { exportText(); }));
  layout->addWidget(button<QPushButton>("&Import", "import_scene_geometry_text_button", "Read objects from a .scene file", this,
                                        [this]() { importText(); }));
  return box;
}

// ---------------------------------------------------------------- the list

void ObjectsTab::robotGone() {
  filling_ = true;
  list_->clear();
  filling_ = false;
  world_.clear();
  attached_.clear();
  removed_.clear();
  edited_ = false;
  publish_->setStyleSheet("");
  pose_box_->setEnabled(false);
}

void ObjectsTab::moveGroupCame() {
  publisher_ = ros::NodeHandle().advertise<moveit_msgs::PlanningScene>(dock_->display().named("planning_scene"), 5);
}

void ObjectsTab::sceneShown(const planning_scene::PlanningScene& scene) {
  const auto [world, attached] = names(scene);
  if (!edited_) {
    known_world_ = world;
    known_attached_ = attached;
  }
  if (world == world_ && attached == attached_) return followChosen(scene);
  world_ = world;
  attached_ = attached;
  fillList(scene);
}

void ObjectsTab::fillList(const planning_scene::PlanningScene& scene) {
  filling_ = true;
  const std::string before = chosen();
  list_->clear();
  for (const auto* ids : {&world_, &attached_})
    for (const std::string& id : *ids) {
      auto* item = new QListWidgetItem(QString::fromStdString(id), list_);
      item->setData(Qt::UserRole, QString::fromStdString(id));
      item->setFlags(item->flags() | Qt::ItemIsUserCheckable | Qt::ItemIsEditable);
      item->setCheckState(ids == &attached_ ? Qt::Checked : Qt::Unchecked);
      if (id == before) list_->setCurrentItem(item);
    }
  filling_ = false;
  dock_->later([this]() { choose(); });  // it may be attached now, or somewhere else
  describe(scene, chosen());
}

// Others may have moved what is chosen here.
void ObjectsTab::followChosen(const planning_scene::PlanningScene& scene) {
  const auto object = scene.getWorld()->getObject(chosen());
  if (object && !object->pose_.isApprox(shown_pose_, 1e-6)) dock_->later([this]() { choose(); });
}

std::string ObjectsTab::chosen() const {
  const QListWidgetItem* item = list_->currentItem();
  return item ? item->data(Qt::UserRole).toString().toStdString() : "";
}

void ObjectsTab::choose() {
  const std::string id = chosen();
  const auto monitor = dock_->display().monitor();
  if (!monitor) return;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double size = 0.2;
  bool there = false;
  {
    const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
    const planning_scene::PlanningSceneConstPtr shown = scene;
    if (const auto object = shown->getWorld()->getObject(id)) {
      there = true;
      pose = object->pose_;
      unscaled_ = object->shapes_;
    }
    describe(*shown, id);
  }
  pose_box_->setEnabled(there);
  filling_ = true;
  scale_->setValue(100);
  filling_ = false;
  if (there) showPose(pose);
  shown_pose_ = pose;
  for (const shapes::ShapeConstPtr& shape : there ? unscaled_ : std::vector<shapes::ShapeConstPtr>())
    if (shape->type == shapes::BOX)
      size = std::max(size, 1.5 * Eigen::Map<const Eigen::Vector3d>(static_cast<const shapes::Box&>(*shape).size).maxCoeff());
  dock_->display().setObjectMarker(there ? id : "", pose, size);
}

void ObjectsTab::markerCleared() {
  if (!chosen().empty()) choose();
}

void ObjectsTab::describe(const planning_scene::PlanningScene& scene, const std::string& id) {
  QString text;
  const auto kinds = [](const std::vector<shapes::ShapeConstPtr>& shapes) {
    std::ostringstream out;
    for (const shapes::ShapeConstPtr& shape : shapes) out << (out.tellp() ? ", " : "") << shape->type;
    return QString::fromStdString(out.str());
  };
  if (const auto object = scene.getWorld()->getObject(id)) {
    text = QString("'%1' is an object of %2 shape(s): %3")
               .arg(QString::fromStdString(id))
               .arg(object->shapes_.size())
               .arg(kinds(object->shapes_));
    for (const auto& frame : object->subframe_poses_) text += "\nsubframe " + QString::fromStdString(frame.first);
  } else if (scene.getCurrentState().hasAttachedBody(id)) {
    const auto* body = scene.getCurrentState().getAttachedBody(id);
    text = QString("'%1' is attached to %2: %3")
               .arg(QString::fromStdString(id), QString::fromStdString(body->getAttachedLinkName()), kinds(body->getShapes()));
  }
  status_->setText(text);
}

void ObjectsTab::itemChanged(QListWidgetItem* item) {
  const std::string id = item->data(Qt::UserRole).toString().toStdString(), text = item->text().trimmed().toStdString();
  if (text != id) return rename(id, text);
  const bool ticked = item->checkState() == Qt::Checked;
  if (ticked && world_.count(id)) attach(id);
  else if (!ticked && attached_.count(id)) detach(id);
}

}  // namespace moveit_rviz_plugin
