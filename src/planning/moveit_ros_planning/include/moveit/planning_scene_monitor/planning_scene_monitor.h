// A scene that is kept up to date: by joint states, objects, scene messages and TF.
#pragma once

#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/CollisionObject.h>
#include <moveit_msgs/GetPlanningScene.h>
#include <moveit_msgs/PlanningScene.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <boost/function.hpp>
#include <boost/noncopyable.hpp>
#include <boost/thread/recursive_mutex.hpp>
#include <boost/thread/shared_mutex.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/planning_scene/planning_scene.h>
#include <moveit/planning_scene_monitor/current_state_monitor.h>
#include <moveit/robot_model_loader/robot_model_loader.h>

namespace moveit_ros_planning
{
class DynamicSettings;
}

namespace planning_scene_monitor
{
MOVEIT_CLASS_FORWARD(PlanningSceneMonitor);

// Takes messages in a thread of its own. Read and change the scene through LockedPlanningSceneRO and RW.
class PlanningSceneMonitor : private boost::noncopyable
{
public:
  enum SceneUpdateType
  {
    UPDATE_NONE = 0,
    UPDATE_STATE = 1,
    UPDATE_TRANSFORMS = 2,
    UPDATE_GEOMETRY = 4,
    UPDATE_SCENE = 8 + UPDATE_STATE + UPDATE_TRANSFORMS + UPDATE_GEOMETRY
  };
  static const std::string DEFAULT_JOINT_STATES_TOPIC, DEFAULT_ATTACHED_COLLISION_OBJECT_TOPIC, DEFAULT_COLLISION_OBJECT_TOPIC,
      DEFAULT_PLANNING_SCENE_WORLD_TOPIC, DEFAULT_PLANNING_SCENE_TOPIC, DEFAULT_PLANNING_SCENE_SERVICE,
      MONITORED_PLANNING_SCENE_TOPIC;

  using Buffer = std::shared_ptr<tf2_ros::Buffer>;
  // Without a robot description there is no scene: getPlanningScene() is null, and the log says why.
  PlanningSceneMonitor(const std::string& robot_description, const Buffer& tf_buffer = Buffer(), const std::string& name = "");
  PlanningSceneMonitor(const robot_model_loader::RobotModelLoaderPtr& rml, const Buffer& tf_buffer = Buffer(),
                       const std::string& name = "");
  PlanningSceneMonitor(const planning_scene::PlanningScenePtr& scene, const std::string& robot_description,
                       const Buffer& tf_buffer = Buffer(), const std::string& name = "");
  PlanningSceneMonitor(const planning_scene::PlanningScenePtr& scene, const robot_model_loader::RobotModelLoaderPtr& rml,
                       const Buffer& tf_buffer = Buffer(), const std::string& name = "");
  ~PlanningSceneMonitor();

  const std::string& getName() const { return name_; }
  const robot_model_loader::RobotModelLoaderPtr& getRobotModelLoader() const { return loader_; }
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  const std::string& getRobotDescription() const { return loader_->getRobotDescription(); }
  const planning_scene::PlanningScenePtr& getPlanningScene() { return scene_; }
  const planning_scene::PlanningSceneConstPtr& getPlanningScene() const { return scene_const_; }
  // One of its own, with what the message changes; the monitor's stays as it is.
  planning_scene::PlanningScenePtr copyPlanningScene(const moveit_msgs::PlanningScene& diff = moveit_msgs::PlanningScene());
  bool updatesScene(const planning_scene::PlanningSceneConstPtr& scene) const { return scene == scene_; }
  bool updatesScene(const planning_scene::PlanningScenePtr& scene) const { return scene == scene_; }
  // Of the parameters <robot_description>_planning/default_..., m and factors.
  double getDefaultRobotPadding() const { return defaults_.robot_padding; }
  double getDefaultRobotScale() const { return defaults_.robot_scale; }
  double getDefaultObjectPadding() const { return defaults_.object_padding; }
  double getDefaultAttachedObjectPadding() const { return defaults_.attached_padding; }
  const Buffer& getTFClient() const { return tf_buffer_; }
  const CurrentStateMonitorPtr& getStateMonitor() const { return states_; }
  CurrentStateMonitorPtr& getStateMonitorNonConst() { return states_; }

  // ------------------------------------------------------------ what is listened to
  void startStateMonitor(const std::string& joint_states_topic = DEFAULT_JOINT_STATES_TOPIC,
                         const std::string& attached_objects_topic = DEFAULT_ATTACHED_COLLISION_OBJECT_TOPIC);
  void stopStateMonitor();
  void startSceneMonitor(const std::string& scene_topic = DEFAULT_PLANNING_SCENE_TOPIC);
  void stopSceneMonitor() { scene_subscriber_.shutdown(); }
  // Sensors are read by move_group alone: its octomaps come with its scene.
  void startWorldGeometryMonitor(const std::string& collision_objects_topic = DEFAULT_COLLISION_OBJECT_TOPIC,
                                 const std::string& planning_scene_world_topic = DEFAULT_PLANNING_SCENE_WORLD_TOPIC,
                                 const bool load_octomap_monitor = true);
  void stopWorldGeometryMonitor();
  // Asks another node, move_group, for its scene. False when it does not answer within 5 s.
  bool requestPlanningSceneState(const std::string& service_name = DEFAULT_PLANNING_SCENE_SERVICE);
  void getMonitoredTopics(std::vector<std::string>& topics) const;
  void setStateUpdateFrequency(double hz);
  double getStateUpdateFrequency() const { return state_period_.isZero() ? 0.0 : 1.0 / state_period_.toSec(); }

