// The bridge to Python: the server starts the mirror of its world, tells it of models, and loads plugins.
#include <dlfcn.h>

#include <optional>

#include <gazebo/gazebo.hh>
#include <gazebo/sensors/PictureSensor.hh>
#include <gazebo/sensors/SensorManager.hh>
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <compiled_plugins/guard.h>
#include <compiled_plugins/ros.h>

#include "loader.hpp"
#include "mirror.hpp"
#include "transport.hpp"

PYBIND11_DECLARE_HOLDER_TYPE(T, boost::shared_ptr<T>)
namespace py = pybind11;
using gazebo::LoadedPlugin;
using gazebo::physics::Mirror;
using gazebo::physics::WorldLock;

namespace
{

using Free = py::call_guard<py::gil_scoped_release>;
using Numbers = std::vector<double>;
using CollisionTuple = std::tuple<std::string, int, std::string, Numbers, std::string, double>;
using LinkTuple = std::tuple<std::string, int, std::vector<CollisionTuple>, std::vector<std::string>>;
using JointTuple = std::tuple<std::string, std::string, int>;
using Animations = std::vector<std::pair<std::string, double>>;

/// Python loads its modules so that no other library sees what they bring; plugins that were linked carelessly find Gazebo here.
void show_to_all()
{
  for (void* symbol : { reinterpret_cast<void*>(&gazebo::sensors::get_sensor),
                        reinterpret_cast<void*>(&gazebo::physics::get_world), reinterpret_cast<void*>(&gazebo::printVersion) })
  {
    Dl_info info;
    if (dladdr(symbol, &info) && info.dli_fname)
      dlopen(info.dli_fname, RTLD_NOLOAD | RTLD_LAZY | RTLD_GLOBAL);
  }
}

/// Gazebo's process has tf, by its own ROS plugin; those who use it often forget to link it.
void share_tf()
{
  for (const char* name : { "libtf.so.1d", "libtf.so" })
    if (dlopen(name, RTLD_LAZY | RTLD_GLOBAL))
      return;
}

void start(std::uintptr_t core, const std::string& name, const std::string& text, double update_rate,
           const Numbers& magnetic_field, const Numbers& place)
{
  Mirror::Get().Start(reinterpret_cast<ode_sim::World*>(core), name, text, update_rate);
  Mirror::Get().Describe(magnetic_field, place);
  gazebo::sensors::SensorManager::Instance()->Start();
}

void add_model(const std::string& name, const std::string& text, int id, const Numbers& X, const std::vector<LinkTuple>& links,
               const std::vector<JointTuple>& joints, const std::optional<Animations>& animations)
{
  const ode_sim::Pose X_WM{ { X.at(0), X.at(1), X.at(2) }, { X.at(3), X.at(4), X.at(5), X.at(6) } };
  gazebo::physics::ModelRecord model{ name, text, id, X_WM, {}, {}, animations.has_value(), animations.value_or(Animations()) };
  for (const auto& [link_name, link_id, collisions, sensors] : links)
  {
    model.links.push_back({ link_name, link_id, {}, sensors });
    for (const auto& [collision, shape, kind, numbers, uri, retro] : collisions)
      model.links.back().collisions.push_back({ collision, shape, kind, uri, numbers, retro });
  }
  for (const auto& [joint, type, joint_id] : joints)
    model.joints.push_back({ joint, type, joint_id });
  Mirror::Get().Add(model);
}

/// What plugins want of an actor: animation in place of its script or None, script time, whether it plays, since when, whether it collides.
std::tuple<std::optional<std::string>, double, bool, int64_t, bool> actor_wanted(const std::string& name)
{
  const gazebo::physics::ActorPtr actor = Mirror::Get().FindActor(name);
  if (!actor)
    throw std::runtime_error("there is no actor '" + name + "' in the mirror");
  const auto wanted = actor->Wanted();
  return { wanted.custom ? std::optional<std::string>(wanted.type) : std::nullopt, wanted.script_time, wanted.active,
           wanted.started_ns, wanted.collides };
}

void actor_plays(const std::string& name, double script_time, bool active, int64_t started_ns, bool anew)
{
  if (const gazebo::physics::ActorPtr actor = Mirror::Get().FindActor(name))
    actor->Plays({ false, "", script_time, active, started_ns, false }, anew);
}

void set_host(std::function<void(std::string, Numbers)> insert, std::function<void(std::string)> remove,
              std::function<void(std::string)> order, std::function<void(unsigned int)> step,
              std::function<void(std::string, double)> parameter,
              std::function<void(std::string, std::string, std::string)> plugin)
{
  auto& host = Mirror::Get().host;
  host.insert = std::move(insert), host.remove = std::move(remove), host.order = std::move(order);
  host.step = std::move(step), host.parameter = std::move(parameter), host.plugin = std::move(plugin);
}

/// \param shoot asks for a picture; never raises. \param save writes pixels to a file
void set_studio(std::function<bool(int, std::string, int, Numbers, std::vector<std::string>)> shoot, py::function save)
{
  auto& host = Mirror::Get().host;
  host.shoot = std::move(shoot);
  auto* const kept = new py::function(std::move(save));  // as long as the process: what ends it may not hold Python's lock
  host.save = [kept](const std::string& file, const std::string& pixels, unsigned int width, unsigned int height,
                     const std::string& format) {
    const py::gil_scoped_acquire lock;
    return (*kept)(file, py::bytes(pixels), width, height, format).cast<bool>();
  };
}

/// A picture has come. \param image, depth buffers, or None
void develop(int number, int64_t time_ns, const py::object& image, const py::object& depth)
{
  gazebo::rendering::Picture picture;
  py::buffer_info pixels, metres;  // hold the buffers
  if (!image.is_none())
  {
    pixels = image.cast<py::buffer>().request();
    picture.image = static_cast<const unsigned char*>(pixels.ptr);
    picture.image_bytes = static_cast<std::size_t>(pixels.size * pixels.itemsize);
  }
  if (!depth.is_none())
  {
    metres = depth.cast<py::buffer>().request();
    picture.depth = static_cast<const float*>(metres.ptr);
    picture.depth_count = static_cast<std::size_t>(metres.size * metres.itemsize) / sizeof(float);
  }
  const py::gil_scoped_release free;
  gazebo::sensors::PictureSensor::Arrived(number, time_ns, picture);
}

void load_system(LoadedPlugin& plugin, std::vector<std::string> words)
{
  std::vector<char*> pointers;
  static std::vector<std::string> kept;  // plugins may keep argv
  kept = std::move(words);
  for (std::string& word : kept)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  plugin.LoadSystem(static_cast<int>(kept.size()), pointers.data());
}

/// For gz: what a program beside the simulator asks of its transport.
void add_client(py::module_& m)
{
  using gazebo::transport::Node;
  using gazebo::transport::TopicDescription;
  py::class_<TopicDescription>(m, "TopicDescription")
      .def_readonly("type", &TopicDescription::type)
      .def_readonly("publishers", &TopicDescription::publishers)
      .def_readonly("subscribers", &TopicDescription::subscribers);
  m.def("join", &gazebo::transport::join, Free());
  m.def("topic_names", &gazebo::transport::topic_names, Free());
  m.def("describe_topic", &gazebo::transport::describe_topic, Free());
  m.def("message_text", &gazebo::transport::message_text);
  py::class_<gazebo::transport::Subscriber, gazebo::transport::SubscriberPtr>(m, "Subscriber")
      .def("unsubscribe", &gazebo::transport::Subscriber::Unsubscribe, Free());
  py::class_<Node, gazebo::transport::NodePtr>(m, "Node")
      .def(py::init([](const std::string& space) {
             const gazebo::transport::NodePtr node(new Node);
             node->Init(space);
             return node;
           }),
           Free())
      .def("full_name", &Node::DecodeTopicName, Free())
      .def("subscribe", [](Node& node, const std::string& topic, const std::function<void(py::bytes)>& f) {
        return node.SubscribeToBytes(topic, [f](const std::string& bytes) {
          const py::gil_scoped_acquire lock;
          f(py::bytes(bytes));
        });
      });
}

}  // namespace

