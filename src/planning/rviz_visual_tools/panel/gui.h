// The panel and the tool that step through a program from RViz.
#pragma once

#ifndef Q_MOC_RUN
#include <rviz/default_plugin/tools/move_tool.h>
#include <rviz/panel.h>
#include <rviz/tool.h>
#include <rviz_visual_tools/remote_reciever.h>
#endif

namespace rviz_visual_tools {

/// Buttons Next, Continue, Break and Stop.
class RvizVisualToolsGui : public rviz::Panel {
  Q_OBJECT
 public:
  explicit RvizVisualToolsGui(QWidget* parent = nullptr);

 private:
  RemoteReciever remote_;
};

/// The same by the keys n, a or c, b and s; the mouse turns the view.
class KeyTool : public rviz::Tool {
  Q_OBJECT
 public:
  void onInitialize() override { move_tool_.initialize(context_); }
  void activate() override {}
  void deactivate() override {}
  int processKeyEvent(QKeyEvent* event, rviz::RenderPanel* panel) override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

 private:
  RemoteReciever remote_;
  rviz::MoveTool move_tool_;
};

}  // namespace rviz_visual_tools
