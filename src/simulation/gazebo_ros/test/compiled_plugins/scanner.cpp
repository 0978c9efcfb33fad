// A plugin of a laser, derived from Gazebo's own: publishes what the sensor's fan of rays and its topic tell.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/plugins/RayPlugin.hh>
#include <gazebo/transport/transport.hh>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

namespace gazebo
{

class Scanner : public RayPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override
  {
    RayPlugin::Load(sensor, sdf);
    sensor_ = std::dynamic_pointer_cast<sensors::RaySensor>(sensor);
    values_ = nh_.advertise<std_msgs::Float64MultiArray>("scan/values", 1000, true);
    fan_ = nh_.advertise<std_msgs::Float64MultiArray>("scan/fan", 1000, true);
    node_ = transport::NodePtr(new transport::Node());
    node_->Init(sensor_->WorldName());
    scans_ = node_->Subscribe(sensor_->Topic(), &Scanner::OnScan, this);
  }

  void OnNewLaserScans() override
  {
    std_msgs::Float64MultiArray fan;
    for (unsigned int i = 0; i < sensor_->LaserShape()->RayCount(); ++i)
      fan.data.push_back(sensor_->LaserShape()->GetRange(i));
    fan_.publish(fan);
  }

private:
  void OnScan(ConstLaserScanStampedPtr& message)
  {
    std_msgs::Float64MultiArray values;
    values.data = { msgs::Convert(message->time()).Double(),
                    sensor_->AngleMin().Radian(),
                    sensor_->AngleMax().Radian(),
                    1.0 * sensor_->RangeCount(),
                    1.0 * sensor_->VerticalRangeCount(),
                    sensor_->RangeMax() };
    values.data.insert(values.data.end(), message->scan().ranges().begin(), message->scan().ranges().end());
    values.data.insert(values.data.end(), message->scan().intensities().begin(), message->scan().intensities().end());
    values_.publish(values);
  }

  ros::NodeHandle nh_;
  ros::Publisher values_, fan_;
  sensors::RaySensorPtr sensor_;
  transport::NodePtr node_;
  transport::SubscriberPtr scans_;
};

GZ_REGISTER_SENSOR_PLUGIN(Scanner)

}  // namespace gazebo
