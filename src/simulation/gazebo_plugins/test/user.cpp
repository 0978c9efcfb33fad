// A model plugin as others write them on gazebo_plugins' headers.
#include <boost/format.hpp>
#include <gazebo/gazebo.hh>
#include <gazebo_plugins/PubQueue.h>
#include <gazebo_plugins/gazebo_ros_utils.h>
#include <std_msgs/String.h>

namespace gazebo
{

class User : public ModelPlugin
{
public:
  void Load(physics::ModelPtr parent, sdf::ElementPtr sdf) override
  {
    gazebo_ros_ = GazeboRosPtr(new GazeboRos(parent, sdf, "User"));
    gazebo_ros_->isInitialized();
    double rate = 0;
    bool odom = true, turned = false;
    int side = 0;
    std::string frame;
    gazebo_ros_->getParameter<double>(rate, "updateRate", 25.0);
    gazebo_ros_->getParameter<std::string>(frame, "robotBaseFrame", "base_footprint");
    gazebo_ros_->getParameterBoolean(odom, "publishOdom", true);
    gazebo_ros_->getParameterBoolean(turned, "turned", false);
    gazebo_ros_->getParameter<int>(side, "side", { { "left", 1 }, { "right", 2 } }, 1);
    const physics::JointPtr joint = gazebo_ros_->getJoint(parent, "wheelJoint", "none");
    publisher_ = gazebo_ros_->node()->advertise<std_msgs::String>("user", 10, true);
    queue_ = queues_.addPub<std_msgs::String>();
    queues_.startServiceThread();
    std_msgs::String message;
    message.data = (boost::format("%1% %2% %3% %4% %5% %6% %7%") % gazebo_ros_->info() % rate % gazebo_ros_->resolveTF(frame) %
                    odom % turned % side % joint->GetName())
                       .str();
    queue_->push(message, publisher_);
  }

private:
  GazeboRosPtr gazebo_ros_;
  ros::Publisher publisher_;
  PubMultiQueue queues_;
  PubQueue<std_msgs::String>::Ptr queue_;
};

GZ_REGISTER_MODEL_PLUGIN(User)

}  // namespace gazebo
