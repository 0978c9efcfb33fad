// libRandomVelocityPlugin.so: a link that goes another way each period, the same ways in every run. m/s, world axes.
#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include "named.hpp"

namespace gazebo
{

using ignition::math::Vector3d;

class RandomVelocityPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    link_ = named_link(*model, sdf, "link");
    const auto number = [&sdf](const std::string& tag, double otherwise) {
      return sdf->HasElement(tag) ? sdf->Get<double>(tag) : otherwise;
    };
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::string axis(1, "xyz"[i]);
      const double one = number("min_" + axis, -MOST), other = number("max_" + axis, MOST);
      limits_[i] = { std::min(one, other), std::max(one, other) };
    }
    if (sdf->HasElement("initial_velocity"))
      velocity_ = sdf->Get<Vector3d>("initial_velocity");
    factor_ = number("velocity_factor", 1);
    period_ = number("update_period", 10);
    update_ =
        event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { OnUpdate(info.simTime.Double()); });
  }
  void Reset() override { changed_ = 0; }

private:
  static constexpr double MOST = std::numeric_limits<double>::max();

  void OnUpdate(double now)
  {
    if (now - changed_ > period_)
    {
      changed_ = now;
      std::uniform_real_distribution<double> any(-1, 1);
      const double x = any(random_), y = any(random_), z = any(random_);
      const Vector3d way = Vector3d(x, y, z).Normalize() * factor_;
      for (std::size_t i = 0; i < 3; ++i)
        velocity_[i] = std::clamp(way[i], limits_[i].first, limits_[i].second);
    }
    link_->SetLinearVel(velocity_);
  }

  physics::LinkPtr link_;
  std::array<std::pair<double, double>, 3> limits_;
  Vector3d velocity_;
  double factor_ = 1, period_ = 10, changed_ = 0;
  std::mt19937 random_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(RandomVelocityPlugin)

}  // namespace gazebo
