// The start and the goal of MotionPlanningDisplay: ghosts, markers, what they say.
#include <OgreSceneNode.h>
#include <ros/ros.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <tf2_eigen/tf2_eigen.h>

#include "dock.hpp"
#include "motion_planning_display.hpp"
#include "properties.hpp"

namespace moveit_rviz_plugin {

std::string MotionPlanningDisplay::markerName(Which which, const std::string& link) const {
  return std::string("EE:") + queries_[which].name + "_" + link;
}

// ---------------------------------------------------------------- markers

void MotionPlanningDisplay::insertMarkers() {
  if (!server_ || !model()) return;
  server_->clear();
  for (const Which which : {START, GOAL}) insertMarkers(which);
  if (!object_.empty()) object_.clear();
  if (dock_) dock_->markersCleared();
  setMarkerTopics(marker_topics_wanted_);
  server_->applyChanges();
}

void MotionPlanningDisplay::insertMarkers(Which which) {
  Query& query = queries_[which];
  query.dragged.clear();
  if (!query.state || !query.shown->getBool() || !isEnabled()) return;
  fillMenu(which);
  for (const Tip& tip : tips_) {
    const double size = marker_size_->getFloat() > 0.0f ? marker_size_->getFloat() : tip.size;
    const std::string name = markerName(which, tip.link);
    server_->insert(dragMarker(name, model()->getModelFrame(), query.state->getGlobalLinkTransform(tip.link), size),
                    [this, which, tip](const Feedback& feedback) { processFeedback(which, tip, feedback); });
    query.menu->apply(*server_, name);
  }
}

void MotionPlanningDisplay::fillMenu(Which which) {
  Query& query = queries_[which];
  query.menu = std::make_unique<interactive_markers::MenuHandler>();
  interactive_markers::MenuHandler& menu = *query.menu;
  const auto entry = [this, which, &menu](interactive_markers::MenuHandler::EntryHandle parent, const std::string& title,
                                          const std::string& state) {
    menu.insert(parent, title, [this, which, state](const Feedback&) {
      if (dock_) dock_->setQueryTo(which, state);
    });
  };
  const auto states = menu.insert(std::string("Set ") + query.name + " state to");
  entry(states, "random", "<random>");
  entry(states, "random valid", "<random valid>");
  entry(states, "current", "<current>");
  entry(states, which == GOAL ? "same as start" : "same as goal", which == GOAL ? "<same as start>" : "<same as goal>");
  if (model()->hasJointModelGroup(last_group_))
    for (const std::string& name : model()->getJointModelGroup(last_group_)->getDefaultStateNames()) entry(states, name, name);
  const auto command = [this, &menu](const char* title, void (Dock::*what)()) {
    menu.insert(title, [this, what](const Feedback&) {
      if (dock_) (dock_->*what)();
    });
  };
  command("Plan", &Dock::plan);
  command("Execute", &Dock::execute);
  command("Plan and Execute", &Dock::planAndExecute);
  command("Stop", &Dock::stop);
}

// To where the state has the tips, but for the one that is in the hand.
void MotionPlanningDisplay::placeMarkers(Which which) {
  Query& query = queries_[which];
  if (!query.state || !server_ || !query.shown->getBool()) return;
  for (const Tip& tip : tips_) {
    const std::string name = markerName(which, tip.link);
    if (name != query.dragged) server_->setPose(name, tf2::toMsg(query.state->getGlobalLinkTransform(tip.link)));
  }
  markers_changed_ = true;
}

bool MotionPlanningDisplay::toModelFrame(const std::string& frame, const geometry_msgs::Pose& pose,
                                         Eigen::Isometry3d& in_model) const {
  tf2::fromMsg(pose, in_model);
  if (frame.empty() || frame == model()->getModelFrame()) return true;
  Ogre::Vector3 position = Ogre::Vector3::ZERO, robot_position = Ogre::Vector3::ZERO;
  Ogre::Quaternion turn = Ogre::Quaternion::IDENTITY, robot_turn = Ogre::Quaternion::IDENTITY;
  const std::string fixed = fixed_frame_.toStdString();
  rviz::FrameManager* frames = context_->getFrameManager();
  if ((frame != fixed && !frames->getTransform(frame, ros::Time(0), position, turn)) ||
      (model()->getModelFrame() != fixed &&
       !frames->getTransform(model()->getModelFrame(), ros::Time(0), robot_position, robot_turn)))
    return false;
  const auto transform = [](const Ogre::Vector3& p, const Ogre::Quaternion& q) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.translation() = Eigen::Vector3d(p.x, p.y, p.z);
    result.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    return result;
  };
  in_model = transform(robot_position, robot_turn).inverse() * transform(position, turn) * in_model;
  return true;
}

