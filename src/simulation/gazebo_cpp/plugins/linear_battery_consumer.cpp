// libLinearBatteryConsumerPlugin.so: a consumer of a link's battery that takes the same power (W) all the time.
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include "named.hpp"

namespace gazebo
{

class LinearBatteryConsumerPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    battery_ = named_battery(*named_link(*model, sdf, "link_name"), sdf);
    if (!sdf->HasElement("power_load"))
      throw std::runtime_error("<power_load>, in W, is missing");
    consumer_ = battery_->AddConsumer();
    battery_->SetPowerLoad(consumer_, sdf->Get<double>("power_load"));
  }
  ~LinearBatteryConsumerPlugin() override
  {
    if (battery_)
      battery_->RemoveConsumer(consumer_);
  }

private:
  common::BatteryPtr battery_;
  uint32_t consumer_ = 0;
};
GZ_REGISTER_MODEL_PLUGIN(LinearBatteryConsumerPlugin)

}  // namespace gazebo
