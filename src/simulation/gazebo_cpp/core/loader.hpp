// Plugins from shared libraries.
#pragma once
#include <memory>
#include <string>

#include <gazebo/common/Plugin.hh>

namespace gazebo
{

/// One plugin of a library. What it throws comes out as std::runtime_error with one line.
class GAZEBO_VISIBLE LoadedPlugin
{
public:
  /// \param label for messages: "plugin 'x' (libx.so) of model 'm'"
  LoadedPlugin(const std::string& library, const std::string& file, const std::string& name, const std::string& label);
  ~LoadedPlugin();
  PluginType Kind() const { return kind_; }
  void LoadModel(const std::string& model, int index, const std::string& text);
  void LoadWorld(int index, const std::string& text);
  void LoadSystem(int argc, char** argv);
  void LoadSensor(const std::string& sensor, int index, const std::string& text);  // sensor: its scoped name
  void Reset();
  void Destroy();

private:
  template <class F>
  void call(const char* what, F f);
  std::string library_;
  sdf::ElementPtr around_;  // what the element of a world plugin stands in
  const char* label_;
  PluginType kind_;
  boost::shared_ptr<ModelPlugin> model_;
  boost::shared_ptr<WorldPlugin> world_;
  boost::shared_ptr<SensorPlugin> sensor_;
  boost::shared_ptr<SystemPlugin> system_;
};

}  // namespace gazebo
