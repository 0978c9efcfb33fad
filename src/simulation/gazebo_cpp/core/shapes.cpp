// Shapes: what they are, as messages and in numbers, and how they change.
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <cmath>

#include <geometry.hpp>
#include <limits.hpp>

#include "contacts.hpp"
#include "convert.hpp"
#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

Shape::Shape(CollisionPtr parent, EntityType type) : Base(parent), owner_(parent.get())
{
  AddType(SHAPE);
  AddType(type);
}

double Shape::ComputeVolume() const
{
  if (!owner_ || !owner_->Core())
    return 0;
  const Vector3d size = owner_->BoundingBox().Size();
  return size.X() * size.Y() * size.Z();
}

namespace
{

/// Calls `f` with the geom of `collision` of the simulator: what touches it as it was wakes, and what will touch it then.
template <class Change>
void reshape(Collision* collision, std::initializer_list<double> sizes, const char* what, const Change& f)
{
  const std::shared_ptr<ode_sim::Shape> core = collision ? collision->Core() : nullptr;
  change(collision ? collision->GetScopedName() : std::string(what), [&] {
    const ode_sim::OdeScope scope;
    for (const double size : sizes)
      ode_sim::checked_size(size, what);
    if (ode_sim::World* world = core ? world_of(core->link->model) : nullptr)
      world->disturb(*core->link->model), core->link->model->changed = true;
    f(core && core->geom ? core.get() : nullptr);
  });
}

}  // namespace

void BoxShape::SetSize(const Vector3d& size)
{
  reshape(owner(), { size.X(), size.Y(), size.Z() }, "a side of a box", [&](ode_sim::Shape* core) {
    if (core)
      dGeomBoxSetLengths(core->geom, size.X(), size.Y(), size.Z());
    size_ = size;
  });
}

void SphereShape::SetRadius(const double& radius)
{
  reshape(owner(), { radius }, "the radius of a ball", [&](ode_sim::Shape* core) {
    if (core)
      dGeomSphereSetRadius(core->geom, radius);
    radius_ = radius;
  });
}

void CylinderShape::SetSize(double radius, double length)
{
  reshape(owner(), { radius, length }, "the radius or length of a cylinder", [&](ode_sim::Shape* core) {
    if (core && dGeomGetClass(core->geom) == dCapsuleClass)
      dGeomCapsuleSetParams(core->geom, radius, length);
    else if (core)
    {
      dGeomCylinderSetParams(core->geom, radius, length);
      ode_sim::Shape fresh;  // its other face, of triangles
      const ode_sim::OwnedGeom made = ode_sim::make_cylinder(fresh, radius, length);
      dGeomTriMeshSetData(core->faceted, fresh.faceted_mesh->data);
      fresh.faceted.reset();
      core->faceted_mesh.swap(fresh.faceted_mesh);
    }
    radius_ = radius, length_ = length;
  });
}

// -- height maps --------------------------------------------------------------------------------------------------------------------

const ode_sim::HeightGrid* HeightmapShape::grid() const
{
  const std::shared_ptr<ode_sim::Shape> core = owner() ? owner()->Core() : nullptr;
  return core && !core->grid.heights.empty() ? &core->grid : nullptr;
}

ignition::math::Vector2i HeightmapShape::VertexCount() const
{
  const ode_sim::HeightGrid* heights = grid();
  const int steps = std::max(1, sampling_);
  return heights ? ignition::math::Vector2i((heights->columns - 1) * steps + 1, (heights->rows - 1) * steps + 1)
                 : ignition::math::Vector2i();
}

float HeightmapShape::GetHeight(int column, int row) const
{
  const ode_sim::HeightGrid* heights = grid();
  const ignition::math::Vector2i count = VertexCount();
  if (!heights || column < 0 || row < 0 || column >= count.X() || row >= count.Y())
    return 0;
  const int steps = std::max(1, sampling_);
  const auto at = [&](int i, int j) {
    return heights->heights[static_cast<std::size_t>(std::min(j, heights->rows - 1)) * heights->columns +
                            std::min(i, heights->columns - 1)];
  };
  const int i = column / steps, j = row / steps;
  const double u = static_cast<double>(column % steps) / steps, v = static_cast<double>(row % steps) / steps;
  return static_cast<float>((1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) +
                            v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1)));
}

