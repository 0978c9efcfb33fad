// Rays of ODE that plugins make and look for themselves. The world is not in ODE's spaces as Gazebo has it: one geom of a class of its own
// stands for all that there is, and a ray meets there what the simulator's own rays meet.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <unordered_map>
#include <vector>

#include <gazebo/physics/ode/ODECollision.hh>
#include <gazebo/physics/ode/ODEPhysics.hh>
#include <gazebo/physics/ode/ODERayShape.hh>

#include "contacts.hpp"
#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Vector3d;

class ODEPhysics::RayTarget
{
public:
  explicit RayTarget(physics::World& world)
    : world_(world)
    , collision_(new ODECollision(LinkPtr()))
    , space_(dSimpleSpaceCreate(nullptr))
    , geom_(dCreateGeom(geom_class()))
  {
    dSpaceSetCleanup(space_, 0);
    dGeomSetData(geom_, collision_.get());
    dSpaceAdd(space_, geom_);
  }
  ~RayTarget()
  {
    dGeomDestroy(geom_);
    dSpaceDestroy(space_);
  }

  dSpaceID space()
  {
    known_.clear();
    return space_;
  }

private:
  struct Meeting
  {
    double origin[3], direction[3], length, range;
    int32_t hit;
    bool of(dGeomID ray) const
    {
      dVector3 p, d;
      dGeomRayGet(ray, p, d);
      return std::equal(p, p + 3, origin) && std::equal(d, d + 3, direction) && dGeomRayGetLength(ray) <= length;
    }
  };

  static int geom_class()
  {
    static const int number = [] {
      dGeomClass described = {};
      described.collider = [](int other) -> dColliderFn* { return other == dRayClass ? &meet : nullptr; };
      described.aabb = &dInfiniteAABB;
      return dCreateGeomClass(&described);
    }();
    return number;
  }

  static int meet(dGeomID target, dGeomID ray, int, dContactGeom* contact, int)
  {
    const auto* collision = static_cast<ODECollision*>(dGeomGetData(target));
    return static_cast<ODEPhysics&>(*collision->GetWorld()->Physics()).all_->first(target, ray, *contact);
  }

  int first(dGeomID target, dGeomID ray, dContactGeom& contact)
  {
    auto known = known_.find(ray);
    if (known == known_.end() || !known->second.of(ray))
    {
      cast(ray);
      known = known_.find(ray);
    }
    const Meeting& found = known->second;
    if (found.hit < 0 || found.range > dGeomRayGetLength(ray))
      return 0;
    for (int i = 0; i < 3; ++i)
    {
      contact.pos[i] = found.origin[i] + found.range * found.direction[i];
      contact.normal[i] = -found.direction[i];
    }
    contact.depth = found.range;
    contact.g1 = target, contact.g2 = ray;
    contact.side1 = contact.side2 = -1;
    const Collision* const hit = collision_of(found.hit);
    collision_->SetLaserRetro(hit ? hit->GetLaserRetro() : 0);
    return 1;
  }

  // All rays of the ray's space at once: what there is to meet is gathered for each cast.
  void cast(dGeomID one)
  {
    std::vector<dGeomID> rays;
    if (dSpaceID space = dGeomGetSpace(one))
      for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
        if (dGeomID geom = dSpaceGetGeom(space, i); dGeomGetClass(geom) == dRayClass)
          rays.push_back(geom);
    if (rays.empty())
      rays.push_back(one);
    std::vector<double> origins, directions, ranges(rays.size());
    std::vector<int32_t> hits(rays.size());
    double longest = 0;
    for (dGeomID ray : rays)
    {
      dVector3 p, d;
      dGeomRayGet(ray, p, d);
      origins.insert(origins.end(), p, p + 3);
      directions.insert(directions.end(), d, d + 3);
      longest = std::max(longest, dGeomRayGetLength(ray));
    }
    ode_sim::cast_rays(world_.Core()->scene(), origins.data(), directions.data(), static_cast<int>(rays.size()), longest, {},
                       ranges.data(), hits.data());
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      Meeting& found = known_[rays[i]];
      std::copy_n(&origins[3 * i], 3, found.origin);
      std::copy_n(&directions[3 * i], 3, found.direction);
      found.length = longest, found.range = ranges[i], found.hit = hits[i];
    }
  }

  friend class ODEPhysics;
  physics::World& world_;
  boost::shared_ptr<ODECollision> collision_;
  dSpaceID space_;
  dGeomID geom_;
  std::unordered_map<dGeomID, Meeting> known_;  // since the space was asked for
};

ODEPhysics::ODEPhysics(WorldPtr world) : PhysicsEngine(world)
{
  const ode_sim::OdeScope scope;
  all_.reset(new RayTarget(*world));
  all_->collision_->SetWorld(world);
}
ODEPhysics::~ODEPhysics() = default;
dSpaceID ODEPhysics::GetSpaceId() const { return all_->space(); }

void ODECollision::SetCollision(dGeomID geom, bool)
{
  collisionId = geom;
  dGeomSetData(geom, this);
}

ODERayShape::ODERayShape(CollisionPtr collision) : RayShape(collision)
{
  auto& on = dynamic_cast<ODECollision&>(*collision);
  geomId = dCreateRay(on.GetSpaceId(), 2.0);
  on.SetCollision(geomId, false);
}
ODERayShape::~ODERayShape() { dGeomDestroy(geomId); }

void ODERayShape::Update()
{
  GlobalPoints(globalStartPos, globalEndPos);
  const Vector3d way = globalEndPos - globalStartPos;
  const double length = way.Length();
  if (!(length > 0) || !std::isfinite(length))
    return;
  dGeomRaySet(geomId, globalStartPos.X(), globalStartPos.Y(), globalStartPos.Z(), way.X(), way.Y(), way.Z());
  dGeomRaySetLength(geomId, length);
}

void ODERayShape::SetPoints(const Vector3d& start, const Vector3d& end)
{
  RayShape::SetPoints(start, end);
  Update();
}

}  // namespace physics
}  // namespace gazebo
