// A model plugin that makes joints while the simulation runs: <join> elements, each by one of the ways in which plugins do. The service
// /joiner/order takes "VERB NAME [NUMBER]" for the name of a joint, where the verb is look, drop, attach, remove, force or move, and answers
// whether it holds (success), its position and speed (rate), its greatest speed so far (damping), and what the child bears upwards (N, as
// the message).
#include <map>
#include <sstream>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo_msgs/GetJointProperties.h>
#include <ros/ros.h>

class Joiner : public gazebo::ModelPlugin
{
  using LinkPtr = gazebo::physics::LinkPtr;
  using Vector3d = ignition::math::Vector3d;
  using Pose3d = ignition::math::Pose3d;

public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    model_ = model;
    for (auto each = sdf->GetElement("join"); each; each = each->GetNextElement("join"))
    {
      Made made;
      made.parent = Find(each->Get<std::string>("parent")), made.child = Find(each->Get<std::string>("child"));
      made.joint = Make(*each, each->Get<std::string>("name"), made);
      made_[each->Get<std::string>("name")] = made;
    }
    begin_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo&) { OnBegin(); });
    end_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { OnEnd(); });
    order_ = nh_.advertiseService("/joiner/order", &Joiner::OnOrder, this);
  }

private:
  struct Made
  {
    gazebo::physics::JointPtr joint;
    LinkPtr parent, child;
    double force = 0, fastest = 0;
  };

  LinkPtr Find(const std::string& name) const
  {
    return boost::dynamic_pointer_cast<gazebo::physics::Link>(model_->GetWorld()->EntityByName(name));
  }

  static void Set(gazebo::physics::Joint& joint, sdf::Element& sdf)
  {
    if (joint.DOF() == 0)
      return;
    joint.SetAxis(0, sdf.Get<Vector3d>("axis"));
    if (sdf.HasElement("lower"))
      joint.SetLowerLimit(0, sdf.Get<double>("lower")), joint.SetUpperLimit(0, sdf.Get<double>("upper"));
    joint.SetDamping(0, sdf.Get<double>("damping"));
  }

  gazebo::physics::JointPtr Make(sdf::Element& sdf, const std::string& name, const Made& made) const
  {
    const auto way = sdf.Get<std::string>("way"), type = sdf.Get<std::string>("type");
    const auto pose = sdf.Get<Pose3d>("pose");
    if (way == "sdf")
      return model_->CreateJoint(sdf.GetElement("joint"));
    if (way == "model")
    {
      const auto joint = model_->CreateJoint(name, type, made.parent, made.child);
      joint->SetAnchor(0, (pose + made.child->WorldPose()).Pos());
      Set(*joint, sdf);
      return joint;
    }
    const auto joint = model_->GetWorld()->Physics()->CreateJoint(type, model_);
    joint->SetName(name);
    joint->Attach(made.parent, made.child);
    joint->Load(made.parent, made.child, pose);
    joint->SetModel(model_);
    if (way == "late")
      joint->Init();
    Set(*joint, sdf);
    if (way == "early")
      joint->Init();
    return joint;
  }

  bool OnOrder(gazebo_msgs::GetJointPropertiesRequest& request, gazebo_msgs::GetJointPropertiesResponse& response)
  {
    std::istringstream words(request.joint_name);
    std::string verb, name;
    double number = 0;
    words >> verb >> name >> number;
    Made& made = made_.at(name);
    if (verb == "drop")
      made.joint->Detach();
    else if (verb == "attach")
      made.joint->Attach(made.parent, made.child);
    else if (verb == "move")
      made.joint->SetPosition(0, number);
    else if (verb == "remove")
      model_->RemoveJoint(name);
    else if (verb == "force")
      made.force = number;
    response.success = made.joint->AreConnected(made.parent, made.child);
    response.position = { made.joint->Position(0) };
    response.rate = { made.joint->GetVelocity(0) };
    response.damping = { made.fastest };
    const auto wrench = made.joint->GetForceTorque(0);
    response.status_message = std::to_string(made.child->WorldPose().Rot().RotateVector(wrench.body2Force).Z());
    return true;
  }

  void OnBegin()
  {
    for (auto& [name, made] : made_)
      if (made.force != 0)
        made.joint->SetForce(0, made.force);
  }

  void OnEnd()
  {
    for (auto& [name, made] : made_)
      made.fastest = std::max(made.fastest, std::abs(made.joint->GetVelocity(0)));
  }

  gazebo::physics::ModelPtr model_;
  std::map<std::string, Made> made_;
  ros::NodeHandle nh_;
  ros::ServiceServer order_;
  gazebo::event::ConnectionPtr begin_, end_;
};

GZ_REGISTER_MODEL_PLUGIN(Joiner)
