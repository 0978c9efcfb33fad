#include "scene_display.hpp"

#include <moveit/robot_state/conversions.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/service.h>
#include <ros/this_node.h>

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/robot/robot.h>

#include <chrono>

#include "properties.hpp"

namespace moveit_rviz_plugin {
namespace {
constexpr char LOGNAME[] = "moveit_rviz_plugin";
constexpr auto PATIENCE = std::chrono::milliseconds(300);  // between looks at who has come

void setQuietly(rviz::StringProperty* property, const std::string& text) {
  const bool blocked = property->blockSignals(true);
  property->setStdString(text);
  property->blockSignals(blocked);
}

// A master that was started anew does not know this process, and roscpp does not tell it: nothing that RViz publishes or
// subscribes to will ever reach anybody again.
bool masterKnowsUs() {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = request[1] = ros::this_node::getName();
  return ros::master::execute("lookupNode", request, response, payload, false);
}

// What keeps this display from move_group; "" if nothing does.
std::string missing(const std::string& service) {
  const bool there = ros::service::exists(service, false);
  if (!there && !ros::master::check()) return "Waiting for the ROS master at " + ros::master::getURI();
  if (!masterKnowsUs()) return "The ROS master was started anew and does not know this RViz: close RViz and start it again";
  return there ? "" : "Waiting for move_group: nobody offers " + ros::names::resolve(service) + " yet";
}
}  // namespace

PlanningSceneDisplay::PlanningSceneDisplay() {
  move_group_ns_ = when(new rviz::StringProperty("Move Group Namespace", "", "Namespace in which move_group runs", this), this,
                        [this]() { startLoading(); });
  robot_description_ =
      when(new rviz::StringProperty("Robot Description", "robot_description", "Parameter that holds the URDF", this), this,
           [this]() { startLoading(); });
  scene_topic_ = when(new rviz::RosTopicProperty("Planning Scene Topic", "move_group/monitored_planning_scene",
                                                 ros::message_traits::datatype<moveit_msgs::PlanningScene>(),
                                                 "Topic of the planning scene", this),
                      this, [this]() { listen(); });
  makeSceneProperties();
  makeRobotProperties();
}

void PlanningSceneDisplay::makeSceneProperties() {
  const auto again = [this]() { dirty_ = true; };
  scene_category_ = new rviz::Property("Scene Geometry", QVariant(), "", this);
  scene_name_ = new rviz::StringProperty("Scene Name", "(noname)", "Name of the planning scene", scene_category_);
  scene_name_->setShouldBeSaved(false);
  when(scene_name_, this, [this]() {
    if (!monitor_) return;
    planning_scene_monitor::LockedPlanningSceneRW scene(monitor_);
    scene->setName(scene_name_->getStdString());
  });
  scene_enabled_ = when(new rviz::BoolProperty("Show Scene Geometry", true, "Show objects", scene_category_), this,
                        [this]() { applyVisibility(); });
  scene_alpha_ = when(new rviz::FloatProperty("Scene Alpha", 1.0f, "Opacity of objects", scene_category_), this, again);
  scene_alpha_->setMin(0.0f);
  scene_alpha_->setMax(1.0f);
  scene_color_ = when(
      new rviz::ColorProperty("Scene Color", QColor(50, 230, 50), "Of objects without a colour of their own", scene_category_),
      this, again);
  voxel_rendering_ =
      when(new rviz::EnumProperty("Voxel Rendering", "Occupied Voxels", "Which voxels", scene_category_), this, again);
  voxel_rendering_->addOption("Occupied Voxels", static_cast<int>(VoxelRendering::Occupied));
  voxel_rendering_->addOption("Free Voxels", static_cast<int>(VoxelRendering::Free));
  voxel_rendering_->addOption("All Voxels", static_cast<int>(VoxelRendering::All));
  voxel_coloring_ = when(new rviz::EnumProperty("Voxel Coloring", "Z-Axis", "What colours mean", scene_category_), this, again);
  voxel_coloring_->addOption("Z-Axis", static_cast<int>(VoxelColoring::ZAxis));
  voxel_coloring_->addOption("Cell Probability", static_cast<int>(VoxelColoring::Probability));
  scene_display_time_ = new rviz::FloatProperty("Scene Display Time", 0.01f, "Wall time between updates, s", scene_category_);
  scene_display_time_->setMin(0.0001f);
}

void PlanningSceneDisplay::makeRobotProperties() {
  const auto visibility = [this]() { applyVisibility(); };
  robot_category_ = new rviz::Property("Scene Robot", QVariant(), "", this);
  robot_visual_ =
      when(new rviz::BoolProperty("Show Robot Visual", true, "Show the robot's meshes", robot_category_), this, visibility);
  robot_collision_ = when(
      new rviz::BoolProperty("Show Robot Collision", false, "Show the shapes that collide", robot_category_), this, visibility);
  robot_alpha_ = when(new rviz::FloatProperty("Robot Alpha", 1.0f, "Opacity of the robot", robot_category_), this, [this]() {
    if (scene_robot_) scene_robot_->setAlpha(robot_alpha_->getFloat());
  });
  robot_alpha_->setMin(0.0f);
  robot_alpha_->setMax(1.0f);
  attached_color_ =
      when(new rviz::ColorProperty("Attached Body Color", QColor(150, 50, 150), "Of attached objects", robot_category_), this,
           [this]() {
             if (scene_robot_) scene_robot_->setAttachedColor(attached_color_->getColor());
           });
}

PlanningSceneDisplay::~PlanningSceneDisplay() {
  ++generation_;
  jobs_.end();
  monitor_.reset();
  scene_view_.reset();
  scene_robot_.reset();
  if (model_node_) scene_manager_->destroySceneNode(model_node_);
}

void PlanningSceneDisplay::onInitialize() {
  model_node_ = scene_node_->createChildSceneNode();
  scene_view_ = std::make_unique<SceneView>(scene_manager_, model_node_);
  scene_robot_ = std::make_unique<RobotGhost>(model_node_, context_, "Planning Scene", robot_category_);
  scene_robot_->setAlpha(robot_alpha_->getFloat());
  applyVisibility();
}

// Before 2022 "Show Robot Visual" was called "Show Scene Robot".
void PlanningSceneDisplay::load(const rviz::Config& config) {
  Display::load(config);
  bool shown = true;
  const rviz::Config robot = config.mapGetChild("Scene Robot");
  if (robot.mapGetBool("Show Scene Robot", &shown)) robot_visual_->setBool(shown);
}

void PlanningSceneDisplay::onEnable() {
  applyVisibility();
  if (!monitor_) startLoading();
  else listen();
}

void PlanningSceneDisplay::onDisable() {
  ++generation_;
  if (monitor_) monitor_->stopSceneMonitor();
}

void PlanningSceneDisplay::reset() {
  Display::reset();
  startLoading();
}

void PlanningSceneDisplay::setTopic(const QString& topic, const QString& /*datatype*/) { scene_topic_->setString(topic); }

void PlanningSceneDisplay::fixedFrameChanged() { placeModel(); }

void PlanningSceneDisplay::applyVisibility() {
  if (!scene_robot_) return;
  const bool on = isEnabled();
  scene_view_->setVisible(on && scene_enabled_->getBool());
  scene_robot_->setVisualVisible(robot_visual_->getBool());
  scene_robot_->setCollisionVisible(robot_collision_->getBool());
  scene_robot_->setVisible(on && scene_robot_->loaded());
  dirty_ = true;
}

moveit::core::RobotModelConstPtr PlanningSceneDisplay::model() const {
  return monitor_ ? monitor_->getRobotModel() : moveit::core::RobotModelConstPtr();
}

std::string PlanningSceneDisplay::robotDescription() const { return robot_description_->getStdString(); }

std::string PlanningSceneDisplay::named(const std::string& name) const {
  const std::string ns = move_group_ns_->getStdString();
  return ns.empty() ? name : ros::names::append(ns, name);
}

moveit::core::RobotStatePtr PlanningSceneDisplay::currentState() const {
  if (!monitor_) return nullptr;
  const planning_scene_monitor::LockedPlanningSceneRO scene(monitor_);
  return std::make_shared<moveit::core::RobotState>(scene->getCurrentState());
}

// ---------------------------------------------------------------- the robot

void PlanningSceneDisplay::tell(rviz::StatusProperty::Level level, const std::string& about, const std::string& text) {
  jobs_.later([this, level, about, text]() { setStatusStd(level, about, text); });
}

void PlanningSceneDisplay::forget() {
  if (monitor_) robotGone();
  monitor_.reset();
  if (move_group_there_) moveGroupGone();
  move_group_there_ = false;
  scene_view_->clear();
  scene_robot_->clear();
}

void PlanningSceneDisplay::startLoading() {
  const int generation = ++generation_;
  if (!initialized() || !isEnabled()) return;
  forget();
  const std::string description = robotDescription();
  jobs_.add([this, generation, description, name = getNameStd() + "_planning_scene_monitor"]() {
    loadInBackground(generation, description, name);
  });
}

void PlanningSceneDisplay::loadInBackground(int generation, const std::string& description, const std::string& name) {
  const auto stale = [this, generation]() { return jobs_.ending() || generation != generation_ || !ros::ok(); };
  const ros::NodeHandle nh("~");
  std::string key;
  while (!nh.searchParam(description, key)) {
    const std::string line = "Waiting for a robot: there is no parameter '" + description +
                             "' yet (launch the robot, or "
                             "set Robot Description)";
    if (told_robot_.news(line)) ROS_WARN_NAMED(LOGNAME, "%s", line.c_str());
    tell(rviz::StatusProperty::Warn, "Robot Model", line);
    if (stale()) return;
    std::this_thread::sleep_for(PATIENCE);
  }
  if (stale()) return;
  const auto loader = std::make_shared<robot_model_loader::RobotModelLoader>(description, false);
  if (!loader->getModel()) {
    tell(rviz::StatusProperty::Error, "Robot Model",
         loader->getURDF() ? "The robot in '" + key + "' cannot be used: the terminal says why"
                           : "The text in '" + key + "' is no URDF (check_urdf says where)");
    return;
  }
  const auto monitor = std::make_shared<planning_scene_monitor::PlanningSceneMonitor>(loader, nullptr, name);
  if (stale()) return;
  jobs_.later([this, generation, monitor]() {
    if (generation == generation_) adopt(monitor);
  });
}

void PlanningSceneDisplay::adopt(const planning_scene_monitor::PlanningSceneMonitorPtr& monitor) {
  monitor_ = monitor;
  const std::string errors = scene_robot_->load(*model()->getURDF());
  scene_robot_->setAlpha(robot_alpha_->getFloat());
  scene_robot_->setAttachedColor(attached_color_->getColor());
  applyVisibility();
  if (!errors.empty()) setStatusStd(rviz::StatusProperty::Warn, "Robot Model", "Not shown: " + errors);
  else if (model()->getJointModelGroups().empty())
    setStatusStd(rviz::StatusProperty::Warn, "Robot Model",
                 "No planning groups: the SRDF in '" + robotDescription() + "_semantic' is missing, or names none");
  else setStatusStd(rviz::StatusProperty::Ok, "Robot Model", model()->getName());
  monitor_->addUpdateCallback([this](planning_scene_monitor::PlanningSceneMonitor::SceneUpdateType) { dirty_ = true; });
  robotLoaded();
  listen();
}

// ---------------------------------------------------------------- the scene

void PlanningSceneDisplay::listen() {
  if (!monitor_ || !isEnabled()) return;
  const int generation = ++generation_;
  monitor_->startSceneMonitor(scene_topic_->getTopicStd());
  jobs_.spawn([this, generation]() { watchMoveGroup(generation); });
}

// As long as this scene is listened to: asks for the whole of it whenever move_group comes.
void PlanningSceneDisplay::watchMoveGroup(int generation) {
  const std::string service = named(planning_scene_monitor::PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_SERVICE);
  const planning_scene_monitor::PlanningSceneMonitorPtr monitor = monitor_;
  bool there = false, first = true;
  while (!jobs_.ending() && generation == generation_ && ros::ok()) {
    const std::string line = missing(service);
    const bool now = line.empty();
    if (now && !there) {
      if (!monitor->requestPlanningSceneState(service)) {
        std::this_thread::sleep_for(PATIENCE);
        continue;
      }
      tell(rviz::StatusProperty::Ok, "Planning Scene", "From " + service);
      told_waiting_.news("");
    } else if (!now) {
      const bool news = told_waiting_.news(line);
      if (news) ROS_WARN_NAMED(LOGNAME, "%s", line.c_str());
      if (news || there || first) tell(rviz::StatusProperty::Warn, "Planning Scene", line);
    }
    if (now != there || first)
      jobs_.later([this, generation, now]() {
        if (generation != generation_) return;
        const auto srdf = monitor_->getRobotModelLoader()->getSRDF();
        const std::string semantic = robotDescription() + "_semantic";
        std::string key;
        // The SRDF often comes with move_group, after the robot: its groups are wanted.
        if (now && (!srdf || srdf->getName().empty()) && ros::param::search(semantic, key) &&
            told_robot_.news("Loading the robot again: " + key + " has come"))
          return startLoading();
        const bool before = move_group_there_;
        move_group_there_ = now;
        if (now != before) now ? moveGroupCame() : moveGroupGone();
      });
    there = now;
    first = false;
    for (int i = 0; i < (there ? 5 : 1) && !jobs_.ending() && generation == generation_; ++i)
      std::this_thread::sleep_for(PATIENCE);
  }
}

void PlanningSceneDisplay::placeModel() {
  if (!model()) return;
  const std::string frame = model()->getModelFrame();
  Ogre::Vector3 position = Ogre::Vector3::ZERO;
  Ogre::Quaternion orientation = Ogre::Quaternion::IDENTITY;
  if (frame != fixed_frame_.toStdString() &&
      !context_->getFrameManager()->getTransform(frame, ros::Time(0), position, orientation)) {
    setStatusStd(rviz::StatusProperty::Error, "Transform",
                 "No transform from the robot's frame '" + frame + "' to the fixed frame '" + fixed_frame_.toStdString() + "'");
    return;
  }
  deleteStatus("Transform");
  model_node_->setPosition(position);
  model_node_->setOrientation(orientation);
}

void PlanningSceneDisplay::showScene() {
  SceneView::Style style;
  style.color = scene_color_->getColor();
  style.alpha = scene_alpha_->getFloat();
  style.marked = marked_;
  style.voxels.rendering = static_cast<VoxelRendering>(voxel_rendering_->getOptionInt());
  style.voxels.coloring = static_cast<VoxelColoring>(voxel_coloring_->getOptionInt());
  const planning_scene_monitor::LockedPlanningSceneRO scene(monitor_);
  const planning_scene::PlanningSceneConstPtr shown = scene;
  setQuietly(scene_name_, shown->getName());
  if (scene_enabled_->getBool()) scene_view_->show(*shown, style);
  scene_robot_->show(shown->getCurrentState());
  sceneShown(*shown);
}

void PlanningSceneDisplay::update(float wall_dt, float ros_dt) {
  Display::update(wall_dt, ros_dt);
  jobs_.runLater();
  if (!monitor_ || !isEnabled()) return;
  placeModel();
  since_shown_ += wall_dt;
  if (since_shown_ < scene_display_time_->getFloat() || !dirty_.exchange(false)) return;
  since_shown_ = 0.0f;
  showScene();
}

}  // namespace moveit_rviz_plugin