float HeightmapShape::GetMaxHeight() const { return grid() ? static_cast<float>(grid()->high) : 0; }
float HeightmapShape::GetMinHeight() const { return grid() ? static_cast<float>(grid()->low) : 0; }

// -- messages -----------------------------------------------------------------------------------------------------------------------

void Shape::FillMsg(msgs::Geometry& message) { message.set_type(msgs::Geometry::EMPTY); }

void BoxShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::BOX);
  msgs::Set(message.mutable_box()->mutable_size(), size_);
}

void SphereShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::SPHERE);
  message.mutable_sphere()->set_radius(radius_);
}

void CylinderShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::CYLINDER);
  message.mutable_cylinder()->set_radius(radius_);
  message.mutable_cylinder()->set_length(length_);
}

void PlaneShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::PLANE);
  msgs::Set(message.mutable_plane()->mutable_normal(), normal_);
  msgs::Set(message.mutable_plane()->mutable_size(), size_);
}

void MeshShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::MESH);
  message.mutable_mesh()->set_filename(uri_);
  msgs::Set(message.mutable_mesh()->mutable_scale(), scale_);
}

void PolylineShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::POLYLINE);
  msgs::Polyline& outline = *message.add_polyline();
  outline.set_height(height_);
  for (const ignition::math::Vector2d& corner : corners_)
    msgs::Set(outline.add_point(), corner);
}

void HeightmapShape::FillMsg(msgs::Geometry& message)
{
  message.set_type(msgs::Geometry::HEIGHTMAP);
  msgs::HeightmapGeom& map = *message.mutable_heightmap();
  msgs::Set(map.mutable_size(), size_);
  msgs::Set(map.mutable_origin(), position_);
  map.set_width(VertexCount().X());
  map.set_height(VertexCount().Y());
  map.set_filename(uri_);
  map.set_sampling(static_cast<unsigned int>(sampling_));
}

// -- rays ---------------------------------------------------------------------------------------------------------------------------

void RayShape::GlobalPoints(Vector3d& start, Vector3d& end)
{
  const Pose3d pose = collisionParent ? collisionParent->WorldPose() : Pose3d();
  start = pose.CoordPositionAdd(relativeStartPos), end = pose.CoordPositionAdd(relativeEndPos);
}

void RayShape::SetPoints(const Vector3d& start, const Vector3d& end)
{
  relativeStartPos = start, relativeEndPos = end;
  GlobalPoints(globalStartPos, globalEndPos);
}

void RayShape::Update()
{
  double distance;
  std::string entity;
  GetIntersection(distance, entity);
}

void RayShape::GetIntersection(double& distance, std::string& entity)
{
  GlobalPoints(globalStartPos, globalEndPos);
  const Vector3d &start = globalStartPos, way = globalEndPos - start;
  const double origin[3] = { start.X(), start.Y(), start.Z() }, direction[3] = { way.X(), way.Y(), way.Z() };
  double range = 0;
  int32_t hit = -1;
  const WorldPtr world = Mirror::Get().GetWorld();
  if (world && way.IsFinite())
  {
    const boost::recursive_mutex::scoped_lock lock(step_mutex());
    ode_sim::cast_rays(world->Core()->scene(), origin, direction, 1, way.Length(), {}, &range, &hit);
  }
  const Collision* found = hit >= 0 ? collision_of(hit) : nullptr;
  distance = found ? range : 1000;
  contactLen = distance;
  contactRetro = found ? found->GetLaserRetro() : 0;
  entity = found ? found->GetScopedName() : "";
  SetCollisionName(entity);
}

}  // namespace physics
}  // namespace gazebo
