// A world plugin that looks at what its element stands in.
#include <gazebo/gazebo.hh>
#include <ros/ros.h>
#include <std_msgs/String.h>

class Neighbour : public gazebo::WorldPlugin
{
public:
  void Load(gazebo::physics::WorldPtr world, sdf::ElementPtr sdf) override
  {
    told_ = nh_.advertise<std_msgs::String>("neighbour/told", 1, true);
    const sdf::ElementPtr parent = sdf->GetParent();
    const auto name = [](const sdf::ElementPtr& one) {
      return one ? one->GetName() + " " + one->Get<std::string>("name") : "";
    };
    std_msgs::String message;
    message.data = name(parent) + ", " + name(parent->GetElement("plugin")) + ", " + name(world->SDF()) + ", " + name(sdf);
    told_.publish(message);
  }

private:
  ros::NodeHandle nh_;
  ros::Publisher told_;
};
GZ_REGISTER_WORLD_PLUGIN(Neighbour)
