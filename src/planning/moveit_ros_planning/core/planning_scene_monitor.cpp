#include <moveit/planning_scene_monitor/planning_scene_monitor.h>

#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <optional>

#include <moveit/utils/message_checks.h>
#include <moveit/utils/xmlrpc_casts.h>

#include "dynamic_settings.hpp"
#include "log_names.hpp"

namespace planning_scene_monitor
{
namespace
{
using Lock = boost::unique_lock<boost::shared_mutex>;
using Value = XmlRpc::XmlRpcValue;
using moveit_ros_planning::DynamicSettings;

// A number of the parameters; what is none is told, and left out.
std::optional<double> number(const std::string& where, const Value& value)
{
  try
  {
    const double given = moveit::core::parseDouble(value);
    if (std::isfinite(given))
      return given;
  }
  catch (const XmlRpc::XmlRpcException&)
  {
  }
  ROS_WARN_NAMED(log_names::PLANNING_SCENE_MONITOR, "%s: ignored, a number is expected", where.c_str());
  return std::nullopt;
}

double parameter(const std::string& where, double otherwise)
{
  Value value;
  return ros::param::get(where, value) ? number(where, value).value_or(otherwise) : otherwise;
}

// {link: number} of the links that there are.
std::map<std::string, double> linkParameters(const std::string& where, const moveit::core::RobotModel& model)
{
  std::map<std::string, double> numbers;
  Value table;
  if (!ros::param::get(where, table) || table.getType() != Value::TypeStruct)
    return numbers;
  for (const auto& [link, value] : table)
    if (model.hasLinkModel(link))
      if (const std::optional<double> given = number(where + "/" + link, value))
        numbers[link] = *given;
  return numbers;
}

std::string word(Value& table, const char* key)
{
  return table.getType() == Value::TypeStruct && table.hasMember(key) && table[key].getType() == Value::TypeString
             ? static_cast<std::string&>(table[key])
             : std::string();
}

// Pairs that may touch, or are looked at again, whatever the SRDF says.
void setCollisionOperations(const std::string& where, collision_detection::AllowedCollisionMatrix& acm)
{
  Value list;
  if (!ros::param::get(where, list))
    return;
  if (list.getType() != Value::TypeArray)
  {
    ROS_WARN_NAMED(log_names::PLANNING_SCENE_MONITOR, "default_collision_operations is not an array");
    return;
  }
  for (int i = 0; i < list.size(); ++i)
  {
    const std::string one = word(list[i], "object1"), other = word(list[i], "object2"), operation = word(list[i], "operation");
    if (one.empty() || other.empty() || operation.empty())
      ROS_WARN_NAMED(log_names::PLANNING_SCENE_MONITOR, "All collision operations must have two objects and an operation");
    else
      acm.setEntry(one, other, operation == "disable");
  }
}
}  // namespace

const std::string PlanningSceneMonitor::DEFAULT_JOINT_STATES_TOPIC = "joint_states";
const std::string PlanningSceneMonitor::DEFAULT_ATTACHED_COLLISION_OBJECT_TOPIC = "attached_collision_object";
const std::string PlanningSceneMonitor::DEFAULT_COLLISION_OBJECT_TOPIC = "collision_object";
const std::string PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_WORLD_TOPIC = "planning_scene_world";
const std::string PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_TOPIC = "planning_scene";
const std::string PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_SERVICE = "get_planning_scene";
const std::string PlanningSceneMonitor::MONITORED_PLANNING_SCENE_TOPIC = "monitored_planning_scene";

PlanningSceneMonitor::PlanningSceneMonitor(const std::string& robot_description, const Buffer& tf_buffer,
                                           const std::string& name)
  : PlanningSceneMonitor(planning_scene::PlanningScenePtr(), robot_description, tf_buffer, name)
{
}

PlanningSceneMonitor::PlanningSceneMonitor(const robot_model_loader::RobotModelLoaderPtr& rml, const Buffer& tf_buffer,
                                           const std::string& name)
  : PlanningSceneMonitor(planning_scene::PlanningScenePtr(), rml, tf_buffer, name)
{
}

PlanningSceneMonitor::PlanningSceneMonitor(const planning_scene::PlanningScenePtr& scene, const std::string& robot_description,
                                           const Buffer& tf_buffer, const std::string& name)
  : PlanningSceneMonitor(scene, std::make_shared<robot_model_loader::RobotModelLoader>(robot_description), tf_buffer, name)
{
}

PlanningSceneMonitor::PlanningSceneMonitor(const planning_scene::PlanningScenePtr& scene,
                                           const robot_model_loader::RobotModelLoaderPtr& rml, const Buffer& tf_buffer,
                                           const std::string& name)
  : name_(name.empty() ? "planning_scene_monitor" : name)
  , loader_(rml)
  , robot_model_(rml->getModel())
  , tf_buffer_(tf_buffer)
{
  nh_.setCallbackQueue(&queue_);
  initialize(scene);
  spinner_.reset(new ros::AsyncSpinner(1, &queue_));
  spinner_->start();
  ros::NodeHandle own(moveit_ros_planning::freeNamespace(name_));
  own.setCallbackQueue(&queue_);  // answers in a program that does not spin
  settings_ = std::make_unique<DynamicSettings>(own, execution::sceneParameters(), log_names::PLANNING_SCENE_MONITOR,
                                                [this](const DynamicSettings::Values& given) { configurePublishing(given); });
}

PlanningSceneMonitor::~PlanningSceneMonitor()
{
  settings_.reset();
  stopStateMonitor();
  stopSceneMonitor();
  stopWorldGeometryMonitor();
  service_.shutdown();
  spinner_->stop();
}

void PlanningSceneMonitor::initialize(const planning_scene::PlanningScenePtr& scene)
{
  scene_ = scene;
  if (!scene_ && robot_model_)
  {
    scene_ = std::make_shared<planning_scene::PlanningScene>(robot_model_);
    configureScene();
  }
  scene_const_ = scene_;
  if (!scene_)
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE_MONITOR, "Robot model not loaded: there is no planning scene");
}