void MotionPlanningDisplay::processFeedback(Which which, const Tip& tip, const Feedback& feedback) {
  using Message = visualization_msgs::InteractiveMarkerFeedback;
  Query& query = queries_[which];
  if (!query.state) return;
  if (feedback->event_type == Message::MOUSE_UP) {
    // The marker returns to the hand of the ghost: nothing that cannot be reached is left standing.
    query.dragged.clear();
    query.out_of_reach = false;
    query.dirty = true;
    placeMarkers(which);
  } else if (feedback->event_type == Message::POSE_UPDATE) {
    query.dragged = feedback->marker_name;
    Eigen::Isometry3d pose;
    if (toModelFrame(feedback->header.frame_id, feedback->pose, pose)) dragTo(which, tip, pose);
  }
}

void MotionPlanningDisplay::dragTo(Which which, const Tip& tip, const Eigen::Isometry3d& pose) {
  IkFollower::Request request;
  request.service = named("compute_ik");
  request.group = tip.group;
  request.link = tip.link;
  request.pose = pose;
  request.seed = queries_[which].state;
  request.avoid_collisions = collision_aware_;
  request.approximate = approximate_;
  queries_[which].follower->follow(request);
}

void MotionPlanningDisplay::answered(Which which, const IkFollower::Answer& answer) {
  Query& query = queries_[which];
  if (!query.state) return;
  if (!answer.problem.empty()) setStatusStd(rviz::StatusProperty::Warn, "Inverse kinematics", answer.problem);
  else deleteStatus("Inverse kinematics");
  if (answer.state && answer.state->getRobotModel() == query.state->getRobotModel()) {
    query.state = answer.state;
    if (dock_) dock_->queryDragged(which);
  }
  query.out_of_reach = !answer.reached && !query.dragged.empty();
  query.dirty = true;
  placeMarkers(which);
}

void MotionPlanningDisplay::setMarkerTopics(bool on) {
  marker_topics_wanted_ = on;
  marker_topics_.clear();
  if (!on || !model()) return;
  for (const Which which : {START, GOAL})
    for (const Tip& tip : tips_) {
      const std::string topic = std::string("/rviz/moveit/move_marker/") + queries_[which].name + "_" + tip.link;
      marker_topics_.push_back(update_nh_.subscribe<geometry_msgs::PoseStamped>(
          topic, 10, [this, which, tip](const geometry_msgs::PoseStamped::ConstPtr& message) {
            Eigen::Isometry3d pose;
            if (queries_[which].state && toModelFrame(message->header.frame_id, message->pose, pose)) dragTo(which, tip, pose);
          }));
    }
}

void MotionPlanningDisplay::setObjectMarker(const std::string& id, const Eigen::Isometry3d& pose, double size) {
  if (!server_ || !model()) return;
  if (!object_.empty()) server_->erase("marker_" + object_);
  object_ = id;
  if (!id.empty())
    server_->insert(dragMarker("marker_" + id, model()->getModelFrame(), pose, size), [this](const Feedback& feedback) {
      Eigen::Isometry3d to;
      if (feedback->event_type == visualization_msgs::InteractiveMarkerFeedback::POSE_UPDATE && dock_ &&
          toModelFrame(feedback->header.frame_id, feedback->pose, to))
        dock_->objectDragged(to);
    });
  markers_changed_ = true;
}

void MotionPlanningDisplay::moveObjectMarker(const Eigen::Isometry3d& pose) {
  if (object_.empty() || !server_) return;
  server_->setPose("marker_" + object_, tf2::toMsg(pose));
  markers_changed_ = true;
}

// ---------------------------------------------------------------- ghosts

void MotionPlanningDisplay::applyQueryVisibility() {
  for (Query& query : queries_) {
    if (!query.ghost) continue;
    query.ghost->setAlpha(query.alpha->getFloat());
    query.ghost->setVisible(isEnabled() && query.shown->getBool() && query.state);
    query.dirty = true;
  }
  insertMarkers();
}

RobotGhost::LinkColors MotionPlanningDisplay::colorsOf(const Query& query) const {
  RobotGhost::LinkColors colors;
  const moveit::core::RobotModel& robot = *query.state->getRobotModel();
  const moveit::core::JointModelGroup* group =
      robot.hasJointModelGroup(last_group_) ? robot.getJointModelGroup(last_group_) : nullptr;
  if (group)
    for (const std::string& link : group->getUpdatedLinkModelNames())
      colors[link] = query.out_of_reach ? colliding_color_->getColor() : query.color->getColor();
  for (const moveit::core::JointModel* joint : robot.getActiveJointModels())
    if (!query.state->satisfiesBounds(joint, 1e-6))
      colors[joint->getChildLinkModel()->getName()] = violation_color_->getColor();
  std::vector<std::string> colliding;
  {
    const planning_scene_monitor::LockedPlanningSceneRO scene(monitor());
    scene->getCollidingLinks(colliding, *query.state);
  }
  for (const std::string& link : colliding) colors[link] = colliding_color_->getColor();
  return colors;
}

void MotionPlanningDisplay::drawQueries() {
  if (!monitor()) return;
  for (Query& query : queries_) {
    if (!query.dirty || !query.state || !query.shown->getBool()) continue;
    query.dirty = false;
    query.ghost->setColors(colorsOf(query));
    query.ghost->show(*query.state);
  }
  fillMetrics();
}

}  // namespace moveit_rviz_plugin
