// A robot for the small displays, from a parameter that may come later.
#pragma once

#include <moveit/robot_model/robot_model.h>

#include <rviz/display.h>

#include <string>

namespace moveit_rviz_plugin {

// Looks for the parameter and loads the robot when it is there; what is missing or wrong is said in the display's status
// "Robot Model".
class RobotParameter {
 public:
  explicit RobotParameter(rviz::Display* display) : display_(display) {}
  void want(const std::string& description);
  void stop() { wanted_ = false; }
  // True at the update at which a robot has come.
  bool update(float wall_dt);
  const moveit::core::RobotModelConstPtr& model() const { return model_; }
  void clear() { model_.reset(); }
  // In the frame of the model; false, and a status, when TF does not know it.
  bool place(Ogre::SceneNode* node, rviz::DisplayContext* context, const QString& fixed_frame);

 private:
  rviz::Display* display_;
  std::string description_;
  moveit::core::RobotModelConstPtr model_;
  bool wanted_ = false;
  float since_look_ = 0.0f;
};

}  // namespace moveit_rviz_plugin