void PlanningSceneMonitor::configureScene()
{
  const std::string prefix = getRobotDescription() + "_planning/default_";
  defaults_.robot_padding = parameter(prefix + "robot_padding", 0.0);
  defaults_.robot_scale = parameter(prefix + "robot_scale", 1.0);
  defaults_.object_padding = parameter(prefix + "object_padding", 0.0);
  defaults_.attached_padding = parameter(prefix + "attached_padding", 0.0);
  collision_detection::CollisionEnv& env = *scene_->getCollisionEnvNonConst();
  try
  {
    if (defaults_.robot_padding != 0.0)
      env.setPadding(defaults_.robot_padding);
    if (defaults_.robot_scale != 1.0)
      env.setScale(defaults_.robot_scale);
    env.setLinkPadding(linkParameters(prefix + "robot_link_padding", *robot_model_));
    env.setLinkScale(linkParameters(prefix + "robot_link_scale", *robot_model_));
  }
  catch (const std::runtime_error& error)  // of a shape that nothing would be left of
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE_MONITOR, "%srobot_...: ignored, %s", prefix.c_str(), error.what());
  }
  setCollisionOperations(prefix + "collision_operations", scene_->getAllowedCollisionMatrixNonConst());
}

planning_scene::PlanningScenePtr PlanningSceneMonitor::copyPlanningScene(const moveit_msgs::PlanningScene& diff)
{
  if (!scene_)
    return nullptr;
  planning_scene::PlanningScenePtr copy;
  {
    const boost::shared_lock<boost::shared_mutex> reading(mutex_);
    copy = planning_scene::PlanningScene::clone(scene_);
  }
  if (!moveit::core::isEmpty(diff))
    copy->setPlanningSceneDiffMsg(diff);
  return copy;
}

template <typename Change>
void PlanningSceneMonitor::change(SceneUpdateType type, const Change& what)
{
  if (!scene_)
    return;
  updateFrameTransforms();
  {
    const Lock lock(mutex_);
    last_update_time_ = ros::Time::now();
    what();
  }
  triggerSceneUpdateEvent(type);
}

// ---------------------------------------------------------------- states

void PlanningSceneMonitor::startStateMonitor(const std::string& joint_states_topic, const std::string& attached_objects_topic)
{
  stopStateMonitor();
  if (!scene_)
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE_MONITOR, "Cannot monitor robot state because planning scene is not configured");
    return;
  }
  if (!states_)
    states_ = std::make_shared<CurrentStateMonitor>(robot_model_, tf_buffer_, ros::NodeHandle());
  states_->addUpdateCallback([this](const sensor_msgs::JointStateConstPtr&) {
    if (ros::WallTime::now() - last_state_update_ < state_period_)
      return;
    last_state_update_ = ros::WallTime::now();
    updateSceneWithCurrentState();
  });
  states_->startStateMonitor(joint_states_topic);
  if (!attached_objects_topic.empty())
    attached_subscriber_ = nh_.subscribe<moveit_msgs::AttachedCollisionObject>(
        attached_objects_topic, 1024, [this](const moveit_msgs::AttachedCollisionObjectConstPtr& object) {
          change(UPDATE_GEOMETRY, [&]() { scene_->processAttachedCollisionObjectMsg(*object); });
        });
}

void PlanningSceneMonitor::stopStateMonitor()
{
  if (states_)
  {
    states_->clearUpdateCallbacks();
    states_->stopStateMonitor();
  }
  attached_subscriber_.shutdown();
}