PYBIND11_MODULE(_core, m)
{
  m.doc() = "Gazebo Classic's C++ API over a simulated world: the mirror of its models, and compiled plugins.";
  show_to_all();
  m.attr("layout") = ODE_SIM_LAYOUT;
  add_client(m);
  m.def(
      "serve",
      [](const std::string& world, std::function<void()> first) {
        Mirror::Get().began = gazebo::common::Time::GetWallTime();
        return gazebo::transport::serve(world, std::move(first));
      },
      Free());
  m.def("ready", &gazebo::transport::ready, Free());
  m.def("start", &start, Free());
  m.def("share_tf", &share_tf, Free());
  m.def(
      "stop", [] { Mirror::Get().Stop(); }, Free());
  m.def("set_host", &set_host);
  m.def("set_studio", &set_studio);
  m.def("develop", &develop);
  m.def("follow_clock", [] { Mirror::Get().host.clock = compiled_plugins::set_time; });
  py::class_<WorldLock>(m, "WorldLock")
      .def(py::init<>())
      .def("__enter__",
           [](WorldLock&) {
             if (WorldLock::TakeAtOnce())  // nearly always: then Python's own lock is not given away for it
               return;
             const py::gil_scoped_release free;
             WorldLock::Take();
           })
      .def("__exit__", [](WorldLock&, const py::args&) { WorldLock::Give(); });
  m.def("set_reporter", &gazebo::internal::SetReporter);
  m.def("set_verbose", [](bool on) { gazebo::common::Console::SetQuiet(!on); });
  m.def("add_model", &add_model, py::arg("name"), py::arg("text"), py::arg("id"), py::arg("pose"), py::arg("links"),
        py::arg("joints"), py::arg("animations") = std::nullopt, Free());
  m.def("actor_wanted", &actor_wanted, Free());
  m.def("actor_plays", &actor_plays, Free());
  m.def(
      "remove_model", [](const std::string& name) { Mirror::Get().Remove(name); }, Free());
  m.def(
      "set_paused", [](bool paused) { Mirror::Get().SetPaused(paused); }, Free());
  m.def(
      "was_reset", [](bool time) { Mirror::Get().WasReset(time); }, Free());
  py::class_<LoadedPlugin, std::shared_ptr<LoadedPlugin>>(m, "Plugin")
      .def(py::init<const std::string&, const std::string&, const std::string&, const std::string&>(), Free())
      .def("load_model", &LoadedPlugin::LoadModel, Free())
      .def("load_sensor", &LoadedPlugin::LoadSensor, Free())
      .def("load_world", &LoadedPlugin::LoadWorld, Free())
      .def("load_system", &load_system, Free())
      .def("reset", &LoadedPlugin::Reset, Free())
      .def("destroy", &LoadedPlugin::Destroy, Free());
}
