#include "motion/cost_sources.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
using Scene = PlanningScene;
using Matrix = AllowedCollisionMatrix;
using Shapes = std::vector<std::shared_ptr<Shape>>;

py::object entryToPython(Matrix::Entry entry)
{
  return entry == Matrix::None ? py::object(py::none()) : py::object(py::bool_(entry == Matrix::Allowed));
}

Matrix::Entry entryFromPython(const std::optional<bool>& allowed)
{
  return !allowed ? Matrix::None : *allowed ? Matrix::Allowed : Matrix::Never;
}

void bindMatrix(py::module_& m)
{
  py::class_<Matrix>(m, "AllowedCollisionMatrix", "Which pairs of names may touch.")
      .def(py::init<>())
      .def_static("from_model", [](const std::shared_ptr<RobotModel>& model) { return Matrix(*model); })
      .def_static(
          "from_matrix",
          [](const std::vector<std::string>& names, const py::array_t<bool, py::array::c_style | py::array::forcecast>& cells,
             const std::map<std::string, bool>& defaults) {
            Matrix matrix;
            const py::ssize_t n = static_cast<py::ssize_t>(names.size());
            if (n > 0 && (cells.ndim() != 2 || cells.shape(0) != n || cells.shape(1) != n))
              throw InvalidInput("allowed collision matrix: " + std::to_string(n) + " names need as many rows and columns");
            for (py::ssize_t i = 0; i < n; ++i)
              for (py::ssize_t j = i; j < n; ++j)
              {
                if (*cells.data(i, j) != *cells.data(j, i))
                  throw InvalidInput("allowed collision matrix: the entries of '" + names[i] + "' and '" + names[j] +
                                     "' contradict each other");
                matrix.setEntry(names[i], names[j], *cells.data(i, j) ? Matrix::Allowed : Matrix::Never);
              }
            for (const auto& [name, allowed] : defaults)
              matrix.setDefault(name, allowed ? Matrix::Allowed : Matrix::Never);
            return matrix;
          },
          py::arg("names"), py::arg("matrix"), py::arg("defaults") = std::map<std::string, bool>())
      .def_property_readonly("names", &Matrix::names)
      .def_property_readonly("defaults",
                             [](const Matrix& a) {
                               std::map<std::string, bool> out;
                               for (const auto& [name, entry] : a.defaults())
                                 out[name] = entry == Matrix::Allowed;
                               return out;
                             })
      .def("get", [](const Matrix& a, const std::string& x, const std::string& y) { return entryToPython(a.entry(x, y)); })
      .def(
          "set",
          [](Matrix& a, const std::string& x, const std::string& y, const std::optional<bool>& allowed) {
            a.setEntry(x, y, entryFromPython(allowed));
          },
          py::arg("a"), py::arg("b"), py::arg("allowed"))
      .def("get_default", [](const Matrix& a, const std::string& name) { return entryToPython(a.defaultEntry(name)); })
      .def("set_default", [](Matrix& a, const std::string& name,
                             const std::optional<bool>& allowed) { a.setDefault(name, entryFromPython(allowed)); })
      .def("remove", &Matrix::remove)
      .def("allowed", &Matrix::allowed)
      .def("matrix",
           [](const Matrix& a) {
             const auto names = a.names();
             py::array_t<bool> cells({names.size(), names.size()});
             auto view = cells.mutable_unchecked<2>();
             for (std::size_t i = 0; i < names.size(); ++i)
               for (std::size_t j = 0; j < names.size(); ++j)
                 view(i, j) = a.entry(names[i], names[j]) == Matrix::Allowed;
             return py::make_tuple(names, cells);
           })
      .def("copy", [](const Matrix& a) { return Matrix(a); });
}

const char* typeName(BodyType type)
{
  return type == BodyType::RobotLink ? "robot_link" : type == BodyType::Attached ? "attached" : "world";
}

void bindResults(py::module_& m)
{
  py::class_<Contact>(m, "Contact", "Where two bodies touch: position (3,) m, normal (3,) from body 1 to body 2, depth m.")
      .def_readonly("body_1", &Contact::body_1)
      .def_readonly("body_2", &Contact::body_2)
      .def_property_readonly("type_1", [](const Contact& c) { return typeName(c.type_1); })
      .def_property_readonly("type_2", [](const Contact& c) { return typeName(c.type_2); })
      .def_readonly("position", &Contact::position)
      .def_readonly("normal", &Contact::normal)
      .def_readonly("depth", &Contact::depth)
      .def("__repr__", [](const Contact& c) { return "<contact of '" + c.body_1 + "' and '" + c.body_2 + "'>"; });
  py::class_<CostSource>(m, "CostSource", "A box of the model frame: its corners `low` and `high` (3,) m, its `density`.")
      .def_readonly("low", &CostSource::low)
      .def_readonly("high", &CostSource::high)
      .def_readonly("density", &CostSource::density);
  py::class_<CollisionResult>(m, "CollisionResult", "True in a condition if there is a collision.")
      .def_readonly("collision", &CollisionResult::collision)
      .def_readonly("contacts", &CollisionResult::contacts)
      .def_readonly("distance", &CollisionResult::distance)
      .def("__bool__", [](const CollisionResult& r) { return r.collision; });
  py::class_<DistanceResult>(m, "DistanceResult")
      .def_readonly("distance", &DistanceResult::distance)
      .def_readonly("body_1", &DistanceResult::body_1)
      .def_readonly("body_2", &DistanceResult::body_2)
      .def_property_readonly("points", [](const DistanceResult& r) {
        Eigen::Matrix<double, 2, 3, Eigen::RowMajor> points;
        points.row(0) = r.point_1.transpose();
        points.row(1) = r.point_2.transpose();
        return points;
      });
  py::class_<WorldObject>(m, "WorldObject")
      .def_readonly("id", &WorldObject::id)
      .def_readonly("type", &WorldObject::type)
      .def_readonly("pose", &WorldObject::pose)
      .def_property_readonly("shapes",
                             [](const WorldObject& o) {
                               Shapes out;
                               for (const ShapePtr& s : o.shapes)
                                 out.push_back(std::const_pointer_cast<Shape>(s));
                               return out;
                             })
      .def_readonly("shape_poses", &WorldObject::shape_poses)
      .def_readonly("subframes", &WorldObject::subframes);
}

