#include <moveit/common_planning_interface_objects/common_objects.h>

#include <map>
#include <mutex>

#include <moveit/robot_model_loader/robot_model_loader.h>
#include <tf2_ros/transform_listener.h>

namespace moveit {
namespace planning_interface {
namespace {

struct Shared {
  std::mutex mutex;
  std::weak_ptr<tf2_ros::Buffer> tf;
  std::map<std::string, std::weak_ptr<const moveit::core::RobotModel>> models;
  std::map<std::pair<const moveit::core::RobotModel*, std::string>, std::weak_ptr<planning_scene_monitor::CurrentStateMonitor>>
      monitors;
};

// Never destroyed: a program's globals may use it until the very end.
Shared& shared() {
  static Shared* const storage = new Shared;
  return *storage;
}

// A buffer that is fed as long as it is held.
struct ListeningBuffer {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener{buffer};
};

}  // namespace

std::shared_ptr<tf2_ros::Buffer> getSharedTF() {
  const std::lock_guard<std::mutex> lock(shared().mutex);
  std::shared_ptr<tf2_ros::Buffer> buffer = shared().tf.lock();
  if (!buffer) {
    const auto listening = std::make_shared<ListeningBuffer>();
    buffer = std::shared_ptr<tf2_ros::Buffer>(listening, &listening->buffer);
    shared().tf = buffer;
  }
  return buffer;
}

moveit::core::RobotModelConstPtr getSharedRobotModel(const std::string& robot_description) {
  const std::lock_guard<std::mutex> lock(shared().mutex);
  moveit::core::RobotModelConstPtr model = shared().models[robot_description].lock();
  if (model) return model;
  // The loader holds the kinematics plugins: it lives as long as the model.
  const auto loader = std::make_shared<robot_model_loader::RobotModelLoader>(robot_description);
  if (!loader->getModel()) return nullptr;
  model = moveit::core::RobotModelConstPtr(loader, loader->getModel().get());
  shared().models[robot_description] = model;
  return model;
}

planning_scene_monitor::CurrentStateMonitorPtr getSharedStateMonitor(const moveit::core::RobotModelConstPtr& robot_model,
                                                                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer) {
  return getSharedStateMonitor(robot_model, tf_buffer, ros::NodeHandle());
}

planning_scene_monitor::CurrentStateMonitorPtr getSharedStateMonitor(const moveit::core::RobotModelConstPtr& robot_model,
                                                                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                                                                     const ros::NodeHandle& nh) {
  const std::lock_guard<std::mutex> lock(shared().mutex);
  // Robots of one name have states of their own: in two namespaces, or by two descriptions. A monitor keeps its model alive.
  std::weak_ptr<planning_scene_monitor::CurrentStateMonitor>& known = shared().monitors[{robot_model.get(), nh.getNamespace()}];
  planning_scene_monitor::CurrentStateMonitorPtr monitor = known.lock();
  if (!monitor) {
    monitor = std::make_shared<planning_scene_monitor::CurrentStateMonitor>(robot_model, tf_buffer, nh);
    known = monitor;
  }
  return monitor;
}

}  // namespace planning_interface
}  // namespace moveit
