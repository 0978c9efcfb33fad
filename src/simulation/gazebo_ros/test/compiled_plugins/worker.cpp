// A model plugin as users write them: drives a joint, pushes a link, tells what it sees; ~/go on Gazebo's transport stops it.
#include <functional>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>
#include <geometry_msgs/PointStamped.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Empty.h>

namespace gazebo
{

class Worker : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    if (!ros::isInitialized())
      gzthrow("no node of ROS");
    model_ = model;
    joint_ = model->GetJoint("elbow");
    link_ = model->GetLink("tip");
    effort_ = sdf->Get<double>("effort", 0.0).first;
    effort_ = ros::NodeHandle("~").param("worker_effort", effort_.load());
    force_ = sdf->Get<ignition::math::Vector3d>("force");
    hold_ = sdf->Get<bool>("hold", false).first;
    Control(sdf->Get<double>("position_gain", 0.0).first, sdf->Get<double>("speed_gain", 0.0).first,
            sdf->Get<double>("target", 0.0).first);
    ros::NodeHandle nh(sdf->Get<std::string>("robotNamespace", model->GetName()).first);
    seen_ = nh.advertise<geometry_msgs::PointStamped>("seen", 10);
    command_ = nh.subscribe<std_msgs::Float64>("effort", 1, [this](const std_msgs::Float64ConstPtr& m) { effort_ = m->data; });
    place_ = nh.advertiseService<std_srvs::EmptyRequest, std_srvs::EmptyResponse>("lift", [this](auto&, auto&) {
      model_->SetWorldPose({ 0, 0, 5, 0, 0, 0 });
      return true;
    });
    node_ = transport::NodePtr(new transport::Node);
    node_->Init(model->GetWorld()->Name());
    go_ = node_->Subscribe("~/go", &Worker::OnGo, this);
    update_ = event::Events::ConnectWorldUpdateBegin(std::bind(&Worker::OnUpdate, this, std::placeholders::_1));
  }

private:
  void Control(double position_gain, double speed_gain, double target)
  {
    const physics::JointControllerPtr controller = model_->GetJointController();
    if (position_gain > 0)
    {
      controller->SetPositionPID(joint_->GetScopedName(), common::PID(position_gain, 0, 0));
      controller->SetPositionTarget(joint_->GetScopedName(), target);
    }
    if (speed_gain > 0)
    {
      controller->SetVelocityPID(joint_->GetScopedName(), common::PID(speed_gain, 0, 0));
      controller->SetVelocityTarget(joint_->GetScopedName(), target);
    }
  }

  void OnGo(ConstIntPtr& message) { effort_ = message->data(); }

  void OnUpdate(const common::UpdateInfo& info)
  {
    if (joint_)
      joint_->SetForce(0, effort_);
    if (hold_)
      joint_->SetPosition(0, 0.0, true);
    link_->AddForce(force_);
    geometry_msgs::PointStamped message;
    message.header.stamp = ros::Time(info.simTime.sec, info.simTime.nsec);
    message.header.frame_id = ros::Time::now() == message.header.stamp ? "same" : "other";
    message.point.x = joint_ ? joint_->Position(0) : 0;
    message.point.y = link_->WorldLinearVel().Y();
    message.point.z = link_->WorldPose().Pos().Z();
    seen_.publish(message);
  }

  physics::ModelPtr model_;
  physics::JointPtr joint_;
  physics::LinkPtr link_;
  std::atomic<double> effort_{ 0 };
  ignition::math::Vector3d force_;
  bool hold_ = false;
  ros::Publisher seen_;
  ros::Subscriber command_;
  ros::ServiceServer place_;
  transport::NodePtr node_;
  transport::SubscriberPtr go_;
  event::ConnectionPtr update_;
};

GZ_REGISTER_MODEL_PLUGIN(Worker)

}  // namespace gazebo