void bindObjects(py::class_<Scene, std::shared_ptr<Scene>>& c)
{
  c.def(
       "add_object",
       [](Scene& s, const std::string& id, const Shapes& shapes, const std::optional<std::vector<Transform>>& shape_poses,
          const std::optional<Transform>& pose, const Subframes& subframes, const std::optional<std::string>& type) {
         WorldObject object;
         object.id = id;
         object.shapes.assign(shapes.begin(), shapes.end());
         object.shape_poses = shape_poses.value_or(std::vector<Transform>());
         object.pose = pose.value_or(Transform::Identity());
         object.subframes = subframes;
         object.type = type.value_or("");
         s.addObject(object);
       },
       py::arg("id"), py::arg("shapes"), py::arg("shape_poses") = py::none(), py::arg("pose") = py::none(),
       py::arg("subframes") = Subframes(), py::arg("type") = py::none(),
       "Adds or replaces; `pose` in the model frame, `shape_poses` and `subframes` in the object.")
      .def(
          "append_shapes",
          [](Scene& s, const std::string& id, const Shapes& shapes, const std::optional<std::vector<Transform>>& poses) {
            s.appendShapes(id, std::vector<ShapePtr>(shapes.begin(), shapes.end()), poses.value_or(std::vector<Transform>()));
          },
          py::arg("id"), py::arg("shapes"), py::arg("poses") = py::none())
      .def("move_object", &Scene::moveObject, py::arg("id"), py::arg("pose"))
      .def("move_shapes", &Scene::moveShapes, py::arg("id"), py::arg("shape_poses"))
      .def("remove_object", &Scene::removeObject, py::arg("id"))
      .def("forget", &Scene::forget, py::arg("id"), "Drop the colour and permissions of an object that is no more.")
      .def("clear_objects", &Scene::clearObjects)
      .def_property_readonly("objects", &Scene::objectNames)
      .def("object", [](const Scene& s, const std::string& id) { return WorldObject(s.object(id)); })
      .def("has_object", [](const Scene& s, const std::string& id) { return s.findObject(id) != nullptr; })
      .def(
          "set_octomap",
          [](Scene& s, const std::shared_ptr<OcTreeShape>& tree, const std::optional<Transform>& pose) {
            s.setOctomap(tree, pose.value_or(Transform::Identity()));
          },
          py::arg("tree").none(true), py::arg("pose") = py::none())
      .def_property_readonly("octomap",
                             [](const Scene& s) -> std::shared_ptr<Shape> {
                               const WorldObject* object = s.findObject(Scene::OCTOMAP);
                               return object ? std::const_pointer_cast<Shape>(object->shapes[0]) : nullptr;
                             })
      .def_property_readonly("octomap_pose",
                             [](const Scene& s) {
                               const WorldObject* object = s.findObject(Scene::OCTOMAP);
                               return object ? object->pose : Transform::Identity();
                             })
      .def("attach", [](Scene& s, const std::shared_ptr<AttachedBody>& body) { s.attach(body); })
      .def(
          "attach_object",
          [](Scene& s, const std::string& id, const std::string& link, const std::vector<std::string>& touch_links) {
            s.attachObject(id, link, std::set<std::string>(touch_links.begin(), touch_links.end()));
          },
          py::arg("id"), py::arg("link"), py::arg("touch_links") = std::vector<std::string>())
      .def("detach_object", &Scene::detachObject, py::arg("id"));
}

CollisionRequest request(const std::string& group, std::size_t contacts, std::size_t per_pair, bool padded, bool self,
                         bool world, bool distance)
{
  CollisionRequest out;
  out.group = group;
  out.contacts = contacts;
  out.contacts_per_pair = std::max<std::size_t>(per_pair, 1);
  out.padded = padded;
  out.self = self;
  out.world = world;
  out.distance = distance;
  return out;
}

