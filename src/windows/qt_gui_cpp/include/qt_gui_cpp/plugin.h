// The base of plugins. Declared for building only: no plugin in C++ is loaded here.
#pragma once

#include <QObject>

#include <qt_gui_cpp/plugin_context.h>
#include <qt_gui_cpp/settings.h>

namespace qt_gui_cpp
{
class Plugin : public QObject
{
public:
  virtual void initPlugin(PluginContext&) {}
  virtual void shutdownPlugin() {}
  virtual void saveSettings(Settings&, Settings&) const {}
  virtual void restoreSettings(const Settings&, const Settings&) {}
  virtual bool hasConfiguration() const { return false; }
  virtual void triggerConfiguration() {}
};
}  // namespace qt_gui_cpp
