// libKeysToCmdVelPlugin.so: keys of ~/keyboard/keypress (gazebo.msgs.Any, an int) become velocities on <cmd_vel_topic> (gazebo.msgs.Pose: x
// ahead in m/s, yaw in rad/s, positive to the right as in Gazebo).
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "../core/convert.hpp"

namespace gazebo
{

class KeysToCmdVelPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr, sdf::ElementPtr sdf) override
  {
    const auto number = [&sdf](const char* tag, double otherwise) { return sdf->Get<double>(tag, otherwise).first; };
    topic_ = sdf->Get<std::string>("cmd_vel_topic", "~/cmd_vel").first;
    fastest_ = number("max_linear_vel", 1.0);
    slowest_ = number("min_linear_vel", -fastest_);
    faster_ = number("linear_increment", 0.5);
    turn_ = number("max_angular_vel", 1.0);
    more_ = number("angular_increment", 0.5);
    const sdf::ElementPtr keys = sdf->HasElement("key_controls") ? sdf->GetElement("key_controls") : nullptr;
    if (!keys || !keys->GetFirstElement())
      return;
    for (auto& [name, codes] : keys_)
    {
      codes.clear();
      for (sdf::ElementPtr each = keys->HasElement(name) ? keys->GetElement(name) : nullptr; each;
           each = each->GetNextElement(name))
        codes.push_back(each->Get<int>());
      if (codes.empty())
        physics::refused("<key_controls> names no key for <" + name + ">");
    }
  }
  void Init() override
  {
    node_.reset(new transport::Node);
    node_->Init();
    pressed_ = node_->Subscribe("~/keyboard/keypress", &KeysToCmdVelPlugin::OnKey, this, true);
    told_ = node_->Advertise<msgs::Pose>(topic_);
  }
  void Reset() override { ahead_ = aside_ = 0; }

private:
  // One step further to a velocity; that one itself where it is there already.
  static double towards(double now, double wanted, double step, double least, double most)
  {
    if (std::abs(now - wanted) < 1e-6)
      return wanted;
    return std::clamp(now + (wanted < 0 ? -step : wanted > 0 ? step : 0), std::min(least, most), std::max(least, most));
  }

  void OnKey(ConstAnyPtr& message)
  {
    const auto is = [&](const char* name) {
      const std::vector<int>& codes = keys_.at(name);
      return std::find(codes.begin(), codes.end(), message->int_value()) != codes.end();
    };
    const bool stop = is("stop"), ahead = is("accelerate"), back = is("decelerate"), left = is("left"), right = is("right");
    if (!(stop || ahead || back || left || right))
      return;
    if (stop)
      ahead_ = aside_ = 0;
    else if (ahead || back)
      ahead_ = towards(ahead_, ahead ? fastest_ : slowest_, faster_, slowest_, fastest_);
    if (!stop && (left || right))
      aside_ = towards(aside_, left ? -turn_ : turn_, more_, -turn_, turn_);
    msgs::Pose command;
    msgs::Set(&command, ignition::math::Pose3d(ahead_, 0, 0, 0, 0, aside_));
    told_->Publish(command);
  }

  std::string topic_;
  double fastest_ = 1, slowest_ = -1, faster_ = 0.5, turn_ = 1, more_ = 0.5, ahead_ = 0, aside_ = 0;
  // Codes of a browser, and of Qt.
  std::map<std::string, std::vector<int>> keys_{ { "stop", { 13, 32 } },
                                                 { "accelerate", { 38, 16777235 } },
                                                 { "decelerate", { 40, 16777237 } },
                                                 { "left", { 37, 16777234 } },
                                                 { "right", { 39, 16777236 } } };
  transport::NodePtr node_;
  transport::SubscriberPtr pressed_;
  transport::PublisherPtr told_;
};
GZ_REGISTER_MODEL_PLUGIN(KeysToCmdVelPlugin)

}  // namespace gazebo
