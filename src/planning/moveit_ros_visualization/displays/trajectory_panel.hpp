// A slider through a path.
#pragma once

#include <QWidget>
#include <functional>

class QLabel;
class QPushButton;
class QSlider;

namespace moveit_rviz_plugin {

class TrajectoryPanel : public QWidget {
 public:
  TrajectoryPanel();

  // 0 way points: nothing can be moved.
  void setWayPointCount(int count);
  void setPosition(int waypoint);
  int position() const;
  bool paused() const { return paused_; }
  void pause(bool paused);
  std::function<void()> moved;  // by hand, or to go on

 private:
  void show();

  QSlider* slider_;
  QLabel* place_;
  QPushButton* button_;
  int count_ = 0;
  bool paused_ = false, by_program_ = false;
};

}  // namespace moveit_rviz_plugin
