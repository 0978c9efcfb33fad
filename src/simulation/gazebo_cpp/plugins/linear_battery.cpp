// libLinearBatteryPlugin.so.
#include <gazebo/plugins/LinearBatteryPlugin.hh>

#include <cmath>

#include <gazebo/gazebo.hh>

#include "named.hpp"

namespace gazebo
{

LinearBatteryPlugin::~LinearBatteryPlugin()
{
  if (battery)
    battery->SetUpdateFunc(nullptr);
}

void LinearBatteryPlugin::Load(physics::ModelPtr owner, sdf::ElementPtr element)
{
  model = owner, sdf = element;
  world = model->GetWorld(), physics = world->Physics();
  const auto number = [this](const char* tag) { return sdf->HasElement(tag) ? sdf->Get<double>(tag) : 0.0; };
  link = named_link(*model, sdf, "link_name");
  e0 = number("open_circuit_voltage_constant_coef");
  e1 = number("open_circuit_voltage_linear_coef");
  q0 = number("initial_charge");
  c = number("capacity");
  r = number("resistance");
  tau = number("smooth_current_tau");
  battery = named_battery(*link, sdf);
  q = q0;
  battery->SetUpdateFunc([this](const common::BatteryPtr&) { return voltage(); });
}

void LinearBatteryPlugin::Init() { q = q0; }
void LinearBatteryPlugin::Reset() { iraw = 0, ismooth = 0, q = q0; }

double LinearBatteryPlugin::voltage()
{
  if (std::abs(battery->Voltage()) < 1e-3)
    return 0;
  double power = 0;
  for (const auto& [consumer, load] : battery->PowerLoads())
    power += load;
  const double dt = physics->GetMaxStepSize();
  iraw = power / battery->Voltage();
  ismooth += dt / tau * (iraw - ismooth);
  q -= dt * ismooth / 3600;
  return e0 + e1 * (1 - q / c) - r * ismooth;
}

GZ_REGISTER_MODEL_PLUGIN(LinearBatteryPlugin)

}  // namespace gazebo
