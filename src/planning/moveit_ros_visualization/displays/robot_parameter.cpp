#include "robot_parameter.hpp"

#include <moveit/robot_model_loader/robot_model_loader.h>
#include <ros/ros.h>

#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>

namespace moveit_rviz_plugin {

void RobotParameter::want(const std::string& description) {
  description_ = description;
  model_.reset();
  wanted_ = true;
  since_look_ = 1.0f;
}

bool RobotParameter::update(float wall_dt) {
  if (!wanted_ || (since_look_ += wall_dt) < 0.5f) return false;
  since_look_ = 0.0f;
  std::string key;
  if (!ros::NodeHandle("~").searchParam(description_, key)) {
    display_->setStatusStd(rviz::StatusProperty::Warn, "Robot Model",
                           "Waiting for a robot: there is no parameter '" + description_ + "' yet");
    return false;
  }
  wanted_ = false;
  const robot_model_loader::RobotModelLoader loader(description_, false);
  model_ = loader.getModel();
  if (model_) display_->setStatusStd(rviz::StatusProperty::Ok, "Robot Model", model_->getName());
  else
    display_->setStatusStd(rviz::StatusProperty::Error, "Robot Model",
                           "What '" + key + "' holds makes no robot: the terminal says why");
  return model_ != nullptr;
}

bool RobotParameter::place(Ogre::SceneNode* node, rviz::DisplayContext* context, const QString& fixed_frame) {
  if (!model_) return false;
  const std::string& frame = model_->getModelFrame();
  Ogre::Vector3 position = Ogre::Vector3::ZERO;
  Ogre::Quaternion orientation = Ogre::Quaternion::IDENTITY;
  if (frame != fixed_frame.toStdString() &&
      !context->getFrameManager()->getTransform(frame, ros::Time(0), position, orientation)) {
    display_->setStatusStd(rviz::StatusProperty::Error, "Transform",
                           "No transform from '" + frame + "' to the fixed frame '" + fixed_frame.toStdString() + "'");
    return false;
  }
  display_->deleteStatus("Transform");
  node->setPosition(position);
  node->setOrientation(orientation);
  return true;
}

}  // namespace moveit_rviz_plugin
