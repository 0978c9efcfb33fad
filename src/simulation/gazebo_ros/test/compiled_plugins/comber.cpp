// A lidar with a pattern of its own: three rays of ODE that it looks for itself, in a space of its own, and the same three by Gazebo's
// shape; in a ray sensor without <ray>. The pattern comes from a file that its <pattern> names: one angle a line, rad to the left.
#include <fstream>

#include <gazebo/physics/MultiRayShape.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/World.hh>
#include <gazebo/physics/ode/ODECollision.hh>
#include <gazebo/physics/ode/ODELink.hh>
#include <gazebo/physics/ode/ODEMultiRayShape.hh>
#include <gazebo/physics/ode/ODEPhysics.hh>
#include <gazebo/physics/ode/ODERayShape.hh>
#include <gazebo/plugins/RayPlugin.hh>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

namespace gazebo
{
namespace
{

using ignition::math::Vector3d;

class Comb : public physics::MultiRayShape
{
public:
  explicit Comb(physics::CollisionPtr parent) : MultiRayShape(parent)
  {
    outer_ = dSimpleSpaceCreate(nullptr);
    inner_ = dSimpleSpaceCreate(outer_);
    dGeomSetCategoryBits(reinterpret_cast<dGeomID>(inner_), GZ_SENSOR_COLLIDE);
    dGeomSetCollideBits(reinterpret_cast<dGeomID>(inner_), ~GZ_SENSOR_COLLIDE);
    boost::static_pointer_cast<physics::ODELink>(collisionParent->GetLink())->SetSpaceId(inner_);
    boost::static_pointer_cast<physics::ODECollision>(collisionParent)->SetSpaceId(inner_);
  }
  ~Comb() override
  {
    rays.clear();
    dSpaceDestroy(inner_);
    dSpaceDestroy(outer_);
  }
  void AddRay(const Vector3d& start, const Vector3d& end) override
  {
    const physics::ODECollisionPtr tooth(new physics::ODECollision(collisionParent->GetLink()));
    tooth->SetSpaceId(inner_);
    const physics::ODERayShapePtr ray(new physics::ODERayShape(tooth));
    ray->SetPoints(start, end);
    teeth_.push_back(tooth);
    tooth->SetShape(ray);
    rays.push_back(ray);
  }
  void UpdateRays() override
  {
    const auto ode = boost::dynamic_pointer_cast<physics::ODEPhysics>(GetWorld()->Physics());
    const boost::recursive_mutex::scoped_lock lock(*ode->GetPhysicsUpdateMutex());
    dSpaceCollide2(reinterpret_cast<dGeomID>(outer_), reinterpret_cast<dGeomID>(ode->GetSpaceId()), this, &near);
  }

private:
  static void near(void* data, dGeomID one, dGeomID other)
  {
    if (dGeomIsSpace(one) || dGeomIsSpace(other))
      return dSpaceCollide2(one, other, data, &near);
    if (dGeomGetClass(one) != dRayClass)
      std::swap(one, other);
    dGeomRaySetClosestHit(one, 1);
    dContactGeom contact;
    if (!dCollide(one, other, 1, &contact, sizeof contact))
      return;
    auto* tooth = static_cast<physics::ODECollision*>(dGeomGetData(one));
    auto* hit = static_cast<physics::ODECollision*>(dGeomGetData(other));
    const auto ray = boost::static_pointer_cast<physics::RayShape>(tooth->GetShape());
    if (contact.depth >= ray->GetLength())
      return;
    ray->SetLength(contact.depth);
    ray->SetRetro(hit->GetLaserRetro());
  }

  dSpaceID outer_, inner_;
  std::vector<physics::CollisionPtr> teeth_;
};

}  // namespace

class Comber : public RayPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override
  {
    RayPlugin::Load(sensor, sdf);
    std::ifstream pattern(sdf->Get<std::string>("pattern"));
    const std::vector<double> angles{ std::istream_iterator<double>(pattern), std::istream_iterator<double>() };
    own_ = made(sensor, [](const physics::CollisionPtr& parent) { return new Comb(parent); });
    gazebos_ = made(sensor, [](const physics::CollisionPtr& parent) { return new physics::ODEMultiRayShape(parent); });
    for (const auto& shape : { own_, gazebos_ })
    {
      shape->Load(sdf);
      for (const double angle : angles)
        shape->AddRay(Vector3d::Zero, Vector3d(10 * std::cos(angle), 10 * std::sin(angle), 0));
    }
    values_ = nh_.advertise<std_msgs::Float64MultiArray>("comb", 1000, true);
    sensor->SetActive(true);
  }
  void OnNewLaserScans() override
  {
    std_msgs::Float64MultiArray message;
    message.data.push_back(world->SimTime().Double());
    for (const auto& shape : { own_, gazebos_ })
    {
      shape->Update();
      for (unsigned int i = 0; i < shape->RayCount(); ++i)
        message.data.push_back(shape->GetRange(i)), message.data.push_back(shape->GetRetro(i));
    }
    values_.publish(message);
  }

private:
  template <typename Make>
  physics::MultiRayShapePtr made(const sensors::SensorPtr& sensor, const Make& make)
  {
    const physics::CollisionPtr collision = world->Physics()->CreateCollision("multiray", sensor->ParentName());
    collision->SetName("comb");
    collision->SetRelativePose(sensor->Pose());
    collision->SetInitialRelativePose(sensor->Pose());
    const physics::MultiRayShapePtr shape(make(collision));
    shape->SetWorld(world);
    collision->SetShape(shape);
    return shape;
  }

  ros::NodeHandle nh_;
  ros::Publisher values_;
  physics::MultiRayShapePtr own_, gazebos_;
};
GZ_REGISTER_SENSOR_PLUGIN(Comber)

}  // namespace gazebo
