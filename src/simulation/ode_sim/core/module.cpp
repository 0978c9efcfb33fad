// Python bindings of the physics core. Meant for ode_sim's own Python modules, which check what users give them.
#include <cstring>

#include "bindings.hpp"

namespace ode_sim {

namespace {

using WorldClass = py::class_<World, std::shared_ptr<World>>;

// A view, read-only, of memory that lives as long as anybody looks at it.
py::array view(const Scene::Array& data, std::vector<py::ssize_t> shape) {
  auto* owner = new Scene::Array(data);
  py::array_t<double> a(std::move(shape), data->data(),
                        py::capsule(owner, [](void* p) { delete static_cast<Scene::Array*>(p); }));
  a.attr("setflags")(py::arg("write") = false);
  return std::move(a);
}

py::array view_of_numbers(const Scene::Array& data) { return view(data, {static_cast<py::ssize_t>(data->size())}); }

template <auto member>
void bind_setting(WorldClass& world, const char* name) {
  using Number = std::decay_t<decltype(std::declval<Settings>().*member)>;
  world.def_property(
      name, [](World& w) { return w.settings().*member; }, [](World& w, Number v) { w.settings().*member = v; });
}

void bind_settings(WorldClass& world) {
  bind_setting<&Settings::dt>(world, "dt");
  bind_setting<&Settings::erp>(world, "erp");
  bind_setting<&Settings::cfm>(world, "cfm");
  bind_setting<&Settings::sor>(world, "sor");
  bind_setting<&Settings::iters>(world, "iters");
  bind_setting<&Settings::max_contacts>(world, "max_contacts");
  bind_setting<&Settings::like_gazebo>(world, "like_gazebo");
  bind_setting<&Settings::contact_max_vel>(world, "contact_max_vel");
  bind_setting<&Settings::surface_layer>(world, "surface_layer");
  bind_setting<&Settings::contact_softness>(world, "contact_softness");
  bind_setting<&Settings::friction_softness>(world, "friction_softness");
  bind_setting<&Settings::direct_rows>(world, "direct_rows");
  bind_setting<&Settings::heap_rows>(world, "heap_rows");
  bind_setting<&Settings::seed>(world, "seed");
  world.def_property(
      "gravity", [](World& w) { return out(w.settings().gravity); }, [](World& w, T3 g) { w.settings().gravity = in(g); });
}

Weld& weld_of(World& w, int id) {
  Weld* weld = w.find_weld(id);
  if (!weld) throw std::runtime_error("these links are no longer attached");
  return *weld;
}

void bind_welds(WorldClass& world) {
  world.def("attach", &World::weld, py::arg("parent").none(true), py::arg("child").none(false))
      .def("detach", &World::unweld)
      .def("detach_strained", &World::unweld_strained)
      .def("welds", &World::welds)
      .def("attached", [](World& w, int id) { return w.find_weld(id) != nullptr; })
      .def("weld_pose", [](World& w, int id) { return out(weld_of(w, id).X_PC); })
      .def("set_weld_pose", [](World& w, int id, T7 X) {
        Weld& weld = weld_of(w, id);
        weld.X_PC = in(X);
        weld.child->model->changed = true;
        if (weld.parent) weld.parent->model->changed = true;
      });
}

py::array_t<ContactRecord> contacts(World& w) {
  const auto records = w.contacts();
  py::array_t<ContactRecord> a(static_cast<py::ssize_t>(records.size()));
  if (!records.empty()) std::memcpy(a.mutable_data(), records.data(), records.size() * sizeof(ContactRecord));
  return a;
}

std::pair<py::array_t<double>, py::array_t<int32_t>> rays(World& w, const Doubles& origins, const Doubles& directions,
                                                          double max_range, const std::vector<int>& ignore) {
  if (origins.size() != directions.size() || origins.size() % 3)
    throw std::invalid_argument("rays take as many origins as directions, of three numbers each");
  const auto n = origins.size() / 3;
  py::array_t<double> ranges(n);
  py::array_t<int32_t> hits(n);
  const double *o = origins.data(), *d = directions.data();
  double* r = ranges.mutable_data();
  int32_t* h = hits.mutable_data();
  {
    py::gil_scoped_release release;
    cast_rays(w.scene(), o, d, static_cast<int>(n), max_range, ignore, r, h);
  }
  return {ranges, hits};
}

void bind_world(py::module_& m) {
  py::class_<Counters>(m, "Counters")
      .def_readonly("direct", &Counters::direct)
      .def_readonly("trees", &Counters::trees)
      .def_readonly("piles", &Counters::piles)
      .def_readonly("quick", &Counters::quick)
      .def_readonly("fallbacks", &Counters::fallbacks)
      .def_readonly("promotions", &Counters::promotions)
      .def_readonly("contacts", &Counters::contacts);
  WorldClass world(m, "World");
  world.def(py::init<>());
  bind_settings(world);
  bind_welds(world);
  world
      .def_property(
          "iterations", [](World& w) { return w.scene().iterations; }, [](World& w, uint64_t n) { w.scene().iterations = n; })
      .def_property(
          "time_ns", [](World& w) { return w.scene().time_ns; }, [](World& w, int64_t t) { w.scene().time_ns = t; })
      .def_property_readonly("next_time_ns", [](World& w) { return w.scene().next_time_ns(); })
      .def_property_readonly(
          "counters", [](World& w) -> Counters& { return w.scene().counters; }, py::return_value_policy::reference_internal)
      .def_property_readonly("address", [](World& w) { return reinterpret_cast<uintptr_t>(&w); })  // for compiled plugins
      .def("add_model", &World::add_model)
      .def("remove_model", &World::remove_model)
      .def("refresh", &World::refresh)
      .def(
          "step", [](World& w, int n) { return w.step(n), w.scene().messages.any(); }, py::call_guard<py::gil_scoped_release>())
      .def("take_messages", [](World& w) { return w.scene().messages.take(); })
      .def("save", [](World& w) { return py::bytes(w.save()); })
      .def("restore", [](World& w, const py::bytes& data, const std::vector<int>& welds) { w.restore(data, welds); })
      .def_property_readonly("link_poses",
                             [](World& w) {
                               const auto& poses = w.scene().link_poses;
                               return view(poses, {static_cast<py::ssize_t>(poses->size() / 7), 7});
                             })
      .def_property_readonly("joint_positions", [](World& w) { return view_of_numbers(w.scene().joint_positions); })
      .def_property_readonly("joint_velocities", [](World& w) { return view_of_numbers(w.scene().joint_velocities); })
      .def("contacts", &contacts)
      .def("cast_rays", &rays);
}

}  // namespace

}  // namespace ode_sim

PYBIND11_MODULE(_core, m) {
  using namespace ode_sim;
  m.doc() = "Rigid-body physics on ODE: the whole step, in C++.";
  m.attr("ode_configuration") = dGetConfiguration();
  m.attr("FARTHEST") = kFarthest;
  m.attr("layout") = ODE_SIM_LAYOUT;
  PYBIND11_NUMPY_DTYPE(ContactRecord, collision1, collision2, position, normal, depth, force, torque);
  bind_shapes(m);
  bind_links(m);
  bind_joints(m);
  bind_models(m);
  bind_noise(m);
  bind_world(m);
  bind_rays(m);
}
