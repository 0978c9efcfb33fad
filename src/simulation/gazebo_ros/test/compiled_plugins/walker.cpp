// A model plugin of an actor: walks it along x by the animation 'walking'; with <thick> its boxes are so much thicker, and collide.
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

class Walker : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr element) override
  {
    actor_ = boost::dynamic_pointer_cast<physics::Actor>(model);
    if (!actor_)
      throw std::runtime_error("this is no actor");
    Reset();
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { OnUpdate(info); });
    if (!element->HasElement("thick"))
      return;
    const double thick = element->Get<double>("thick");
    for (const auto& link : actor_->GetLinks())
    {
      link->Init();
      for (const auto& collision : link->GetCollisions())
        if (const auto box = boost::dynamic_pointer_cast<physics::BoxShape>(collision->GetShape()))
          box->SetSize(box->Size() * ignition::math::Vector3d(thick, thick, 1));
    }
  }

  void Reset() override
  {
    last_ = 0;
    const auto animations = actor_->SkeletonAnimations();
    if (animations.find("walking") == animations.end())
      throw std::runtime_error("there is no animation 'walking'");
    length_ = animations.at("walking")->GetLength();
    trajectory_.reset(new physics::TrajectoryInfo());
    trajectory_->type = "walking";
    trajectory_->duration = 1;
    actor_->SetCustomTrajectory(trajectory_);
  }

private:
  void OnUpdate(const common::UpdateInfo& info)
  {
    const double dt = (info.simTime - last_).Double(), way = 0.8 * dt;
    last_ = info.simTime;
    auto pose = actor_->WorldPose();
    pose.Pos().X() += way;
    actor_->SetWorldPose(pose, false, false);
    actor_->SetScriptTime(actor_->ScriptTime() + way / 1.36 * length_);  // one round of it is 1.36 m
  }

  physics::ActorPtr actor_;
  physics::TrajectoryInfoPtr trajectory_;
  event::ConnectionPtr update_;
  common::Time last_;
  double length_ = 0;
};

GZ_REGISTER_MODEL_PLUGIN(Walker)

}  // namespace gazebo
