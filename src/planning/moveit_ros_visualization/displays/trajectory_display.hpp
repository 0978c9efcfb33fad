// The display of planned paths alone.
#pragma once

#include <rviz/display.h>

#include "robot_parameter.hpp"
#include "trajectory_view.hpp"

namespace rviz {
class StringProperty;
}

namespace moveit_rviz_plugin {

class TrajectoryDisplay : public rviz::Display {
 public:
  TrajectoryDisplay();
  ~TrajectoryDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;
  void setName(const QString& name) override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private:
  void forget();

  rviz::StringProperty* robot_description_;
  std::unique_ptr<TrajectoryView> view_;
  RobotParameter robot_{this};
};

}  // namespace moveit_rviz_plugin
