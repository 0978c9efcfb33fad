#include "gui.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPushButton>

#include <pluginlib/class_list_macros.hpp>

namespace rviz_visual_tools {

RvizVisualToolsGui::RvizVisualToolsGui(QWidget* parent) : rviz::Panel(parent) {
  auto* row = new QHBoxLayout(this);
  const auto button = [&](const char* text, void (RemoteReciever::*pressed)()) {
    auto* made = new QPushButton(text, this);
    connect(made, &QPushButton::clicked, this, [this, pressed] { (remote_.*pressed)(); });
    row->addWidget(made);
  };
  button("Next", &RemoteReciever::publishNext);
  button("Continue", &RemoteReciever::publishContinue);
  button("Break", &RemoteReciever::publishBreak);
  button("Stop", &RemoteReciever::publishStop);
}

int KeyTool::processKeyEvent(QKeyEvent* event, rviz::RenderPanel* panel) {
  switch (event->key()) {
    case Qt::Key_N: remote_.publishNext(); break;
    case Qt::Key_A:
    case Qt::Key_C: remote_.publishContinue(); break;
    case Qt::Key_B: remote_.publishBreak(); break;
    case Qt::Key_S: remote_.publishStop(); break;
    default: return move_tool_.processKeyEvent(event, panel);
  }
  return Render;
}

int KeyTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  const int flags = move_tool_.processMouseEvent(event);
  setCursor(move_tool_.getCursor());
  return flags;
}

}  // namespace rviz_visual_tools

PLUGINLIB_EXPORT_CLASS(rviz_visual_tools::RvizVisualToolsGui, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(rviz_visual_tools::KeyTool, rviz::Tool)
