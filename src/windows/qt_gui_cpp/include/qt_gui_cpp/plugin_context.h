// What a plugin is given. Declared for building only: no plugin in C++ is loaded here.
#pragma once

#include <QObject>
#include <QStringList>

class QToolBar;
class QWidget;

namespace qt_gui_cpp
{
class PluginContext : public QObject
{
public:
  int serialNumber() const { return 0; }
  const QStringList& argv() const
  {
    static const QStringList none;
    return none;
  }
  void addWidget(QWidget*) {}
  void removeWidget(QWidget*) {}
  void addToolBar(QToolBar*) {}
  void removeToolBar(QToolBar*) {}
  void closePlugin() {}
  void reloadPlugin() {}
};
}  // namespace qt_gui_cpp