void bindCosts(py::class_<Scene, std::shared_ptr<Scene>>& c)
{
  c.def(
      "cost_sources",
      [](const Scene& s, const RobotState* state, const std::string& group, std::size_t most) {
        const RobotState at = state ? *state : s.state();
        const CollisionRequest wanted = request(group, 0, 1, true, true, true, false);
        py::gil_scoped_release release;
        return costSources(s, at, wanted, most);
      },
      py::arg("state") = py::none(), py::arg("group") = "", py::arg("most") = 100,
      "Where shapes that collide share room, the most costly first.");
}

void bindChecks(py::class_<Scene, std::shared_ptr<Scene>>& c)
{
  c.def_property(
       "acm", [](const Scene& s) { return Matrix(s.acm()); }, &Scene::setAcm)
      .def("set_acm", &Scene::setAcm)
      .def_property_readonly("padding", &Scene::padding)
      .def_property_readonly("scale", &Scene::scale)
      .def("set_padding", &Scene::setPadding, "{link: m}; links not named keep theirs.")
      .def("set_scale", &Scene::setScale)
      .def(
          "check",
          [](const Scene& s, const RobotState* state, const std::string& group, std::size_t contacts, std::size_t per_pair,
             bool padded, const Matrix* acm, bool self, bool world, bool distance) {
            const RobotState at = state ? *state : s.state();
            const CollisionRequest wanted = request(group, contacts, per_pair, padded, self, world, distance);
            py::gil_scoped_release release;
            return s.check(at, wanted, acm);
          },
          py::arg("state") = py::none(), py::arg("group") = "", py::arg("contacts") = 0, py::arg("per_pair") = 1,
          py::arg("padded") = true, py::arg("acm") = py::none(), py::arg("self_collision") = true, py::arg("world") = true,
          py::arg("distance") = false)
      .def(
          "check_states",
          [](const Scene& s, const std::string& group, const Array& rows, const RobotState* state, bool padded) {
            RobotState at = state ? *state : s.state();
            const JointModelGroup& g = s.model()->group(group);
            const auto values = rowsFromArray(rows, g.size(), "states of group '" + group + "'");
            py::array_t<bool> out(static_cast<py::ssize_t>(values.size()));
            bool* hit = out.mutable_data();
            py::gil_scoped_release release;
            CollisionRequest wanted;
            wanted.group = group;
            wanted.padded = padded;
            for (std::size_t i = 0; i < values.size(); ++i)
            {
              at.setGroup(g, values[i].data());
              hit[i] = s.check(at, wanted).collision;
            }
            return out;
          },
          py::arg("group"), py::arg("states"), py::arg("state") = py::none(), py::arg("padded") = true,
          "(k,) bool: which of the (k, n) group values collide.")
      .def(
          "distance",
          [](const Scene& s, const RobotState* state, const std::string& group, double max_distance) {
            const RobotState at = state ? *state : s.state();
            py::gil_scoped_release release;
            return s.distance(at, group, max_distance);
          },
          py::arg("state") = py::none(), py::arg("group") = "",
          py::arg("max_distance") = std::numeric_limits<double>::infinity());
}
}  // namespace

void bindScene(py::module_& m)
{
  bindMatrix(m);
  bindResults(m);
  py::class_<Scene, std::shared_ptr<Scene>> c(m, "PlanningScene", "A robot among objects; copies share until written.");
  c.def(py::init([](const std::shared_ptr<RobotModel>& model) { return std::make_shared<Scene>(model); }), py::arg("model"))
      .def_readwrite("name", &Scene::name)
      .def_property_readonly("model", [](const Scene& s) { return std::const_pointer_cast<RobotModel>(s.model()); })
      .def_property_readonly("frame", &Scene::frame)
      .def_property(
          "state", [](const Scene& s) { return RobotState(s.state()); }, &Scene::setState,
          "A copy of the robot's state; assign to change it.")
      .def("set_state", &Scene::setState)
      .def("copy", [](const Scene& s) { return std::make_shared<Scene>(s); })
      .def("diff", [](const Scene& s) { return std::make_shared<Scene>(s); })
      .def_property_readonly("transforms", &Scene::transforms)
      .def("set_transform", &Scene::setTransform, py::arg("frame"), py::arg("pose"))
      .def("remove_transform", &Scene::removeTransform)
      .def(
          "frame_pose",
          [](const Scene& s, const std::string& name, const RobotState* state) {
            Transform pose;
            if (!s.framePose(name, state ? *state : s.state(), pose))
              throwUnknown("frame", name, "the planning scene", s.frameNames());
            return pose;
          },
          py::arg("name"), py::arg("state") = py::none())
      .def("knows_frame",
           [](const Scene& s, const std::string& name) {
             Transform pose;
             return s.framePose(name, s.state(), pose);
           })
      .def_property_readonly("colors", [](const Scene& s) { return s.colors; })
      .def("set_color", [](Scene& s, const std::string& id, const Color& rgba) { s.colors[id] = rgba; })
      .def("remove_color", [](Scene& s, const std::string& id) { s.colors.erase(id); });
  bindObjects(c);
  bindChecks(c);
  bindCosts(c);
}
}  // namespace motion
