// A world plugin: inserts and removes models, hears contacts and poses of Gazebo's transport, fails where it is told to.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <ros/ros.h>
#include <std_msgs/String.h>

class Keeper : public gazebo::WorldPlugin
{
public:
  void Load(gazebo::physics::WorldPtr world, sdf::ElementPtr sdf) override
  {
    world_ = world;
    told_ = nh_.advertise<std_msgs::String>("keeper/told", 100, true);
    orders_ = nh_.subscribe("keeper/orders", 10, &Keeper::OnOrder, this);
    node_.reset(new gazebo::transport::Node);
    node_->Init();
    go_ = node_->Advertise<gazebo::msgs::Int>("~/go");
    factory_ = node_->Advertise<gazebo::msgs::Factory>("~/factory");
    contacts_ = node_->Subscribe("~/physics/contacts", &Keeper::OnContacts, this);
    end_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { OnEnd(); });
    reset_ = gazebo::event::Events::ConnectWorldReset([this] { Tell("reset"); });
    Tell("loaded " + sdf->Get<std::string>("word") + " in " + gazebo::physics::get_world()->Name());
  }

private:
  void Tell(const std::string& text)
  {
    std_msgs::String message;
    message.data = text;
    told_.publish(message);
  }

  void OnOrder(const std_msgs::StringConstPtr& order)
  {
    if (order->data == "fail")
      fail_ = true;
    else if (order->data == "insert")
      world_->InsertModelString(
          "<sdf version='1.6'><model name='inserted'><pose>9 0 0.5 0 0 0</pose><link name='l'>"
          "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link></model></sdf>");
    else if (order->data.substr(0, 6) == "place ")
    {
      gazebo::msgs::Factory message;
      message.set_sdf_filename(order->data.substr(6));
      gazebo::msgs::Set(message.mutable_pose(), ignition::math::Pose3d(3, -2, 0, 0, 0, 1.5));
      factory_->Publish(message);
    }
    else if (order->data == "remove")
      world_->RemoveModel("inserted");
    else if (order->data.substr(0, 3) == "go ")
    {
      gazebo::msgs::Int message;
      message.set_data(std::stoi(order->data.substr(3)));
      go_->Publish(message);
    }
    else if (order->data == "hold")
    {
      joint_ = world_->Physics()->CreateJoint("revolute");
      joint_->Load(gazebo::physics::LinkPtr(), world_->ModelByName("inserted")->GetLink("l"), {});
      joint_->Init();
      joint_->SetUpperLimit(0, 0);  // as plugins do that fix what a gripper holds
      joint_->SetLowerLimit(0, 0);
      Tell("held");
    }
    else if (order->data == "free")
    {
      joint_->Detach();
      Tell("freed");
    }
    else if (order->data == "below")
    {
      const auto model = world_->ModelBelowPoint({ 9, 0, 5 });
      Tell(model ? model->GetName() : "nothing");
    }
  }

  void OnContacts(ConstContactsPtr& message)
  {
    for (const auto& contact : message->contact())
    {
      const bool first = contact.collision1().find("inserted::") == 0;
      if (!first && contact.collision2().find("inserted::") != 0)
        continue;
      double force = 0;
      for (const auto& wrench : contact.wrench())
        force += (first ? wrench.body_1_wrench() : wrench.body_2_wrench()).force().z();
      Tell("weight " + std::to_string(std::lround(force)));
    }
  }

  void OnEnd()
  {
    if (fail_)
      throw std::runtime_error("told to fail");
  }

  gazebo::physics::WorldPtr world_;
  gazebo::physics::JointPtr joint_;
  ros::NodeHandle nh_;
  ros::Publisher told_;
  ros::Subscriber orders_;
  gazebo::transport::NodePtr node_;
  gazebo::transport::PublisherPtr go_, factory_;
  gazebo::transport::SubscriberPtr contacts_;
  gazebo::event::ConnectionPtr end_, reset_;
  bool fail_ = false;
};

GZ_REGISTER_WORLD_PLUGIN(Keeper)
