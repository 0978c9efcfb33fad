#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/util/system.hh>

#define GZ_ALL_COLLIDE 0x0FFFFFFF
#define GZ_NONE_COLLIDE 0x00000000
#define GZ_FIXED_COLLIDE 0x00000001
#define GZ_SENSOR_COLLIDE 0x00000002
#define GZ_GHOST_COLLIDE 0x10000000

namespace gazebo
{
namespace msgs
{
class Collision;
class Joint;
class Link;
class Model;
}  // namespace msgs

namespace physics
{
#define GZ_PHYSICS(name) \
  class name;            \
  typedef boost::shared_ptr<name> name##Ptr;
GZ_PHYSICS(Base)
GZ_PHYSICS(Contact)
GZ_PHYSICS(Entity)
GZ_PHYSICS(World)
GZ_PHYSICS(Model)
GZ_PHYSICS(Actor)
GZ_PHYSICS(Light)
GZ_PHYSICS(Link)
GZ_PHYSICS(Collision)
GZ_PHYSICS(Joint)
GZ_PHYSICS(JointController)
GZ_PHYSICS(PhysicsEngine)
GZ_PHYSICS(Shape)
GZ_PHYSICS(RayShape)
GZ_PHYSICS(HeightmapShape)
GZ_PHYSICS(MultiRayShape)
GZ_PHYSICS(Inertial)
GZ_PHYSICS(FrictionPyramid)
GZ_PHYSICS(SurfaceParams)
GZ_PHYSICS(BoxShape)
GZ_PHYSICS(CylinderShape)
GZ_PHYSICS(PlaneShape)
GZ_PHYSICS(MeshShape)
GZ_PHYSICS(PolylineShape)
GZ_PHYSICS(SphereShape)
#undef GZ_PHYSICS
class ContactManager;
class TrajectoryInfo;
typedef std::shared_ptr<TrajectoryInfo> TrajectoryInfoPtr;
class JointWrench;
class ModelState;
class LinkState;
class JointState;
class WorldState;
typedef std::vector<BasePtr> Base_V;
typedef std::vector<ModelPtr> Model_V;
typedef std::vector<ActorPtr> Actor_V;
typedef std::vector<JointPtr> Joint_V;
typedef std::vector<JointControllerPtr> JointController_V;
typedef std::vector<LightPtr> Light_V;
typedef std::vector<LinkPtr> Link_V;
typedef std::vector<CollisionPtr> Collision_V;
}  // namespace physics
}  // namespace gazebo

namespace ode_sim
{
struct Axis;
struct Feedback;
class RayFan;
class World;
struct Model;
struct Link;
struct Joint;
struct Shape;
struct HeightGrid;
}  // namespace ode_sim
