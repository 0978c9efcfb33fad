// libLinearBatteryConsumerPlugin.so: a consumer of a link's battery that takes the same power (W) all the time.
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

class LinearBatteryConsumerPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    const auto text = [&sdf](const char* tag) { return sdf->HasElement(tag) ? sdf->Get<std::string>(tag) : ""; };
    const physics::LinkPtr link = model->GetLink(text("link_name"));
    if (!link)
      throw std::runtime_error("<link_name>: the model has no link '" + text("link_name") + "'");
    battery_ = link->Battery(text("battery_name"));
    if (!battery_)
      throw std::runtime_error("<battery_name>: link '" + link->GetName() + "' has no <battery> '" + text("battery_name") +
                               "'");
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
