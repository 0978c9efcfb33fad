// A model plugin that rides a tracked vehicle: commands of ROS go on over Gazebo's transport, the tracks' speeds come back.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <ros/ros.h>

namespace gazebo
{

class Rider : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr) override
  {
    node_ = transport::NodePtr(new transport::Node);
    node_->Init(model->GetWorld()->Name());
    drive_ = node_->Advertise<msgs::Twist>("~/" + model->GetName() + "/cmd_vel_twist");
    speeds_ = node_->Subscribe("~/" + model->GetName() + "/tracks_speed", &Rider::OnSpeeds, this);
    ros::NodeHandle nh(model->GetName());
    seen_ = nh.advertise<geometry_msgs::Vector3>("tracks", 10, true);
    command_ = nh.subscribe<geometry_msgs::Twist>("cmd_vel", 1, [this](const geometry_msgs::TwistConstPtr& m) {
      msgs::Twist twist;
      msgs::Set(twist.mutable_linear(), { m->linear.x, 0, 0 });
      msgs::Set(twist.mutable_angular(), { 0, 0, m->angular.z });
      drive_->Publish(twist);
    });
  }

private:
  void OnSpeeds(ConstVector2dPtr& message)
  {
    geometry_msgs::Vector3 out;
    out.x = message->x();
    out.y = message->y();
    seen_.publish(out);
  }

  transport::NodePtr node_;
  transport::PublisherPtr drive_;
  transport::SubscriberPtr speeds_;
  ros::Publisher seen_;
  ros::Subscriber command_;
};

GZ_REGISTER_MODEL_PLUGIN(Rider)

}  // namespace gazebo
