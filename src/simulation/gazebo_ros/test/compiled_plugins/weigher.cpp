// A model plugin that publishes what <joint> bears: JointWrench::body2Force, body2Torque, body1Force, body1Torque.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

namespace gazebo
{

class Weigher : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    joint_ = model->GetJoint(sdf->Get<std::string>("joint"));
    joint_->SetProvideFeedback(true);
    borne_ = ros::NodeHandle().advertise<std_msgs::Float64MultiArray>("borne", 1000);
    update_ = event::Events::ConnectWorldUpdateEnd([this] { OnUpdate(); });
  }

private:
  void OnUpdate()
  {
    const physics::JointWrench wrench = joint_->GetForceTorque(0u);
    std_msgs::Float64MultiArray message;
    for (const auto& v : { wrench.body2Force, wrench.body2Torque, wrench.body1Force, wrench.body1Torque })
      message.data.insert(message.data.end(), { v.X(), v.Y(), v.Z() });
    borne_.publish(message);
  }

  physics::JointPtr joint_;
  ros::Publisher borne_;
  event::ConnectionPtr update_;
};

GZ_REGISTER_MODEL_PLUGIN(Weigher)

}  // namespace gazebo
