#include "motion_planning_display.hpp"

#include <moveit/robot_state/conversions.h>

#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/display_factory.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <rviz/ogre_helpers/shape.h>
#include <rviz/panel_dock_widget.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/window_manager_interface.h>

#include "dock.hpp"
#include "properties.hpp"

namespace moveit_rviz_plugin {
namespace {
const char* const MARKER_TOPIC = "rviz_moveit_motion_planning_display/robot_interaction_interactive_marker_topic";
constexpr float PLACE_SIZE = 0.02f;  // m, of the dots where something may be put down
}  // namespace

MotionPlanningDisplay::MotionPlanningDisplay() {
  queries_[START].name = "start";
  queries_[GOAL].name = "goal";
  makeProperties();
}

void MotionPlanningDisplay::makeProperties() {
  auto* request = new rviz::Property("Planning Request", QVariant(), "", this);
  metrics_category_ = new rviz::Property("Planning Metrics", QVariant(), "", this);
  auto* path = new rviz::Property("Planned Path", QVariant(), "", this);
  group_ = when(new rviz::EnumProperty("Planning Group", "", "Joints that are planned for", request), this,
                [this]() { groupChanged(); });
  workspace_shown_ = when(new rviz::BoolProperty("Show Workspace", false, "Show the box that planning stays in", request), this,
                          [this]() { placeWorkspace(); });
  makeQueryProperties(request);
  makeMetricsProperties(metrics_category_);
  path_ = std::make_unique<TrajectoryView>(path, this);
}

void MotionPlanningDisplay::makeQueryProperties(rviz::Property* category) {
  const auto visibility = [this]() { applyQueryVisibility(); };
  const auto redraw = [this]() {
    for (Query& query : queries_) query.dirty = true;
  };
  queries_[START].shown =
      when(new rviz::BoolProperty("Query Start State", false, "Set another start state than the present one", category), this,
           visibility);
  queries_[GOAL].shown =
      when(new rviz::BoolProperty("Query Goal State", true, "Show the goal state", category), this, visibility);
  marker_size_ =
      when(new rviz::FloatProperty("Interactive Marker Size", 0.0f, "Of the markers, m; 0: by the size of the hand", category),
           this, [this]() { insertMarkers(); });
  marker_size_->setMin(0.0f);
  const char* titles[] = {"Start State ", "Goal State "};
  const QColor colors[] = {QColor(0, 255, 0), QColor(250, 128, 0)};
  for (const Which which : {START, GOAL}) {
    queries_[which].color =
        when(new rviz::ColorProperty(QString(titles[which]) + "Color", colors[which], "Of this state", category), this, redraw);
    queries_[which].alpha =
        when(new rviz::FloatProperty(QString(titles[which]) + "Alpha", 1.0f, "Opacity", category), this, visibility);
    queries_[which].alpha->setMin(0.0f);
    queries_[which].alpha->setMax(1.0f);
  }
  colliding_color_ = when(new rviz::ColorProperty("Colliding Link Color", QColor(255, 0, 0),
                                                  "Of links that touch something, and "
                                                  "of a robot that cannot reach the marker",
                                                  category),
                          this, redraw);
  violation_color_ = when(new rviz::ColorProperty("Joint Violation Color", QColor(255, 0, 255),
                                                  "Of links below joints that are out of their limits", category),
                          this, redraw);
}

MotionPlanningDisplay::~MotionPlanningDisplay() {
  for (Query& query : queries_) query.follower.reset();
  jobs_.end();
  marker_topics_.clear();
  server_.reset();
  delete marker_display_;
  path_.reset();
  workspace_.reset();
  places_.clear();
  dropMetrics();
  for (Query& query : queries_) query.ghost.reset();
  if (dock_panel_) delete dock_panel_;
  else delete dock_.data();
}

void MotionPlanningDisplay::onInitialize() {
  PlanningSceneDisplay::onInitialize();
  path_->initialize(modelNode(), context_, update_nh_);
  for (const Which which : {START, GOAL}) {
    Query& query = queries_[which];
    query.ghost = std::make_unique<RobotGhost>(modelNode(), context_, query.name, nullptr);
    query.ghost->setVisible(false);
    query.follower = std::make_unique<IkFollower>(
        [this, which](const IkFollower::Answer& answer) { jobs_.later([this, which, answer]() { answered(which, answer); }); });
  }
  workspace_ = std::make_unique<rviz::Shape>(rviz::Shape::Cube, scene_manager_, modelNode());
  workspace_->setColor(0.0f, 0.0f, 0.6f, 0.3f);
  placeWorkspace();
  server_ = std::make_unique<interactive_markers::InteractiveMarkerServer>(MARKER_TOPIC);
  marker_display_ = context_->getDisplayFactory()->make("rviz/InteractiveMarkers");
  marker_display_->initialize(context_);
  marker_display_->subProp("Update Topic")->setValue(QString(MARKER_TOPIC) + "/update");
  marker_display_->subProp("Enable Transparency")->setValue(true);

  rviz::WindowManagerInterface* window = context_->getWindowManager();
  dock_ = new Dock(this, window ? window->getParentWindow() : nullptr);
  if (!window) return;
  dock_panel_ = window->addPane(getName().isEmpty() ? "MotionPlanning" : getName(), dock_.data());
  QObject::connect(dock_panel_, &QObject::destroyed, this, [this]() { dock_panel_ = nullptr; });
}

void MotionPlanningDisplay::setName(const QString& name) {
  PlanningSceneDisplay::setName(name);
  if (dock_panel_) {
    dock_panel_->setWindowTitle(name);
    dock_panel_->setObjectName(name);
  }
  if (path_) path_->rename(name);
}

void MotionPlanningDisplay::load(const rviz::Config& config) {
  PlanningSceneDisplay::load(config);
  if (dock_) dock_->load(config);
}

void MotionPlanningDisplay::save(rviz::Config config) const {
  PlanningSceneDisplay::save(config);
  if (dock_) dock_->save(config);
}

void MotionPlanningDisplay::onEnable() {
  PlanningSceneDisplay::onEnable();
  path_->setEnabled(true);
  marker_display_->setFixedFrame(fixed_frame_);
  marker_display_->setEnabled(true);
  applyQueryVisibility();
  placeWorkspace();
  if (dock_) dock_->setEnabled(true);
}

void MotionPlanningDisplay::onDisable() {
  marker_display_->setEnabled(false);
  path_->setEnabled(false);
  applyQueryVisibility();
  if (dock_) dock_->setEnabled(false);
  PlanningSceneDisplay::onDisable();
}

void MotionPlanningDisplay::fixedFrameChanged() {
  PlanningSceneDisplay::fixedFrameChanged();
  if (marker_display_) marker_display_->setFixedFrame(fixed_frame_);
}

void MotionPlanningDisplay::robotLoaded() {
  for (Query& query : queries_) {
    query.state = std::make_shared<moveit::core::RobotState>(model());
    query.state->setToDefaultValues();
    query.state->update();
    query.ghost->load(*model()->getURDF());
    query.out_of_reach = false;
    query.dirty = true;
  }
  previous_ = query(START);
  path_->setModel(model(), [this]() { return currentState(); });
  const std::string wanted = group_->getStdString();
  const std::vector<std::string>& names = model()->getJointModelGroupNames();
  group_->clearOptions();
  for (const std::string& name : names) group_->addOptionStd(name);
  const bool known = std::find(names.begin(), names.end(), wanted) != names.end();
  last_group_.clear();
  if (!known && !names.empty()) {  // the first that can be dragged
    std::string first = names.front();
    const std::set<std::string> solvable = solvableGroups(*model(), robotDescription());
    for (auto name = names.rbegin(); name != names.rend(); ++name)
      if (!tipsOf(*model(), *model()->getJointModelGroup(*name), solvable).empty()) first = *name;
    group_->setStdString(first);  // calls groupChanged
  }
  if (last_group_.empty()) groupChanged();
  dock_->robotLoaded();
  applyQueryVisibility();
}

void MotionPlanningDisplay::robotGone() {
  marker_topics_.clear();
  object_.clear();
  server_->clear();
  server_->applyChanges();
  path_->setModel(nullptr, nullptr);
  tips_.clear();
  for (Query& query : queries_) {
    query.state.reset();
    query.ghost->clear();
  }
  previous_.reset();
  if (dock_) dock_->robotGone();
}

void MotionPlanningDisplay::moveGroupCame() { dock_->moveGroupCame(); }

void MotionPlanningDisplay::moveGroupGone() {
  if (dock_) dock_->moveGroupGone();
}

void MotionPlanningDisplay::sceneShown(const planning_scene::PlanningScene& scene) {
  for (Query& query : queries_) {
    takeAttached(query, scene.getCurrentState());
    query.dirty = true;  // what touches may be something else now
  }
  if (dock_) dock_->sceneShown(scene);
}

// Start and goal carry what the robot carries.
void MotionPlanningDisplay::takeAttached(Query& query, const moveit::core::RobotState& current) {
  if (!query.state || moveit::core::haveSameAttachedObjects(*query.state, current)) return;
  auto state = std::make_shared<moveit::core::RobotState>(current);
  state->setVariablePositions(query.state->getVariablePositions());
  state->update();
  query.state = state;
}

std::string MotionPlanningDisplay::group() const { return last_group_; }

void MotionPlanningDisplay::setGroup(const std::string& name) {
  if (model() && model()->hasJointModelGroup(name)) group_->setStdString(name);
}

void MotionPlanningDisplay::groupChanged() {
  if (!model()) return;
  const std::string name = group_->getStdString();
  if (!model()->hasJointModelGroup(name)) {
    if (!name.empty())
      setStatusStd(rviz::StatusProperty::Warn, "Planning Group", "The robot has no planning group '" + name + "'");
    tips_.clear();
    return;
  }
  deleteStatus("Planning Group");
  last_group_ = name;
  const moveit::core::RobotModelConstPtr robot = model();
  const std::set<std::string> solvable = solvableGroups(*robot, robotDescription());
  tips_ = tipsOf(*robot, *robot->getJointModelGroup(name), solvable);
  if (solvable.empty())
    setStatusStd(rviz::StatusProperty::Warn, "Kinematics",
                 "No group has a kinematics solver ('" + robotDescription() +
                     "_kinematics', from kinematics.yaml): there is no "
                     "marker to drag; the tab Joints moves the goal");
  else deleteStatus("Kinematics");
  for (Query& query : queries_) query.dirty = true;
  insertMarkers();
  if (dock_) dock_->groupChanged();
}

moveit::core::RobotStatePtr MotionPlanningDisplay::query(Which which) const {
  const moveit::core::RobotStatePtr& state = queries_[which].state;
  return state ? std::make_shared<moveit::core::RobotState>(*state) : nullptr;
}

void MotionPlanningDisplay::setQuery(Which which, const moveit::core::RobotState& state) {
  Query& query = queries_[which];
  if (!query.state || state.getRobotModel() != query.state->getRobotModel()) return;
  query.state = std::make_shared<moveit::core::RobotState>(state);
  query.state->update();
  query.out_of_reach = false;
  query.dirty = true;
  placeMarkers(which);
  if (dock_) dock_->queryChanged(which);
}

bool MotionPlanningDisplay::shown(Which which) const { return queries_[which].shown->getBool(); }

void MotionPlanningDisplay::setWorkspace(const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  workspace_centre_ = centre;
  workspace_size_ = size;
  placeWorkspace();
}

void MotionPlanningDisplay::placeWorkspace() {
  if (!workspace_) return;
  workspace_->setPosition(toOgre(workspace_centre_));
  workspace_->setScale(toOgre(workspace_size_));
  workspace_->getRootNode()->setVisible(isEnabled() && workspace_shown_->getBool());
}

void MotionPlanningDisplay::showPlaces(const std::vector<Eigen::Vector3d>& places) {
  places_.clear();
  for (const Eigen::Vector3d& place : places) {
    auto shape = std::make_unique<rviz::Shape>(rviz::Shape::Sphere, scene_manager_, modelNode());
    shape->setColor(1.0f, 0.0f, 0.0f, 1.0f);
    shape->setScale(Ogre::Vector3(PLACE_SIZE));
    shape->setPosition(toOgre(place));
    places_.push_back(std::move(shape));
  }
}

void MotionPlanningDisplay::update(float wall_dt, float ros_dt) {
  PlanningSceneDisplay::update(wall_dt, ros_dt);
  if (!isEnabled()) return;
  if (markers_changed_) {
    markers_changed_ = false;
    server_->applyChanges();
  }
  marker_display_->update(wall_dt, ros_dt);
  path_->update(wall_dt, ros_dt);
  if (dock_) dock_->update();
  drawQueries();
}

}  // namespace moveit_rviz_plugin
