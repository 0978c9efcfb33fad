// What is done in a scene: the <do> elements of the recorder.
#pragma once

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

struct Deed
{
  std::string kind, on;
  double from = 0, until = 1e9;
  std::vector<double> values;
  bool done = false;
};

std::string Attribute(sdf::ElementPtr element, const std::string& name, const std::string& otherwise)
{
  return element->HasAttribute(name) ? element->Get<std::string>(name) : otherwise;
}

std::vector<double> Numbers(const std::string& text)
{
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number; words >> number;)
    numbers.push_back(number);
  return numbers;
}

// The server makes and deletes models between two steps, in its own thread.
template <class Condition>
void WaitFor(Condition met)
{
  for (int i = 0; i < 3000 && !met(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

class Deeds
{
public:
  void Read(gazebo::physics::WorldPtr world, sdf::ElementPtr sdf)
  {
    world_ = world;
    if (!sdf->HasElement("do"))
      return;
    for (auto e = sdf->GetElement("do"); e; e = e->GetNextElement("do"))
    {
      Deed deed;
      deed.kind = Attribute(e, "kind", "");
      deed.on = Attribute(e, "on", "");
      deed.from = std::atof(Attribute(e, "from", "0").c_str());
      deed.until = std::atof(Attribute(e, "until", "1e9").c_str());
      deed.values = Numbers(Attribute(e, "value", ""));
      deeds_.push_back(deed);
    }
  }

  // The first step at which something is done once, after k steps and before `next`.
  long Next(long k, long next, double dt) const
  {
    for (const auto& deed : deeds_)
      if (const long at = std::lround(deed.from / dt); !deed.done && at > k)
        next = std::min(next, at);
    return next;
  }

  // What lasts: forces that are given anew in each step.
  void Apply()
  {
    const double t = steps_++ * world_->Physics()->GetMaxStepSize();
    for (const auto& deed : deeds_)
    {
      if (t < deed.from - 1e-9 || t >= deed.until - 1e-9)
        continue;
      if (deed.kind == "effort")
      {
        if (auto joint = Joint(deed.on))
          joint->SetForce(deed.values.size() > 1 ? static_cast<unsigned>(deed.values[1]) : 0, deed.values[0]);
      }
      else if (deed.kind == "push")
      {
        if (auto link = Link(deed.on))
          link->AddForce(ignition::math::Vector3d(deed.values[0], deed.values[1], deed.values[2]));
      }
      else if (deed.kind == "torque")
      {
        if (auto link = Link(deed.on))
          link->AddTorque(ignition::math::Vector3d(deed.values[0], deed.values[1], deed.values[2]));
      }
      else if (deed.kind == "pd")
      {  // target, P, D: what a controller by effort does
        if (auto joint = Joint(deed.on))
          joint->SetForce(0, deed.values[1] * (deed.values[0] - joint->Position(0)) - deed.values[2] * joint->GetVelocity(0));
      }
      else if (deed.kind == "velocity")
      {
        if (auto joint = Joint(deed.on))
          joint->SetVelocity(0, deed.values[0]);
      }
    }
  }

  // What is done once, between two steps.
  void Once(double t)
  {
    for (auto& deed : deeds_)
    {
      if (deed.done || deed.from > t + 1e-9)
        continue;
      deed.done = true;
      const auto& v = deed.values;
      if (deed.kind == "motor")
      {  // speed, greatest effort
        if (auto joint = Joint(deed.on))
        {
          joint->SetParam("fmax", 0, v[1]);
          joint->SetParam("vel", 0, v[0]);
        }
      }
      else if (deed.kind == "pose")
      {
        if (auto model = world_->ModelByName(deed.on))
          model->SetWorldPose(ignition::math::Pose3d(v[0], v[1], v[2], v[3], v[4], v[5]));
      }
      else if (deed.kind == "twist")
      {
        if (auto model = world_->ModelByName(deed.on))
        {
          model->SetLinearVel(ignition::math::Vector3d(v[0], v[1], v[2]));
          model->SetAngularVel(ignition::math::Vector3d(v[3], v[4], v[5]));
        }
      }
      else if (deed.kind == "position")
      {
        if (auto joint = Joint(deed.on))
          joint->SetPosition(0, v[0]);
      }
      else if (deed.kind == "reset")
      {
        world_->Reset();
      }
      else if (deed.kind == "reset_poses")
      {
        world_->ResetEntities(gazebo::physics::Base::MODEL);
      }
      else if (deed.kind == "remove")
      {
        world_->RemoveModel(deed.on);
        WaitFor([&] { return !world_->ModelByName(deed.on); });
      }
      else if (deed.kind == "gravity")
      {
        if (auto link = Link(deed.on))
          link->SetGravityMode(v[0] > 0);
      }
      else if (deed.kind == "world_gravity")
      {
        world_->SetGravity(ignition::math::Vector3d(v[0], v[1], v[2]));
      }
      else if (deed.kind == "kinematic")
      {
        if (auto link = Link(deed.on))
          link->SetKinematic(v[0] > 0);
      }
      else if (deed.kind == "vel_cmd")
      {  // x, yaw, as the drives of Gazebo itself are told
        if (!node_)
        {
          node_.reset(new gazebo::transport::Node);
          node_->Init(world_->Name());
        }
        gazebo::msgs::Pose command;
        gazebo::msgs::Set(&command, ignition::math::Pose3d(v[0], 0, 0, 0, 0, v[1]));
        commands_ = node_->Advertise<gazebo::msgs::Pose>("~/" + deed.on + "/vel_cmd");
        WaitFor([&] { return commands_->HasConnections(); });
        commands_->Publish(command, true);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
      }
      else if (deed.kind == "spawn")
      {
        std::ifstream file(deed.on);
        std::stringstream text;
        text << file.rdbuf();
        const auto before = world_->ModelCount();
        world_->InsertModelString(text.str());
        WaitFor([&] { return world_->ModelCount() > before; });
      }
    }
  }

private:
  gazebo::physics::JointPtr Joint(const std::string& scoped)
  {
    const auto cut = scoped.rfind("::");
    auto model = world_->ModelByName(scoped.substr(0, cut));
    return model ? model->GetJoint(scoped.substr(cut + 2)) : nullptr;
  }

  gazebo::physics::LinkPtr Link(const std::string& scoped)
  {
    return boost::dynamic_pointer_cast<gazebo::physics::Link>(world_->EntityByName(scoped));
  }

  gazebo::physics::WorldPtr world_;
  gazebo::transport::NodePtr node_;
  gazebo::transport::PublisherPtr commands_;
  std::vector<Deed> deeds_;
  long steps_ = 0;
};
