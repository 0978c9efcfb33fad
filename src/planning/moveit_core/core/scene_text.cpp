#include <moveit/planning_scene/scene_text.h>

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>

#include <moveit/planning_scene/planning_scene.h>

#include "log_names.hpp"

namespace planning_scene
{
namespace
{
using shape_msgs::SolidPrimitive;

// Kind: primitive, and which dimension each number of the file is.
struct Kind
{
  uint8_t type;
  std::vector<std::size_t> order;
};
const std::map<std::string, Kind>& kinds()
{
  static const std::map<std::string, Kind> all{ { "box", { SolidPrimitive::BOX, { 0, 1, 2 } } },
                                                { "sphere", { SolidPrimitive::SPHERE, { 0 } } },
                                                { "cylinder", { SolidPrimitive::CYLINDER, { 1, 0 } } },
                                                { "cone", { SolidPrimitive::CONE, { 1, 0 } } } };
  return all;
}

void write(std::ostream& out, const geometry_msgs::Pose& pose)
{
  const auto& q = pose.orientation;
  const bool given = q.x != 0 || q.y != 0 || q.z != 0 || q.w != 0;
  out << pose.position.x << ' ' << pose.position.y << ' ' << pose.position.z << '\n'
      << q.x << ' ' << q.y << ' ' << q.z << ' ' << (given ? q.w : 1.0) << '\n';
}

void write(std::ostream& out, const shape_msgs::Mesh& mesh)
{
  out << "mesh\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << '\n';
  for (const auto& v : mesh.vertices)
    out << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& t : mesh.triangles)
    out << t.vertex_indices[0] << ' ' << t.vertex_indices[1] << ' ' << t.vertex_indices[2] << '\n';
}

void write(std::ostream& out, const SolidPrimitive& primitive)
{
  for (const auto& kind : kinds())
  {
    if (kind.second.type != primitive.type)
      continue;
    out << kind.first << '\n';
    const char* between = "";
    for (const std::size_t i : kind.second.order)
    {
      out << between << primitive.dimensions[i];
      between = " ";
    }
    out << '\n';
  }
}

// Words and lines of a text.
class Reader
{
public:
  explicit Reader(const std::string& text) : text_(text) {}

  std::runtime_error problem(const std::string& what) const
  {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    return std::runtime_error("line " + std::to_string(line) + ": " + what);
  }
  std::string line()
  {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string found = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    while (!found.empty() && std::isspace(static_cast<unsigned char>(found.back())))
      found.pop_back();
    const std::size_t first = found.find_first_not_of(" \t");
    return first == std::string::npos ? std::string() : found.substr(first);
  }
  std::string word(const char* what)
  {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
      ++at_;
    const std::size_t start = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_])))
      ++at_;
    if (start == at_)
      throw problem(std::string("the text ends where ") + what + " is expected");
    return text_.substr(start, at_ - start);
  }
  // As many finite numbers as there are places.
  template <typename Number>
  void numbers(const std::vector<Number*>& places, const std::string& what)
  {
    std::string found;
    bool good = true;
    for (Number* place : places)
    {
      const std::string one = word(what.c_str());
      std::istringstream stream(one);
      stream.imbue(std::locale::classic());
      good = (stream >> *place) && stream.peek() == std::istringstream::traits_type::eof() && good;
      found += (found.empty() ? "" : " ") + one;
    }
    if (!good)
      throw problem(what + " is " + std::to_string(places.size()) + (places.size() == 1 ? " number" : " numbers") + ", not '" +
                    found.substr(0, 60) + "'");
  }
  std::size_t count(const std::string& what, std::size_t most = 10000000)
  {
    const std::string found = word(("the number of " + what).c_str());
    const bool digits = found.size() < 9 && found.find_first_not_of("0123456789") == std::string::npos;
    if (!digits || std::stoul(found) > most)
      throw problem("the number of " + what + " is '" + found.substr(0, 20) + "'");
    return std::stoul(found);
  }
  geometry_msgs::Pose pose()
  {
    geometry_msgs::Pose pose;
    numbers<double>({ &pose.position.x, &pose.position.y, &pose.position.z }, "a position");
    numbers<double>({ &pose.orientation.x, &pose.orientation.y, &pose.orientation.z, &pose.orientation.w }, "a quaternion");
    return pose;
  }
  // Since Noetic three lines stand between "* name" and the first shape: position, orientation, number of shapes.
  bool hasObjectPoses() const
  {
    Reader copy = *this;
    if (at_ >= text_.size() || copy.word("*") != "*")
      return true;
    copy.line();
    std::istringstream first(copy.line());
    std::size_t numbers = 0;
    for (std::string part; first >> part;)
      ++numbers;
    return numbers == 3;
  }

private:
  std::string text_;
  std::size_t at_ = 0;
};

void readShape(Reader& reader, moveit_msgs::CollisionObject& object)
{
  const std::string name = reader.word("a shape");
  const auto kind = kinds().find(name);
  if (kind != kinds().end())
  {
    SolidPrimitive primitive;
    primitive.type = kind->second.type;
    primitive.dimensions.resize(kind->second.order.size());
    std::vector<double*> sizes;
    for (const std::size_t i : kind->second.order)
      sizes.push_back(&primitive.dimensions[i]);
    reader.numbers(sizes, "a " + name);
    object.primitives.push_back(primitive);
    object.primitive_poses.push_back(reader.pose());
  }
  else if (name == "plane")
  {
    shape_msgs::Plane plane;
    reader.numbers<double>({ &plane.coef[0], &plane.coef[1], &plane.coef[2], &plane.coef[3] }, "a plane");
    object.planes.push_back(plane);
    object.plane_poses.push_back(reader.pose());
  }
  else if (name == "mesh")
  {
    shape_msgs::Mesh mesh;
    mesh.vertices.resize(reader.count("vertices"));
    mesh.triangles.resize(reader.count("triangles"));
    for (auto& v : mesh.vertices)
      reader.numbers<double>({ &v.x, &v.y, &v.z }, "a vertex");
    for (auto& t : mesh.triangles)
      for (auto& index : t.vertex_indices)
        index = reader.count("vertices of a triangle", std::max<std::size_t>(mesh.vertices.size(), 1) - 1);
    object.meshes.push_back(mesh);
    object.mesh_poses.push_back(reader.pose());
  }
  else
  {
    throw reader.problem("shape '" + name.substr(0, 20) +
                         "' is unknown; there are box, sphere, cylinder, cone, plane and mesh");
  }
}
}  // namespace

