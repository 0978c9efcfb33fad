// Bases of plugins, and the macros that make their entry points.
#pragma once
#include <string>

#include <boost/enable_shared_from_this.hpp>
#include <boost/shared_ptr.hpp>
#include <sdf/sdf.hh>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Exception.hh>
#include <gazebo/common/SystemPaths.hh>
#include <gazebo/gazebo_config.h>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/common/Assert.hh>

namespace gazebo
{

class Event;

enum PluginType
{
  WORLD_PLUGIN,
  MODEL_PLUGIN,
  SENSOR_PLUGIN,
  SYSTEM_PLUGIN,
  VISUAL_PLUGIN,
  GUI_PLUGIN
};

/// What all plugins have. The members of the loader, filename and handleName, are set before Load().
template <class T>
class PluginT : public boost::enable_shared_from_this<T>
{
public:
  typedef boost::shared_ptr<T> TPtr;

  PluginT() = default;
  virtual ~PluginT() = default;
  std::string GetFilename() const { return filename; }
  std::string GetHandle() const { return handleName; }
  PluginType GetType() const { return type; }
  void SetNames(const std::string& file, const std::string& name) { filename = file, handleName = name; }

protected:
  PluginType type = MODEL_PLUGIN;
  std::string filename;
  std::string handleName;
};

class WorldPlugin : public PluginT<WorldPlugin>
{
public:
  WorldPlugin() { type = WORLD_PLUGIN; }
  virtual ~WorldPlugin() = default;
  virtual void Load(physics::WorldPtr world, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class ModelPlugin : public PluginT<ModelPlugin>
{
public:
  ModelPlugin() { type = MODEL_PLUGIN; }
  virtual ~ModelPlugin() = default;
  virtual void Load(physics::ModelPtr model, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class SensorPlugin : public PluginT<SensorPlugin>
{
public:
  SensorPlugin() { type = SENSOR_PLUGIN; }
  virtual ~SensorPlugin() = default;
  virtual void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class SystemPlugin : public PluginT<SystemPlugin>
{
public:
  SystemPlugin() { type = SYSTEM_PLUGIN; }
  virtual ~SystemPlugin() = default;
  virtual void Load(int argc = 0, char** argv = nullptr) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class VisualPlugin : public PluginT<VisualPlugin>
{
public:
  VisualPlugin() { type = VISUAL_PLUGIN; }
  virtual ~VisualPlugin() = default;
  virtual void Load(rendering::VisualPtr visual, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

}  // namespace gazebo

#define GZ_REGISTER_PLUGIN_OF(base, classname)              \
  extern "C" GAZEBO_VISIBLE gazebo::base* RegisterPlugin(); \
  gazebo::base* RegisterPlugin() { return new classname(); }
#define GZ_REGISTER_MODEL_PLUGIN(classname) GZ_REGISTER_PLUGIN_OF(ModelPlugin, classname)
#define GZ_REGISTER_WORLD_PLUGIN(classname) GZ_REGISTER_PLUGIN_OF(WorldPlugin, classname)
#define GZ_REGISTER_SENSOR_PLUGIN(classname) GZ_REGISTER_PLUGIN_OF(SensorPlugin, classname)
#define GZ_REGISTER_SYSTEM_PLUGIN(classname) GZ_REGISTER_PLUGIN_OF(SystemPlugin, classname)
#define GZ_REGISTER_VISUAL_PLUGIN(classname) GZ_REGISTER_PLUGIN_OF(VisualPlugin, classname)
