// What ObjectsTab does to the scene.
#include <geometric_shapes/mesh_operations.h>
#include <geometric_shapes/shape_operations.h>
#include <moveit/planning_scene/scene_text.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QInputDialog>
#include <QListWidget>
#include <QPushButton>
#include <QSlider>
#include <fstream>
#include <sstream>
#include <tuple>

#include "objects_tab.hpp"

namespace moveit_rviz_plugin {
namespace {
Eigen::Quaterniond turnOf(double x, double y, double z) {
  return Eigen::AngleAxisd(x, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(y, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(z, Eigen::Vector3d::UnitZ());
}
}  // namespace

bool ObjectsTab::change(const std::function<void(planning_scene::PlanningScene&)>& what) {
  const auto monitor = dock_->display().monitor();
  if (!monitor) {
    dock_->say("there is no scene yet", true);
    return false;
  }
  planning_scene_monitor::LockedPlanningSceneRW scene(monitor);
  what(*scene.operator->());
  return true;
}

void ObjectsTab::edited() {
  edited_ = true;
  publish_->setStyleSheet("font: bold");
  dock_->display().sceneEdited();
}

// ---------------------------------------------------------------- add and remove

void ObjectsTab::add() {
  const double x = sizes_[0]->value(), y = sizes_[1]->value(), z = sizes_[2]->value();
  switch (shapes_->currentIndex()) {
    case 0: return addShape("Box", std::make_shared<shapes::Box>(x, y, z));
    case 1: return addShape("Sphere", std::make_shared<shapes::Sphere>(0.5 * x));
    case 2: return addShape("Cylinder", std::make_shared<shapes::Cylinder>(0.5 * x, z));
    case 3: return addShape("Cone", std::make_shared<shapes::Cone>(0.5 * x, z));
    case 4: {
      auto* dialog = new QFileDialog(this, "Mesh", QString(), "Meshes (*.stl *.obj *.dae *.ply);;All files (*)");
      dialog->setAttribute(Qt::WA_DeleteOnClose);
      connect(dialog, &QFileDialog::fileSelected, this,
              [this](const QString& file) { addMesh("file://" + file.toStdString()); });
      return dialog->show();
    }
    default:
      return dock_->ask("Mesh", "URL of the mesh (package://..., file://..., http://...):", "package://",
                        [this](const QString& url) { addMesh(url.toStdString()); });
  }
}

// In the background: the mesh may come from far away.
void ObjectsTab::addMesh(const std::string& resource) {
  const double scale = sizes_[0]->value();
  dock_->inBackground([this, resource, scale]() {
    const shapes::ShapeConstPtr mesh(shapes::createMeshFromResource(resource, Eigen::Vector3d::Constant(scale)));
    if (!mesh) throw std::runtime_error("no mesh could be read from " + resource);
    dock_->later([this, resource, mesh]() {
      const std::size_t slash = resource.find_last_of('/');
      addShape(resource.substr(slash + 1, resource.find_last_of('.') - slash - 1), mesh);
    });
  });
}

void ObjectsTab::addShape(const std::string& kind, const shapes::ShapeConstPtr& shape) {
  std::string id;
  for (int number = 0; id.empty() || world_.count(id) || attached_.count(id); ++number)
    id = kind + "_" + std::to_string(number);
  if (!change([&](planning_scene::PlanningScene& scene) {
        scene.getWorldNonConst()->addToObject(id, Eigen::Isometry3d::Identity(), shape, Eigen::Isometry3d::Identity());
        world_.insert(id);
        fillList(scene);
      }))
    return;
  removed_.erase(id);
  for (int row = 0; row < list_->count(); ++row)
    if (list_->item(row)->text().toStdString() == id) list_->setCurrentRow(row);
  edited();
}

void ObjectsTab::remove() {
  const std::string id = chosen();
  if (id.empty()) return dock_->say("choose an object first", true);
  change([&](planning_scene::PlanningScene& scene) {
    scene.getWorldNonConst()->removeObject(id);
    scene.getCurrentStateNonConst().clearAttachedBody(id);
    scene.removeObjectColor(id);
  });
  removed_.insert(id);
  edited();
}

void ObjectsTab::clear() {
  if (!change([](planning_scene::PlanningScene& scene) { scene.removeAllCollisionObjects(); })) return;
  removed_.insert(world_.begin(), world_.end());
  edited();
}

void ObjectsTab::rename(const std::string& from, const std::string& to) {
  const bool taken = to.empty() || world_.count(to) || attached_.count(to);
  if (taken || !world_.count(from)) {
    dock_->say(taken ? "'" + to + "' cannot be a name: it is empty, or taken" : "an attached object cannot be renamed", true);
    world_.clear();  // the list is filled anew
    return dock_->display().sceneEdited();
  }
  change([&](planning_scene::PlanningScene& scene) {
    const auto object = scene.getWorld()->getObject(from);
    scene.getWorldNonConst()->addToObject(to, object->pose_, object->shapes_, object->shape_poses_);
    scene.getWorldNonConst()->setSubframesOfObject(to, object->subframe_poses_);
    if (scene.hasObjectColor(from)) scene.setObjectColor(to, scene.getObjectColor(from));
    scene.getWorldNonConst()->removeObject(from);
  });
  removed_.insert(from);
  removed_.erase(to);
  edited();
}

// ---------------------------------------------------------------- poses

void ObjectsTab::showPose(const Eigen::Isometry3d& pose) {
  filling_ = true;
  const Eigen::Vector3d turn = pose.linear().eulerAngles(0, 1, 2);
  for (int i = 0; i < 3; ++i) {
    position_[i]->setValue(pose.translation()[i]);
    rotation_[i]->setValue(turn[i]);
  }
  filling_ = false;
}

void ObjectsTab::poseTyped() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) pose.translation()[i] = position_[i]->value();
  pose.linear() = turnOf(rotation_[0]->value(), rotation_[1]->value(), rotation_[2]->value()).toRotationMatrix();
  setPose(pose);
  dock_->display().moveObjectMarker(pose);
}

void ObjectsTab::dragged(const Eigen::Isometry3d& pose) {
  showPose(pose);
  setPose(pose);
}

void ObjectsTab::setPose(const Eigen::Isometry3d& pose) {
  const std::string id = chosen();
  shown_pose_ = pose;
  if (change([&](planning_scene::PlanningScene& scene) { scene.getWorldNonConst()->setObjectPose(id, pose); })) edited();
}

void ObjectsTab::scale(int percent) {
  const std::string id = chosen();
  change([&](planning_scene::PlanningScene& scene) {
    const auto object = scene.getWorld()->getObject(id);
    if (!object || object->shapes_.size() != unscaled_.size()) return;
    std::vector<shapes::ShapeConstPtr> scaled;
    for (const shapes::ShapeConstPtr& shape : unscaled_) {
      shapes::ShapePtr copy(shape->clone());
      copy->scale(percent / 100.0);
      scaled.push_back(copy);
    }
    scene.getWorldNonConst()->removeObject(id);
    scene.getWorldNonConst()->addToObject(id, object->pose_, scaled, object->shape_poses_);
    scene.getWorldNonConst()->setSubframesOfObject(id, object->subframe_poses_);
  });
  edited();
}

// ---------------------------------------------------------------- attach and detach

void ObjectsTab::attach(const std::string& id) {
  const auto model = dock_->display().model();
  QStringList links;
  for (const std::string& name : model->getLinkModelNames()) links << QString::fromStdString(name);
  auto* dialog = new QInputDialog(this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle("Select Link Name");
  dialog->setLabelText("Link that '" + QString::fromStdString(id) + "' is attached to:");
  dialog->setComboBoxItems(links);
  if (!dock_->display().tips().empty()) dialog->setTextValue(QString::fromStdString(dock_->display().tips().front().link));
  connect(dialog, &QInputDialog::textValueSelected, this, [this, id](const QString& link) {
    moveit_msgs::AttachedCollisionObject message;
    message.link_name = link.toStdString();
    message.object.id = id;
    message.object.operation = moveit_msgs::CollisionObject::ADD;
    message.touch_links.push_back(message.link_name);
    change([&](planning_scene::PlanningScene& scene) { scene.processAttachedCollisionObjectMsg(message); });
    edited();
  });
  connect(dialog, &QInputDialog::rejected, this, [this]() {
    world_.clear();  // the tick goes
    dock_->display().sceneEdited();
  });
  dialog->show();
}

void ObjectsTab::detach(const std::string& id) {
  moveit_msgs::AttachedCollisionObject message;
  message.object.id = id;
  message.object.operation = moveit_msgs::CollisionObject::REMOVE;
  change([&](planning_scene::PlanningScene& scene) { scene.processAttachedCollisionObjectMsg(message); });
  edited();
}

// ---------------------------------------------------------------- to move_group, to files

void ObjectsTab::publishIfEdited() {
  if (edited_) publish();
}

// What is here, and what move_group has and is here no more.
void ObjectsTab::publish() {
  moveit_msgs::PlanningScene message;
  message.is_diff = message.robot_state.is_diff = true;
  const auto monitor = dock_->display().monitor();
  if (!monitor || !publisher_) return dock_->say("there is no move_group to publish the scene to", true);
  change([this](planning_scene::PlanningScene& scene) {  // what move_group said of them meanwhile was said before it knew
    for (const std::string& id : removed_)
      if (scene.getWorld()->hasObject(id)) scene.getWorldNonConst()->removeObject(id);
  });
  known_world_.insert(removed_.begin(), removed_.end());
  removed_.clear();
  {
    const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
    message.name = scene->getName();
    scene->getCollisionObjectMsgs(message.world.collision_objects);
    scene->getAttachedCollisionObjectMsgs(message.robot_state.attached_collision_objects);
    scene->getObjectColorMsgs(message.object_colors);
    for (const std::string& id : known_attached_)
      if (!scene->getCurrentState().hasAttachedBody(id)) {
        moveit_msgs::AttachedCollisionObject gone;
        gone.object.id = id;
        gone.object.operation = moveit_msgs::CollisionObject::REMOVE;
        message.robot_state.attached_collision_objects.push_back(gone);
      }
    for (const std::string& id : known_world_)
      if (!scene->getWorld()->hasObject(id) && !scene->getCurrentState().hasAttachedBody(id)) {
        moveit_msgs::CollisionObject gone;
        gone.id = id;
        gone.operation = moveit_msgs::CollisionObject::REMOVE;
        message.world.collision_objects.push_back(gone);
      }
    for (const std::string& id : known_attached_)  // detached and removed here: there it falls into the world first
      if (!scene->getWorld()->hasObject(id) && !scene->getCurrentState().hasAttachedBody(id)) {
        moveit_msgs::CollisionObject gone;
        gone.id = id;
        gone.operation = moveit_msgs::CollisionObject::REMOVE;
        message.world.collision_objects.push_back(gone);
      }
    std::tie(known_world_, known_attached_) =
        names(*scene.operator->());  // move_group has them now, whenever its scene comes back
  }
  publisher_.publish(message);
  edited_ = false;
  publish_->setStyleSheet("");
}

void ObjectsTab::useScene(const moveit_msgs::PlanningScene& stored) {
  moveit_msgs::PlanningScene objects;
  objects.is_diff = objects.robot_state.is_diff = true;
  objects.name = stored.name;
  objects.world = stored.world;
  objects.object_colors = stored.object_colors;
  const bool good = change([&](planning_scene::PlanningScene& scene) {
    scene.removeAllCollisionObjects();
    scene.setPlanningSceneDiffMsg(objects);
  });
  if (!good) return;
  edited();
  publish();
}

void ObjectsTab::exportText() {
  const auto monitor = dock_->display().monitor();
  if (!monitor) return;
  auto* dialog = new QFileDialog(this, "Export Scene Geometry", QString(), "Scene Geometry (*.scene)");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix("scene");
  connect(dialog, &QFileDialog::fileSelected, this, [this, monitor](const QString& file) {
    moveit_msgs::PlanningScene message;
    {
      const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
      message.name = scene->getName();
      scene->getCollisionObjectMsgs(message.world.collision_objects);
      scene->getObjectColorMsgs(message.object_colors);
    }
    std::ofstream out(file.toStdString());
    out << planning_scene::writeScene(message);
    out.close();
    dock_->say((out ? "The objects are in " : "No scene can be written to ") + file.toStdString(), !out);
  });
  dialog->show();
}

void ObjectsTab::importText() {
  auto* dialog = new QFileDialog(this, "Import Scene Geometry", QString(), "Scene Geometry (*.scene);;All files (*)");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
    const auto model = dock_->display().model();
    if (!model) return;
    dock_->inBackground([this, path = file.toStdString(), frame = model->getModelFrame()]() {
      std::ifstream in(path);
      if (!in) throw std::runtime_error(path + " cannot be read");
      std::ostringstream text;
      text << in.rdbuf();
      moveit_msgs::PlanningScene message;
      try {
        message = planning_scene::readScene(text.str(), frame);
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(path + ", " + error.what());
      }
      dock_->later([this, message]() {
        if (change([&](planning_scene::PlanningScene& scene) { scene.setPlanningSceneDiffMsg(message); })) edited();
      });
    });
  });
  dialog->show();
}

}  // namespace moveit_rviz_plugin
