// libBuoyancyPlugin.so: Archimedes, of whole links under water; there is no surface. Volumes are those of the collisions, or as told.
#include <map>
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

using ignition::math::Vector3d;

class BuoyancyPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    if (sdf->HasElement("fluid_density"))
      density_ = sdf->Get<double>("fluid_density");
    world_ = model->GetWorld();
    if (sdf->HasElement("link"))
      for (auto told = sdf->GetElement("link"); told; told = told->GetNextElement("link"))
        take(*model, told);
    for (const physics::LinkPtr& link : model->GetLinks())
      if (!bodies_.count(link) && !measure(link))
        gzwarn << "link " << link->GetScopedName() << " has no volume for the BuoyancyPlugin; it floats as a stone does\n";
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnUpdate(); });
  }

private:
  struct Body
  {
    double volume = 0;  // m3
    Vector3d centre;    // m, link frame
  };

  void take(physics::Model& model, const sdf::ElementPtr& told)
  {
    const std::string name = told->HasAttribute("name") ? told->Get<std::string>("name") : "";
    const physics::LinkPtr link = name.empty() ? physics::LinkPtr() : model.GetLink(name);
    if (!link)
      throw std::runtime_error("<link name='" + name + "'>: the model has no such link");
    if (!told->HasElement("volume") || !told->HasElement("center_of_volume") || !(told->Get<double>("volume") > 0))
    {
      gzwarn << "<link name='" << name << "'> needs a <center_of_volume> and a <volume> above 0; its collisions count\n";
      return;
    }
    bodies_[link] = { told->Get<double>("volume"), told->Get<Vector3d>("center_of_volume") };
  }

  bool measure(const physics::LinkPtr& link)
  {
    Body body;
    for (const physics::CollisionPtr& collision : link->GetCollisions())
    {
      const double volume = collision->GetShape()->ComputeVolume();
      body.volume += volume;
      body.centre += volume * collision->RelativePose().Pos();
    }
    if (!(body.volume > 0))
      return false;
    body.centre /= body.volume;
    bodies_[link] = body;
    return true;
  }

  void OnUpdate()
  {
    const Vector3d lift = -density_ * world_->Gravity();
    for (const auto& [link, body] : bodies_)
      link->AddLinkForce(link->WorldPose().Rot().RotateVectorReverse(body.volume * lift), body.centre);
  }

  physics::WorldPtr world_;
  double density_ = 999.1026;  // kg/m3, of water
  std::map<physics::LinkPtr, Body> bodies_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(BuoyancyPlugin)

}  // namespace gazebo
