#include "loader.hpp"

#include <cstring>
#include <dlfcn.h>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <compiled_plugins/guard.h>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/PictureSensor.hh>
#include <gazebo/sensors/SensorManager.hh>

#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace
{

const char* kind_name(PluginType kind)
{
  static const char* const names[] = { "world", "model", "sensor", "system", "visual", "GUI" };
  return names[kind];
}

std::string trimmed(std::string text)
{
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.pop_back();
  return text;
}

/// Whether the library asks sdformat for what an element stands in.
bool asks_for_parents(const std::string& library)
{
  std::ifstream file(library, std::ios::binary);
  const std::string all{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  return all.find("7Element9GetParent") != std::string::npos;
}

}  // namespace

template <class F>
void LoadedPlugin::call(const char* what, F f)
{
  const physics::WorldLock::Without unlocked;
  const sensors::PictureSensor::Still no_callbacks;  // of pictures, in what is half made, or goes
  const internal::Running running(label_, what);
  try
  {
    f();
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(std::string("its ") + what + " threw " + trimmed(error.what()));
  }
  catch (...)
  {
    throw std::runtime_error(std::string("its ") + what + " threw something that is no std::exception");
  }
}

LoadedPlugin::LoadedPlugin(const std::string& library, const std::string& file, const std::string& name,
                           const std::string& label)
  : library_(library)
  , label_(strdup(label.c_str()))  // never freed: handlers of signals and threads of plugins read it
{
  void* handle = nullptr;
  call("library's start", [&] { handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL); });
  if (!handle)
    throw std::runtime_error(std::string("the library cannot be loaded: ") + dlerror());
  compiled_plugins::remember(library);
  void* const entry = dlsym(handle, "RegisterPlugin");
  if (!entry)
    throw std::runtime_error(
        "the library " + library +
        " is no plugin: its source has to end with GZ_REGISTER_MODEL_PLUGIN(Class), or ..._WORLD_, ..._SENSOR_");
  // Of whichever kind, the first base is a PluginT; those differ in their template argument alone.
  ModelPlugin* made = nullptr;
  call("constructor", [&] { made = reinterpret_cast<ModelPlugin* (*)()>(entry)(); });
  if (!made)
    throw std::runtime_error("RegisterPlugin() of " + library + " gave no plugin");
  kind_ = made->GetType();
  made->SetNames(file, name);
  void* const object = made;
  switch (kind_)
  {
    case MODEL_PLUGIN:
      model_.reset(made);
      break;
    case WORLD_PLUGIN:
      world_.reset(static_cast<WorldPlugin*>(object));
      break;
    case SENSOR_PLUGIN:
      sensor_.reset(static_cast<SensorPlugin*>(object));
      break;
    case SYSTEM_PLUGIN:
      system_.reset(static_cast<SystemPlugin*>(object));
      break;
    default:
      throw std::runtime_error(std::string("is a ") + kind_name(kind_) +
                               " plugin: there is nothing here that it could draw on");
  }
}

LoadedPlugin::~LoadedPlugin() = default;

namespace
{

void wrong_kind(PluginType kind, const char* wanted)
{
  throw std::runtime_error(std::string("is a ") + kind_name(kind) + " plugin, and stands where a " + wanted +
                           " plugin does: move its <plugin> to the element of a " + kind_name(kind));
}

}  // namespace

void LoadedPlugin::LoadModel(const std::string& model, int index, const std::string& text)
{
  if (!model_)
    wrong_kind(kind_, "model");
  const physics::ModelPtr found = physics::get_world()->ModelByName(model);
  if (!found)
    throw std::runtime_error("the model has gone");
  const sdf::ElementPtr element = plugin_element(found->GetSDF(), index, text);
  call("Load()", [&] { model_->Load(found, element); });
  call("Init()", [&] { model_->Init(); });
}

void LoadedPlugin::LoadWorld(int index, const std::string& text)
{
  if (!world_)
    wrong_kind(kind_, "world");
  const physics::WorldPtr world = physics::get_world();
  // sdformat takes megabytes for each model of a world: its text is read for those who look around in it, or ask for World::SDF().
  // For others a world stands around the element that has nothing else in it.
  const sdf::ElementPtr element =
      asks_for_parents(library_)
          ? plugin_element(world->SDF(), index, text)
          : plugin_element(
                around_ = world_element("<sdf version='1.6'><world name='w'>" + text + "</world></sdf>", world->Name()), 0,
                text);
  call("Load()", [&] { world_->Load(world, element); });
  call("Init()", [&] { world_->Init(); });
}

void LoadedPlugin::LoadSensor(const std::string& name, int index, const std::string& text)
{
  if (!sensor_)
    wrong_kind(kind_, "sensor");
  const sensors::SensorPtr sensor = sensors::SensorManager::Instance()->GetSensor(name);
  if (!sensor)
    throw std::runtime_error(
        "a sensor of this type is not there in C++ (rfid, wireless ...), or cannot be as it is described; in Python it can be "
        "written (gazebo_ros.plugin)");
  const sdf::ElementPtr element = plugin_element(sensor->Element(), index, text);
  call("Load()", [&] { sensor_->Load(sensor, element); });
  call("Init()", [&] { sensor_->Init(); });
}

void LoadedPlugin::LoadSystem(int argc, char** argv)
{
  if (!system_)
    wrong_kind(kind_, "system");
  call("Load()", [&] { system_->Load(argc, argv); });
  call("Init()", [&] { system_->Init(); });
}

void LoadedPlugin::Reset()
{
  call("Reset()", [&] {
    if (model_)
      model_->Reset();
    if (world_)
      world_->Reset();
    if (sensor_)
      sensor_->Reset();
    if (system_)
      system_->Reset();
  });
}

/// The library stays: threads and static objects of it may go on.
void LoadedPlugin::Destroy()
{
  call("destructor", [&] {
    model_.reset();
    world_.reset();
    sensor_.reset();
    system_.reset();
  });
}

}  // namespace gazebo
