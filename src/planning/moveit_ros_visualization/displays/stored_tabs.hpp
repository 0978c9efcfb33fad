// The tabs Stored Scenes, Stored States and Status.
#pragma once

#include <moveit_msgs/RobotState.h>

#include <map>

#include "dock.hpp"

class QListWidget;
class QPushButton;
class QTextEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace moveit_rviz_plugin {

class StoredScenesTab : public Tab {
 public:
  explicit StoredScenesTab(Dock* dock);
  void robotLoaded() override { refresh(); }
  void warehouseChanged() override { refresh(); }

 private:
  void refresh();
  void saveScene();
  void saveQuery();
  void loadScene();
  void loadQuery();
  void remove(bool query);
  void rename(QTreeWidgetItem* item, const QString& to);
  QString scene() const;  // that is chosen, or that holds what is chosen; "" for none
  QString query() const;

  QTreeWidget* tree_;
  bool filling_ = false;
};

class StoredStatesTab : public Tab {
 public:
  explicit StoredStatesTab(Dock* dock);
  void robotLoaded() override { read(".*"); }
  void warehouseChanged() override { read(".*"); }

 private:
  void read(const std::string& pattern);
  void save(Which which);
  void use(Which which);
  void remove();
  void show();

  QListWidget* list_;
  std::map<std::string, moveit_msgs::RobotState> states_;
};

class StatusTab : public Tab {
 public:
  explicit StatusTab(Dock* dock);
  void add(const QString& line, bool error);

 private:
  QTextEdit* text_;
};

}  // namespace moveit_rviz_plugin