std::string writeScene(const moveit_msgs::PlanningScene& scene)
{
  std::map<std::string, std_msgs::ColorRGBA> colors;
  for (const auto& entry : scene.object_colors)
    colors[entry.id] = entry.color;
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(9) << scene.name << '\n';
  for (const moveit_msgs::CollisionObject& object : scene.world.collision_objects)
  {
    const std_msgs::ColorRGBA color = colors[object.id];
    const auto finish = [&out, &color](const std::vector<geometry_msgs::Pose>& poses, std::size_t i) {
      write(out, i < poses.size() ? poses[i] : geometry_msgs::Pose());
      out << color.r << ' ' << color.g << ' ' << color.b << ' ' << color.a << '\n';
    };
    out << "* " << object.id << '\n';
    write(out, object.pose);
    out << object.primitives.size() + object.meshes.size() + object.planes.size() << '\n';
    for (std::size_t i = 0; i < object.primitives.size(); ++i)
    {
      write(out, object.primitives[i]);
      finish(object.primitive_poses, i);
    }
    for (std::size_t i = 0; i < object.meshes.size(); ++i)
    {
      write(out, object.meshes[i]);
      finish(object.mesh_poses, i);
    }
    for (std::size_t i = 0; i < object.planes.size(); ++i)
    {
      const auto& plane = object.planes[i].coef;
      out << "plane\n" << plane[0] << ' ' << plane[1] << ' ' << plane[2] << ' ' << plane[3] << '\n';
      finish(object.plane_poses, i);
    }
    out << object.subframe_names.size() << '\n';
    for (std::size_t i = 0; i < object.subframe_names.size(); ++i)
    {
      out << object.subframe_names[i] << '\n';
      write(out, i < object.subframe_poses.size() ? object.subframe_poses[i] : geometry_msgs::Pose());
    }
  }
  out << ".\n";
  return out.str();
}

moveit_msgs::PlanningScene readScene(const std::string& text, const std::string& frame)
{
  Reader reader(text);
  moveit_msgs::PlanningScene scene;
  scene.name = reader.line();
  scene.is_diff = scene.robot_state.is_diff = true;
  const bool poses = reader.hasObjectPoses();
  for (;;)
  {
    const std::string marker = reader.word("'* <object>' or the final '.'");
    if (marker == ".")
      return scene;
    if (marker != "*")
      throw reader.problem("'" + marker.substr(0, 20) + "' stands where '* <object>' or the final '.' is expected");
    moveit_msgs::CollisionObject object;
    object.header.frame_id = frame;
    object.id = reader.line();
    object.operation = moveit_msgs::CollisionObject::ADD;
    object.pose.orientation.w = 1.0;
    if (poses)
      object.pose = reader.pose();
    moveit_msgs::ObjectColor color;
    color.id = object.id;
    bool colored = false;
    for (std::size_t left = reader.count("shapes"); left; --left)
    {
      readShape(reader, object);
      std_msgs::ColorRGBA of_shape;
      reader.numbers<float>({ &of_shape.r, &of_shape.g, &of_shape.b, &of_shape.a }, "a colour");
      if (of_shape.r != 0 || of_shape.g != 0 || of_shape.b != 0 || of_shape.a != 0)
      {
        color.color = of_shape;
        colored = true;
      }
    }
    for (std::size_t left = poses ? reader.count("subframes") : 0; left; --left)
    {
      object.subframe_names.push_back(reader.word("a subframe's name"));
      object.subframe_poses.push_back(reader.pose());
    }
    scene.world.collision_objects.push_back(object);
    if (colored)
      scene.object_colors.push_back(color);
  }
}

void PlanningScene::saveGeometryToStream(std::ostream& out) const
{
  moveit_msgs::PlanningScene scene;
  scene.name = name_;
  getCollisionObjectMsgs(scene.world.collision_objects);
  getObjectColorMsgs(scene.object_colors);
  out << writeScene(scene);
}

bool PlanningScene::loadGeometryFromStream(std::istream& in, const Eigen::Isometry3d& offset)
{
  std::string text;
  for (std::string line; std::getline(in, line);)
  {
    text += line + '\n';
    if (line == "." || line == ".\r")
      break;  // another scene may follow
  }
  moveit_msgs::PlanningScene scene;
  try
  {
    scene = readScene(text, getPlanningFrame());
  }
  catch (const std::runtime_error& error)
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "This is no text of a scene's geometry: %s", error.what());
    return false;
  }
  for (moveit_msgs::CollisionObject& object : scene.world.collision_objects)
  {
    Eigen::Isometry3d pose;
    tf2::fromMsg(object.pose, pose);
    object.pose = tf2::toMsg(Eigen::Isometry3d(offset * pose));
  }
  name_ = scene.name;
  return setPlanningSceneDiffMsg(scene);
}
}  // namespace planning_scene
