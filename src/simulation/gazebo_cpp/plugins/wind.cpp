// libWindPlugin.so: the wind of a world as a force, mass times the wind past it, on the links that it counts for. Magnitude and direction
// rise to those of <wind>, swing and waver. As in Gazebo 11.1 they rise with each link's question, and there is no force without a
// <force_approximation_scaling_factor>; the wind is there to be asked for.
#include <cmath>
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

namespace gazebo
{

using ignition::math::Vector3d;

class WindPlugin : public WorldPlugin
{
public:
  void Load(physics::WorldPtr world, sdf::ElementPtr sdf) override
  {
    world_ = world;
    const sdf::ElementPtr across = inside(sdf, "horizontal");
    magnitude_ = swing(inside(across, "magnitude"), "amplitude_percent");
    direction_ = swing(inside(across, "direction"), "amplitude");
    upward_ = noise(inside(sdf, "vertical"));
    if (sdf->HasElement("force_approximation_scaling_factor"))
      factor_ = sdf->Get<double>("force_approximation_scaling_factor");
    if (!(factor_ >= 0) || !std::isfinite(factor_))
      throw std::runtime_error("<force_approximation_scaling_factor> has to be 0 or more");
    world->Wind().SetLinearVelFunc([this](const physics::Wind* wind, const physics::Entity*) { return At(*wind); });
    if (factor_ > 0)
      update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnUpdate(); });
  }

private:
  // A quantity that follows a wanted one by a first order, and what is added to it.
  struct Swing
  {
    double rise = 1, amplitude = 0, period = 1;  // s, of the mean or deg, s
    sensors::NoisePtr noise;
    double mean = 0;

    double follow(double wanted, double step)
    {
      const double k = step / rise;
      return mean = (1 - k) * mean + k * wanted;
    }
    double wave(double now) const { return amplitude * std::sin(2 * M_PI * now / period); }
    double wavering(double value) const { return noise ? noise->Apply(value) : value; }
  };

  static sdf::ElementPtr inside(const sdf::ElementPtr& sdf, const char* tag)
  {
    return sdf && sdf->HasElement(tag) ? sdf->GetElement(tag) : sdf::ElementPtr();
  }

  static sensors::NoisePtr noise(const sdf::ElementPtr& sdf)
  {
    const sdf::ElementPtr found = inside(sdf, "noise");
    return found ? sensors::NoiseFactory::NewNoiseModel(found) : sensors::NoisePtr();
  }

  static double positive(const sdf::ElementPtr& sdf, const char* tag)
  {
    if (!sdf || !sdf->HasElement(tag))
      return 1;
    const double value = sdf->Get<double>(tag);
    if (!(value > 0) || !std::isfinite(value))
      throw std::runtime_error(std::string("<") + tag + "> has to be above 0 s");
    return value;
  }

  static Swing swing(const sdf::ElementPtr& sdf, const char* amplitude)
  {
    Swing made;
    made.rise = positive(sdf, "time_for_rise");
    const sdf::ElementPtr sine = inside(sdf, "sin");
    if (sine && sine->HasElement(amplitude))
      made.amplitude = sine->Get<double>(amplitude);
    made.period = positive(sine, "period");
    made.noise = noise(sdf);
    return made;
  }

  Vector3d At(const physics::Wind& wind)
  {
    const double step = world_->Physics()->GetMaxStepSize(), now = world_->SimTime().Double();
    const Vector3d& told = wind.LinearVel();
    const double mean = magnitude_.follow(told.Length(), step);
    const double magnitude = magnitude_.wavering(mean + mean * magnitude_.wave(now));
    const double bearing = direction_.follow(std::atan2(told.Y(), told.X()) * 180 / M_PI, step);  // deg
    const double direction = direction_.wavering(bearing + direction_.wave(now)) * M_PI / 180;
    return { magnitude * std::cos(direction), magnitude * std::sin(direction), upward_ ? upward_->Apply(mean) : 0 };
  }

  void OnUpdate()
  {
    for (const physics::ModelPtr& model : world_->Models())
      for (const physics::LinkPtr& link : model->GetLinks())
        if (link->WindMode())
          link->AddRelativeForce(factor_ * link->GetInertial()->Mass() *
                                 (link->RelativeWindLinearVel() - link->RelativeLinearVel()));
  }

  physics::WorldPtr world_;
  Swing magnitude_, direction_;
  sensors::NoisePtr upward_;
  double factor_ = 0;
  event::ConnectionPtr update_;
};
GZ_REGISTER_WORLD_PLUGIN(WindPlugin)

}  // namespace gazebo
