#include "trajectory_panel.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <algorithm>

namespace moveit_rviz_plugin {

TrajectoryPanel::TrajectoryPanel() {
  setObjectName("trajectory_slider_panel");
  auto* layout = new QHBoxLayout(this);
  place_ = new QLabel("0 / 0");
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setObjectName("trajectory_slider");
  slider_->setToolTip("Way point of the planned path");
  button_ = new QPushButton("Pause");
  button_->setObjectName("trajectory_pause");
  layout->addWidget(place_);
  layout->addWidget(slider_, 1);
  layout->addWidget(button_);
  connect(slider_, &QSlider::valueChanged, this, [this](int) {
    show();
    if (by_program_) return;
    pause(true);
    if (moved) moved();
  });
  connect(button_, &QPushButton::clicked, this, [this](bool) {
    pause(!paused_);
    if (moved) moved();
  });
  setWayPointCount(0);
}

void TrajectoryPanel::setWayPointCount(int count) {
  count_ = count;
  by_program_ = true;
  slider_->setRange(0, std::max(0, count - 1));
  slider_->setValue(0);
  by_program_ = false;
  setEnabled(count > 0);
  pause(false);
  show();
}

void TrajectoryPanel::setPosition(int waypoint) {
  by_program_ = true;
  slider_->setValue(waypoint);
  by_program_ = false;
}

int TrajectoryPanel::position() const { return slider_->value(); }

void TrajectoryPanel::pause(bool paused) {
  paused_ = paused;
  button_->setText(paused ? "Play" : "Pause");
}

void TrajectoryPanel::show() { place_->setText(QString("%1 / %2").arg(count_ ? slider_->value() + 1 : 0).arg(count_)); }

}  // namespace moveit_rviz_plugin
