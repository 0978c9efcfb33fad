// libLinearBatteryPlugin.so: the voltage of a link's battery by its charge and by the current that its consumers take.
//   u = e0 + e1 (1 - q / capacity) - r i;  tau di/dt = P / u - i;  dq/dt = -i, with q in A h
#include <cmath>
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

class LinearBatteryPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    const auto text = [&sdf](const char* tag) { return sdf->HasElement(tag) ? sdf->Get<std::string>(tag) : ""; };
    const auto number = [&sdf](const char* tag) { return sdf->HasElement(tag) ? sdf->Get<double>(tag) : 0.0; };
    const physics::LinkPtr link = model->GetLink(text("link_name"));
    if (!link)
      throw std::runtime_error("<link_name>: the model has no link '" + text("link_name") + "'");
    battery_ = link->Battery(text("battery_name"));
    if (!battery_)
      throw std::runtime_error("<battery_name>: link '" + link->GetName() + "' has no <battery> '" + text("battery_name") +
                               "'");
    e0_ = number("open_circuit_voltage_constant_coef");
    e1_ = number("open_circuit_voltage_linear_coef");
    first_charge_ = number("initial_charge");
    capacity_ = number("capacity");
    resistance_ = number("resistance");
    tau_ = number("smooth_current_tau");
    engine_ = model->GetWorld()->Physics();
    Reset();
    battery_->SetUpdateFunc([this](const common::BatteryPtr& battery) { return voltage(*battery); });
  }
  ~LinearBatteryPlugin() override
  {
    if (battery_)
      battery_->SetUpdateFunc(nullptr);
  }
  void Reset() override { current_ = 0, charge_ = first_charge_; }

private:
  double voltage(const common::Battery& battery)
  {
    if (std::abs(battery.Voltage()) < 1e-3)
      return 0;
    double power = 0;
    for (const auto& [consumer, load] : battery.PowerLoads())
      power += load;
    const double dt = engine_->GetMaxStepSize();
    current_ += dt / tau_ * (power / battery.Voltage() - current_);
    charge_ -= dt * current_ / 3600;
    return e0_ + e1_ * (1 - charge_ / capacity_) - resistance_ * current_;
  }

  physics::PhysicsEnginePtr engine_;
  common::BatteryPtr battery_;
  double e0_ = 0, e1_ = 0;                  // V
  double first_charge_ = 0, capacity_ = 0;  // A h
  double resistance_ = 0, tau_ = 0;         // ohm, s
  double current_ = 0, charge_ = 0;         // A, A h
};
GZ_REGISTER_MODEL_PLUGIN(LinearBatteryPlugin)

}  // namespace gazebo