void PlanningSceneMonitor::setStateUpdateFrequency(double hz) { state_period_ = ros::WallDuration(hz > 0.0 ? 1.0 / hz : 0.0); }

void PlanningSceneMonitor::updateSceneWithCurrentState()
{
  if (!states_ || !scene_)
  {
    ROS_ERROR_THROTTLE_NAMED(1, log_names::PLANNING_SCENE_MONITOR,
                             "State monitor is not active. Unable to set the planning scene state");
    return;
  }
  {
    const Lock lock(mutex_);
    last_update_time_ = ros::Time::now();
    states_->setToCurrentState(scene_->getCurrentStateNonConst());
    scene_->getCurrentStateNonConst().update();
  }
  triggerSceneUpdateEvent(UPDATE_STATE);
}

bool PlanningSceneMonitor::waitForCurrentRobotState(const ros::Time& t, double wait_time)
{
  if (!states_)
    return false;
  const bool heard = states_->waitForCurrentState(t, wait_time);
  updateSceneWithCurrentState();
  if (!heard)
    ROS_WARN_NAMED(log_names::PLANNING_SCENE_MONITOR, "Failed to fetch current robot state.");
  return heard;
}

// ---------------------------------------------------------------- scenes and objects

void PlanningSceneMonitor::startSceneMonitor(const std::string& scene_topic)
{
  stopSceneMonitor();
  if (!scene_topic.empty())
    scene_subscriber_ = nh_.subscribe<moveit_msgs::PlanningScene>(
        scene_topic, 100, [this](const moveit_msgs::PlanningSceneConstPtr& scene) { newPlanningSceneMessage(*scene); });
}

bool PlanningSceneMonitor::newPlanningSceneMessage(const moveit_msgs::PlanningScene& scene)
{
  bool good = false;
  change(UPDATE_SCENE, [&]() { good = scene_->usePlanningSceneMsg(scene); });
  return good;
}

void PlanningSceneMonitor::startWorldGeometryMonitor(const std::string& collision_objects_topic,
                                                     const std::string& planning_scene_world_topic,
                                                     const bool /*load_octomap_monitor*/)
{
  stopWorldGeometryMonitor();
  if (!collision_objects_topic.empty())
    object_subscriber_ = nh_.subscribe<moveit_msgs::CollisionObject>(
        collision_objects_topic, 1024, [this](const moveit_msgs::CollisionObjectConstPtr& object) {
          change(UPDATE_GEOMETRY, [&]() { scene_->processCollisionObjectMsg(*object); });
        });
  if (!planning_scene_world_topic.empty())
    world_subscriber_ = nh_.subscribe<moveit_msgs::PlanningSceneWorld>(
        planning_scene_world_topic, 1, [this](const moveit_msgs::PlanningSceneWorldConstPtr& world) {
          change(UPDATE_SCENE, [&]() {
            scene_->getWorldNonConst()->clearObjects();
            scene_->processPlanningSceneWorldMsg(*world);
          });
        });
}

void PlanningSceneMonitor::stopWorldGeometryMonitor()
{
  object_subscriber_.shutdown();
  world_subscriber_.shutdown();
}

bool PlanningSceneMonitor::requestPlanningSceneState(const std::string& service_name)
{
  ros::ServiceClient client = ros::NodeHandle().serviceClient<moveit_msgs::GetPlanningScene>(service_name);
  moveit_msgs::GetPlanningScene call;
  using Components = moveit_msgs::PlanningSceneComponents;
  call.request.components.components =
      Components::SCENE_SETTINGS | Components::ROBOT_STATE | Components::ROBOT_STATE_ATTACHED_OBJECTS |
      Components::WORLD_OBJECT_NAMES | Components::WORLD_OBJECT_GEOMETRY | Components::OCTOMAP | Components::TRANSFORMS |
      Components::ALLOWED_COLLISION_MATRIX | Components::LINK_PADDING_AND_SCALING | Components::OBJECT_COLORS;
  if (!client.waitForExistence(ros::Duration(5.0)) || !client.call(call))
  {
    ROS_INFO_NAMED(log_names::PLANNING_SCENE_MONITOR,
                   "Failed to call service %s, have you launched move_group or called psm.providePlanningSceneService()?",
                   service_name.c_str());
    return false;
  }
  return newPlanningSceneMessage(call.response.scene);
}

void PlanningSceneMonitor::clearOctomap()
{
  change(UPDATE_GEOMETRY, [&]() { scene_->getWorldNonConst()->removeObject(planning_scene::PlanningScene::OCTOMAP_NS); });
}

void PlanningSceneMonitor::getMonitoredTopics(std::vector<std::string>& topics) const
{
  topics.clear();
  if (states_ && states_->isActive())
    topics.push_back(states_->getMonitoredTopic());
  for (const ros::Subscriber* subscriber :
       { &scene_subscriber_, &object_subscriber_, &world_subscriber_, &attached_subscriber_ })
    if (*subscriber)
      topics.push_back(subscriber->getTopic());
}

