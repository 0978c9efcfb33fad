// What the buttons of ManipulationTab do: recognition, grasps, and move_group's pick and place, asked in threads of their own.
#include <moveit/robot_state/conversions.h>
#include <moveit/utils/moveit_error_code.h>
#include <moveit_msgs/GraspPlanning.h>
#include <ros/master.h>
#include <ros/service.h>
#include <tf2_eigen/tf2_eigen.h>

#include <QLabel>
#include <QListWidget>
#include <QPushButton>

#include "manipulation_tab.hpp"
#include "objects_tab.hpp"
#include "planning_tab.hpp"

namespace moveit_rviz_plugin {
namespace {
const char* const RECOGNIZER = "/recognize_objects";
const char* const GRASP_PLANNER = "plan_grasps";
constexpr double LEAST_WAY = 0.1, WAY = 0.2;  // m, straight down before an object is put down, and back after it

bool served(const std::string& action) {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  return std::any_of(topics.begin(), topics.end(),
                     [&action](const ros::master::TopicInfo& topic) { return topic.name == action + "/status"; });
}

moveit_msgs::GripperTranslation reversed(moveit_msgs::GripperTranslation way) {
  for (double* part : {&way.direction.vector.x, &way.direction.vector.y, &way.direction.vector.z}) *part = -*part;
  return way;
}

std::string inQuotes(const std::string& name) { return "'" + name + "'"; }
}  // namespace

void ManipulationTab::inThread(std::function<void()> job) {
  ++busy_;
  stopped_ = false;
  enable();
  dock_->display().jobs().spawn([this, job]() {
    try {
      job();
    } catch (const std::exception& error) {
      ended(error.what(), false);
    }
    --busy_;
    dock_->later([this]() { enable(); });
  });
}

void ManipulationTab::ended(const std::string& result, bool good) {
  if (!good) dock_->say(result, true);
  dock_->later([this, result]() { show(QString::fromStdString(result)); });
}

// The client that has the result of a success; otherwise it is said what went wrong.
template <typename Action>
std::shared_ptr<typename ActionCall<Action>::Client> ManipulationTab::run(ActionCall<Action>& call, const char* name,
                                                                          const typename ActionCall<Action>::Goal& goal) {
  std::string why;
  const auto client = call.run(dock_->display().jobs(), dock_->display().named(name), goal,
                               "is move_group running, with its capability for picking and placing?", why);
  if (client) {
    const moveit_msgs::MoveItErrorCodes code = client->getResult()->error_code;
    if (code.val == moveit_msgs::MoveItErrorCodes::SUCCESS) return client;
    why = moveit::core::MoveItErrorCode::toString(code);
    const std::string text = client->getState().getText();
    if (!text.empty()) why += ": " + text;
  }
  ended((stopped_ ? "Stopped: " : "Failed: ") + why, false);
  return nullptr;
}

void ManipulationTab::stop() {
  stopped_ = true;
  picker_.cancel();
  placer_.cancel();
  dock_->stop();
}

// ---------------------------------------------------------------- detect

void ManipulationTab::detect() {
  if (!dock_->display().monitor()) return dock_->say("there is no scene yet", true);
  dock_->objects().publishIfEdited();
  listing_ = true;
  fillAgain();
  enable();
  detect_->setEnabled(false);
  show("Detecting...");
  inThread([this]() {
    recognize();
    dock_->later([this]() {
      detect_->setEnabled(true);
      fillAgain();
    });
  });
}

void ManipulationTab::recognize() {
  if (!served(RECOGNIZER))
    return ended(std::string("Listed is what the scene has: no node recognizes objects (action ") + RECOGNIZER + ")", true);
  std::string why;
  const auto client = recognizer_.run(dock_->display().jobs(), RECOGNIZER, object_recognition_msgs::ObjectRecognitionGoal(),
                                      "is its node running?", why);
  if (client && client->getState() != actionlib::SimpleClientGoalState::SUCCEEDED)
    why = client->getState().toString() + " " + client->getState().getText();
  if (!client || client->getState() != actionlib::SimpleClientGoalState::SUCCEEDED)
    return ended("Objects were not recognized: " + why, false);
  const std::size_t count = client->getResult()->recognized_objects.objects.size();
  ended("Recognized: " + std::to_string(count) + (count == 1 ? " object" : " objects"), true);
}

// ---------------------------------------------------------------- pick

void ManipulationTab::pick() {
  MotionPlanningDisplay& display = dock_->display();
  const std::string name = chosen(objects_);
  if (busy() || name.empty() || !display.query(START)) return;
  if (display.group().empty()) return dock_->say("choose a planning group first", true);
  dock_->objects().publishIfEdited();
  const moveit_msgs::MoveGroupGoal asked = dock_->planning().goal(false);
  Pick wanted;
  wanted.goal.target_name = name;
  wanted.goal.group_name = display.group();
  wanted.goal.support_surface_name = chosen(surfaces_);
  {
    const planning_scene_monitor::LockedPlanningSceneRO scene(display.monitor());
    const auto object = scene->getWorld()->getObject(name);
    if (!object || !scene->getCollisionObjectMsg(wanted.object, name))
      return ended("Failed: the scene has no object " + inQuotes(name) + " any more", false);
    wanted.turn = Eigen::Quaterniond(object->pose_.linear());
    if (wanted.goal.support_surface_name.empty() || wanted.goal.support_surface_name == name)
      wanted.goal.support_surface_name = surfaceBelow(found_, *object);
    const std::vector<std::string>& ends =
        scene->getRobotModel()->getJointModelGroup(wanted.goal.group_name)->getAttachedEndEffectorNames();
    if (ends.size() == 1) wanted.goal.end_effector = ends.front();
  }
  wanted.goal.allow_gripper_support_collision = !wanted.goal.support_surface_name.empty();
  wanted.goal.path_constraints = asked.request.path_constraints;
  wanted.goal.planner_id = asked.request.planner_id;
  wanted.goal.allowed_planning_time = asked.request.allowed_planning_time;
  wanted.goal.planning_options = asked.planning_options;
  show(QString::fromStdString("Picking up " + inQuotes(name) + "..."));
  inThread([this, wanted]() { runPick(wanted); });
}

// Grasps of a grasp planner where there is one; otherwise move_group makes its own.
void ManipulationTab::runPick(Pick pick) {
  const std::string service = dock_->display().named(GRASP_PLANNER);
  std::string by = "move_group's own grasp";
  if (ros::service::exists(service, false)) {
    moveit_msgs::GraspPlanning planning;
    planning.request.group_name = pick.goal.group_name;
    planning.request.target = pick.object;
    planning.request.support_surfaces.push_back(pick.goal.support_surface_name);
    if (!ros::service::call(service, planning)) return ended("Failed: nobody answers " + ros::names::resolve(service), false);
    if (planning.response.error_code.val != moveit_msgs::MoveItErrorCodes::SUCCESS || planning.response.grasps.empty())
      return ended("Failed: " + ros::names::resolve(service) + " has no grasp for " + inQuotes(pick.goal.target_name), false);
    pick.goal.possible_grasps = planning.response.grasps;
    by = "a grasp of " + ros::names::resolve(service);
  }
  const auto client = run(picker_, "pickup", pick.goal);
  if (!client) return;
  const moveit_msgs::Grasp grasp = client->getResult()->grasp;
  dock_->later([this, pick, grasp]() { held_[pick.goal.target_name] = {pick.turn, grasp}; });
  ended("Picked up " + inQuotes(pick.goal.target_name) + " by " + by, true);
}

// ---------------------------------------------------------------- place

// How an object goes down and the hand leaves it: the way that the hand came and went when it was picked up here; otherwise
// straight down, and back along the hand's x axis.
moveit_msgs::PlaceLocation ManipulationTab::location(const std::string& object) const {
  moveit_msgs::PlaceLocation location;
  const auto known = held_.find(object);
  if (known != held_.end()) {
    location.pre_place_approach = reversed(known->second.grasp.post_grasp_retreat);
    location.post_place_retreat = reversed(known->second.grasp.pre_grasp_approach);
  } else {
    location.pre_place_approach.direction.header.frame_id = dock_->display().model()->getModelFrame();
    location.pre_place_approach.direction.vector.z = -1.0;
    location.pre_place_approach.min_distance = LEAST_WAY;
    location.pre_place_approach.desired_distance = WAY;
    location.post_place_retreat.direction.vector.x = -1.0;
    location.post_place_retreat.desired_distance = WAY;
  }
  return location;
}

void ManipulationTab::place() {
  MotionPlanningDisplay& display = dock_->display();
  const std::string on = chosen(surfaces_);
  if (busy() || on.empty() || in_hand_.empty() || !display.query(START)) return;
  dock_->objects().publishIfEdited();
  const moveit_msgs::MoveGroupGoal asked = dock_->planning().goal(false);
  const auto surface = std::find_if(found_.begin(), found_.end(), [&on](const Surface& one) { return one.id == on; });
  moveit_msgs::PlaceGoal goal;
  goal.group_name = display.group();
  goal.attached_object_name = in_hand_;
  goal.support_surface_name = on;
  goal.allow_gripper_support_collision = true;
  goal.path_constraints = asked.request.path_constraints;
  goal.planner_id = asked.request.planner_id;
  goal.allowed_planning_time = asked.request.allowed_planning_time;
  goal.planning_options = asked.planning_options;
  std::vector<Eigen::Vector3d> points;
  {
    const planning_scene_monitor::LockedPlanningSceneRO scene(display.monitor());
    const moveit::core::AttachedBody* body = scene->getCurrentState().getAttachedBody(in_hand_);
    if (!body || surface == found_.end()) return ended("Failed: " + inQuotes(body ? on : in_hand_) + " is gone", false);
    const auto known = held_.find(in_hand_);
    Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();  // upright, where nothing else is known
    if (known != held_.end()) turned.linear() = known->second.turn.toRotationMatrix();
    EigenSTL::vector_Isometry3d poses;
    for (const Eigen::Isometry3d& pose : body->getShapePoses()) poses.push_back(turned * pose);
    points = placesOn(*surface, boundsOf(cornersOf(body->getShapes(), poses)), body->getGlobalPose().translation());
    moveit_msgs::PlaceLocation location = this->location(in_hand_);
    if (location.post_place_retreat.direction.header.frame_id.empty())
      location.post_place_retreat.direction.header.frame_id = body->getAttachedLinkName();
    for (std::size_t i = 0; i < points.size(); ++i) {
      turned.translation() = points[i];
      location.id = on + " " + std::to_string(i + 1);
      location.place_pose.header.frame_id = display.model()->getModelFrame();
      location.place_pose.pose = tf2::toMsg(turned);
      location.quality = 1.0 / static_cast<double>(i + 1);
      goal.place_locations.push_back(location);
    }
  }
  display.showPlaces(points);
  show(QString::fromStdString("Putting " + inQuotes(in_hand_) + " on " + inQuotes(on) + "..."));
  inThread([this, goal]() { runPlace(goal); });
}

void ManipulationTab::runPlace(const moveit_msgs::PlaceGoal& goal) {
  const auto client = run(placer_, "place", goal);
  dock_->later([this, goal, good = client != nullptr]() {
    dock_->display().showPlaces({});
    if (good) held_.erase(goal.attached_object_name);
  });
  if (client) ended("Put " + inQuotes(goal.attached_object_name) + " on " + inQuotes(goal.support_surface_name), true);
}

}  // namespace moveit_rviz_plugin
