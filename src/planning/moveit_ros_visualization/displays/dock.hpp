// The panel of MotionPlanning: tabs, and what they share.
#pragma once

#include <moveit/planning_scene/planning_scene.h>

#include <QTabWidget>
#include <QWidget>
#include <functional>
#include <memory>
#include <rviz/config.h>
#include <string>
#include <vector>

#include "motion_planning_display.hpp"

class QProgressBar;

namespace moveit_rviz_plugin {
class ContextTab;
class Dock;
class ManipulationTab;
class ObjectsTab;
class PlanningTab;
class StatusTab;
class Warehouse;

// One tab. The functions are called in the window's thread when something has happened.
class Tab : public QWidget {
 public:
  explicit Tab(Dock* dock) : dock_(dock) {}
  virtual void robotLoaded() {}
  virtual void robotGone() {}
  virtual void moveGroupCame() {}
  virtual void moveGroupGone() {}
  virtual void groupChanged() {}
  virtual void queryChanged(Which /*which*/, bool /*by_hand*/) {}
  virtual void sceneShown(const planning_scene::PlanningScene& /*scene*/) {}
  virtual void load(const rviz::Config& /*config*/) {}
  virtual void save(rviz::Config /*config*/) const {}
  virtual void warehouseChanged() {}
  virtual void update() {}

 protected:
  Dock* dock_;
};

class Dock : public QWidget {
 public:
  Dock(MotionPlanningDisplay* display, QWidget* parent);
  ~Dock() override;

  MotionPlanningDisplay& display() { return *display_; }
  ContextTab& context() { return *context_; }
  PlanningTab& planning() { return *planning_; }
  ObjectsTab& objects() { return *objects_; }
  // A line for the tab Status; also from other threads.
  void say(const std::string& line, bool error = false);
  // In the background; errors are said.
  void inBackground(std::function<void()> job);
  void later(std::function<void()> job) { display_->jobs().later(std::move(job)); }
  // The database, opened when first needed; in the background only. Throws std::runtime_error.
  Warehouse& warehouse();
  void useWarehouse(const std::string& host);
  void warehouseChanged();
  void ask(const QString& title, const QString& label, const QString& preset, std::function<void(const QString&)> answered);

  void robotLoaded();
  void robotGone();
  void moveGroupCame();
  void moveGroupGone();
  void groupChanged();
  void queryChanged(Which which);
  void queryDragged(Which which);
  void sceneShown(const planning_scene::PlanningScene& scene);
  void markersCleared();
  void objectDragged(const Eigen::Isometry3d& pose);
  void load(const rviz::Config& config);
  void save(rviz::Config config) const;
  void update();

  // What the buttons do.
  void setQueryTo(Which which, const std::string& state);
  void plan();
  void execute();
  void planAndExecute();
  void stop();

 private:
  MotionPlanningDisplay* display_;
  QTabWidget* tabs_;
  QProgressBar* progress_;
  ContextTab* context_;
  PlanningTab* planning_;
  ObjectsTab* objects_;
  ManipulationTab* manipulation_;
  StatusTab* status_;
  std::vector<Tab*> all_;
  std::unique_ptr<Warehouse> warehouse_;
  std::string host_;
};

}  // namespace moveit_rviz_plugin
