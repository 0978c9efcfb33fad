// libMisalignmentPlugin.so: where the second of two <pose>s is, seen from the first, each in the world or in the model, link or collision
// that its "frame" names. /NAMESPACE/misalignment (gazebo.msgs.PoseStamped, each step); an Int on /NAMESPACE/enable switches it.
#include <atomic>
#include <stdexcept>
#include <string>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "../core/convert.hpp"

namespace gazebo
{

using ignition::math::Pose3d;

class MisalignmentPlugin : public WorldPlugin
{
public:
  void Load(physics::WorldPtr world, sdf::ElementPtr sdf) override
  {
    world_ = world;
    const sdf::ElementPtr first = sdf->HasElement("pose") ? sdf->GetElement("pose") : nullptr;
    const sdf::ElementPtr second = first ? first->GetNextElement("pose") : nullptr;
    if (!second)
      throw std::runtime_error("two <pose> elements are needed: the place that is meant, and the one that is compared with it");
    if (!sdf->HasElement("namespace"))
      throw std::runtime_error("<namespace> is missing: its topics stand in it");
    reference_ = Place(first), target_ = Place(second);
    space_ = "/" + sdf->Get<std::string>("namespace");
    enabled_ = !sdf->HasElement("enabled") || sdf->Get<bool>("enabled");
    node_.reset(new transport::Node);
    node_->Init();
    heard_ = node_->Subscribe(space_ + "/enable", &MisalignmentPlugin::OnEnable, this);
    told_ = node_->Advertise<msgs::PoseStamped>(space_ + "/misalignment");
    if (sdf->HasElement("debug") && sdf->Get<bool>("debug"))
    {
      reference_.told = node_->Advertise<msgs::PoseStamped>(space_ + "/debug/first_pose");
      target_.told = node_->Advertise<msgs::PoseStamped>(space_ + "/debug/second_pose");
    }
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) {
      if (enabled_)
        OnUpdate(info.simTime);
    });
  }

private:
  struct Place
  {
    Place() = default;
    explicit Place(const sdf::ElementPtr& sdf) : pose(sdf->Get<Pose3d>())
    {
      for (const char* name : { "frame", "relative_to" })
        if (frame.empty() && sdf->GetAttribute(name))
          frame = sdf->GetAttribute(name)->GetAsString();
    }
    Pose3d pose;
    std::string frame;
    bool missed = false;
    transport::PublisherPtr told;  // where it is in the world
  };

  void OnEnable(ConstIntPtr& message) { enabled_ = message->data() != 0; }

  // In the world; false, with a line, while what it stands in is not there.
  bool find(Place& place, Pose3d& found) const
  {
    found = place.pose;
    if (place.frame.empty())
      return true;
    const physics::EntityPtr entity = world_->EntityByName(place.frame);
    if (entity)
      found = place.pose + entity->WorldPose();
    else if (!place.missed)
      physics::refused("there is no '" + place.frame + "', which a <pose> stands in");
    place.missed = !entity;
    return entity != nullptr;
  }

  static void tell(const transport::PublisherPtr& publisher, const common::Time& time, const Pose3d& pose)
  {
    if (!publisher)
      return;
    msgs::PoseStamped message;
    msgs::Set(message.mutable_time(), time);
    msgs::Set(message.mutable_pose(), pose);
    publisher->Publish(message);
  }

  void OnUpdate(const common::Time& time)
  {
    Pose3d reference, target;
    if (!find(target_, target) || !find(reference_, reference))
      return;
    tell(reference_.told, time, reference);
    tell(target_.told, time, target);
    tell(told_, time, target - reference);
  }

  physics::WorldPtr world_;
  std::string space_;
  Place reference_, target_;
  std::atomic<bool> enabled_{ true };
  transport::NodePtr node_;
  transport::SubscriberPtr heard_;
  transport::PublisherPtr told_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_WORLD_PLUGIN(MisalignmentPlugin)

}  // namespace gazebo