  // ------------------------------------------------------------ what is told to others
  void startPublishingPlanningScene(SceneUpdateType event,
                                    const std::string& planning_scene_topic = MONITORED_PLANNING_SCENE_TOPIC);
  void stopPublishingPlanningScene();
  void setPlanningScenePublishingFrequency(double hz) { publishing_frequency_ = hz; }
  double getPlanningScenePublishingFrequency() const { return publishing_frequency_; }
  void providePlanningSceneService(const std::string& service_name = DEFAULT_PLANNING_SCENE_SERVICE);
  void addUpdateCallback(const boost::function<void(SceneUpdateType)>& fn);
  void clearUpdateCallbacks();
  void triggerSceneUpdateEvent(SceneUpdateType update_type);

  void updateSceneWithCurrentState();
  void updateFrameTransforms();
  bool newPlanningSceneMessage(const moveit_msgs::PlanningScene& scene);
  void clearOctomap();
  const ros::Time& getLastUpdateTime() const { return last_update_time_; }
  // Until the state is not older than t; at most wait_time s.
  bool waitForCurrentRobotState(const ros::Time& t, double wait_time = 1.);

  void lockSceneRead() { mutex_.lock_shared(); }
  void unlockSceneRead() { mutex_.unlock_shared(); }
  void lockSceneWrite() { mutex_.lock(); }
  void unlockSceneWrite() { mutex_.unlock(); }

private:
  void initialize(const planning_scene::PlanningScenePtr& scene);
  void configureScene();
  void configurePublishing(const std::map<std::string, double>& given);
  template <typename Change>
  void change(SceneUpdateType type, const Change& what);

  std::string name_;
  robot_model_loader::RobotModelLoaderPtr loader_;
  moveit::core::RobotModelConstPtr robot_model_;
  planning_scene::PlanningScenePtr scene_;
  planning_scene::PlanningSceneConstPtr scene_const_;  // the same
  struct Defaults
  {
    double robot_padding = 0.0, robot_scale = 1.0, object_padding = 0.0, attached_padding = 0.0;
  } defaults_;
  Buffer tf_buffer_;
  CurrentStateMonitorPtr states_;
  boost::shared_mutex mutex_;
  boost::recursive_mutex callbacks_mutex_;
  std::vector<boost::function<void(SceneUpdateType)>> callbacks_;
  ros::Time last_update_time_;
  ros::WallTime last_state_update_, last_published_;
  ros::WallDuration state_period_{ 0.03 };
  std::atomic<double> publishing_frequency_{ 2.0 };
  int published_events_ = UPDATE_NONE;
  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  ros::Subscriber scene_subscriber_, world_subscriber_, object_subscriber_, attached_subscriber_;
  ros::Publisher publisher_;
  ros::ServiceServer service_;
  std::unique_ptr<moveit_ros_planning::DynamicSettings> settings_;
};

// A scene that stays as it is while this, or a copy of it, lives. Without a monitor there is nothing to lock, and no scene.
class LockedPlanningSceneRO
{
public:
  LockedPlanningSceneRO(const PlanningSceneMonitorPtr& planning_scene_monitor)
    : LockedPlanningSceneRO(planning_scene_monitor, true)
  {
  }
  const PlanningSceneMonitorPtr& getPlanningSceneMonitor() { return planning_scene_monitor_; }
  operator bool() const { return planning_scene_monitor_ && planning_scene_monitor_->getPlanningScene(); }
  operator const planning_scene::PlanningSceneConstPtr&() const { return scene(); }
  const planning_scene::PlanningSceneConstPtr& operator->() const { return scene(); }

protected:
  LockedPlanningSceneRO(const PlanningSceneMonitorPtr& planning_scene_monitor, bool read_only)
    : planning_scene_monitor_(planning_scene_monitor)
  {
    if (!planning_scene_monitor_)
      return;
    PlanningSceneMonitor& locked = *planning_scene_monitor_;
    if (read_only)
      locked.lockSceneRead();
    else
      locked.lockSceneWrite();
    lock_ = std::shared_ptr<void>(nullptr, [monitor = planning_scene_monitor, read_only](void*) {
      if (read_only)
        monitor->unlockSceneRead();
      else
        monitor->unlockSceneWrite();
    });
  }

  PlanningSceneMonitorPtr planning_scene_monitor_;

private:
  const planning_scene::PlanningSceneConstPtr& scene() const
  {
    return static_cast<const PlanningSceneMonitor&>(*planning_scene_monitor_).getPlanningScene();
  }

  std::shared_ptr<void> lock_;
};

// The same to change it: nobody else reads it meanwhile. It goes wherever one to read goes.
class LockedPlanningSceneRW : public LockedPlanningSceneRO
{
public:
  LockedPlanningSceneRW(const PlanningSceneMonitorPtr& planning_scene_monitor)
    : LockedPlanningSceneRO(planning_scene_monitor, false)
  {
  }
  operator const planning_scene::PlanningScenePtr&() { return planning_scene_monitor_->getPlanningScene(); }
  const planning_scene::PlanningScenePtr& operator->() { return planning_scene_monitor_->getPlanningScene(); }
};
}  // namespace planning_scene_monitor