// All frames of TF that are no links.
void PlanningSceneMonitor::updateFrameTransforms()
{
  if (!tf_buffer_ || !scene_)
    return;
  std::vector<std::string> frames;
  tf_buffer_->_getFrameStrings(frames);
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const std::string& frame : frames)
  {
    if (frame == scene_->getPlanningFrame() || robot_model_->hasLinkModel(frame))
      continue;
    try
    {
      transforms.push_back(tf_buffer_->lookupTransform(scene_->getPlanningFrame(), frame, ros::Time(0)));
    }
    catch (const tf2::TransformException&)
    {
      continue;  // of another tree
    }
    transforms.back().header.frame_id = frame;  // the planning scene's notation, the other way round than TF's
    transforms.back().child_frame_id = scene_->getPlanningFrame();
  }
  const Lock lock(mutex_);
  scene_->getTransformsNonConst().setTransforms(transforms);
}

// ---------------------------------------------------------------- others

void PlanningSceneMonitor::addUpdateCallback(const boost::function<void(SceneUpdateType)>& fn)
{
  const boost::recursive_mutex::scoped_lock lock(callbacks_mutex_);
  if (fn)
    callbacks_.push_back(fn);
}

void PlanningSceneMonitor::clearUpdateCallbacks()
{
  const boost::recursive_mutex::scoped_lock lock(callbacks_mutex_);
  callbacks_.clear();
}

void PlanningSceneMonitor::triggerSceneUpdateEvent(SceneUpdateType update_type)
{
  const boost::recursive_mutex::scoped_lock lock(callbacks_mutex_);
  for (const auto& callback : callbacks_)
    callback(update_type);
  if (!publisher_ || !(published_events_ & update_type) || publishing_frequency_ <= 0.0 ||
      (update_type == UPDATE_STATE && ros::WallTime::now() - last_published_ < ros::WallDuration(1.0 / publishing_frequency_)))
    return;
  last_published_ = ros::WallTime::now();
  moveit_msgs::PlanningScene message;
  {
    const boost::shared_lock<boost::shared_mutex> reading(mutex_);
    scene_->getPlanningSceneMsg(message);
  }
  publisher_.publish(message);
}

// As upstream: a client that changes anything says all of what is published, whatever the program had asked for.
void PlanningSceneMonitor::configurePublishing(const std::map<std::string, double>& given)
{
  if (given.at("publish_planning_scene") == 0.0)
    return stopPublishingPlanningScene();
  int kinds = UPDATE_NONE;
  for (const auto& [name, kind] :
       { std::pair("publish_geometry_updates", UPDATE_GEOMETRY), std::pair("publish_state_updates", UPDATE_STATE),
         std::pair("publish_transforms_updates", UPDATE_TRANSFORMS) })
    kinds |= given.at(name) != 0.0 ? kind : UPDATE_NONE;
  setPlanningScenePublishingFrequency(given.at("publish_planning_scene_hz"));
  startPublishingPlanningScene(static_cast<SceneUpdateType>(kinds));
}

void PlanningSceneMonitor::stopPublishingPlanningScene()
{
  const boost::recursive_mutex::scoped_lock lock(callbacks_mutex_);
  publisher_.shutdown();
}

void PlanningSceneMonitor::startPublishingPlanningScene(SceneUpdateType event, const std::string& planning_scene_topic)
{
  const boost::recursive_mutex::scoped_lock lock(callbacks_mutex_);
  published_events_ = event;
  publisher_ = nh_.advertise<moveit_msgs::PlanningScene>(planning_scene_topic, 100, true);
  ROS_INFO_NAMED(log_names::PLANNING_SCENE_MONITOR, "Publishing maintained planning scene on '%s'",
                 planning_scene_topic.c_str());
  if (scene_)
    triggerSceneUpdateEvent(UPDATE_SCENE);
}

void PlanningSceneMonitor::providePlanningSceneService(const std::string& service_name)
{
  const boost::function<bool(moveit_msgs::GetPlanningScene::Request&, moveit_msgs::GetPlanningScene::Response&)> answer =
      [this](moveit_msgs::GetPlanningScene::Request& request, moveit_msgs::GetPlanningScene::Response& response) {
        if (!scene_)
          return false;
        const boost::shared_lock<boost::shared_mutex> reading(mutex_);
        if (request.components.components)
          scene_->getPlanningSceneMsg(response.scene, request.components);
        else
          scene_->getPlanningSceneMsg(response.scene);
        return true;
      };
  service_ = nh_.advertiseService<moveit_msgs::GetPlanningScene::Request, moveit_msgs::GetPlanningScene::Response>(service_name,
                                                                                                                   answer);
}
}  // namespace planning_scene_monitor
