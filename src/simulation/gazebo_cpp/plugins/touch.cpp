// libTouchPlugin.so: once a model has touched what is named <target>, and nothing else, for <time> s, /NAMESPACE/touched says 1.
// A 1 on /NAMESPACE/enable starts it, a 0 stops it.
#include <mutex>
#include <stdexcept>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo
{

class TouchPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    for (const char* tag : { "sensor", "target", "namespace", "time" })
      if (!sdf->HasElement(tag))
        throw std::runtime_error("<" + std::string(tag) + "> is missing");
    for (sdf::ElementPtr each = sdf->GetElement("sensor"); each; each = each->GetNextElement("sensor"))
    {
      const auto name = each->Get<std::string>();
      const auto sensor =
          std::dynamic_pointer_cast<sensors::ContactSensor>(sensors::SensorManager::Instance()->GetSensor(name));
      if (!sensor)
        throw std::runtime_error("<sensor>: there is no contact sensor '" + name + "'");
      sensors_.push_back(sensor);
    }
    target_ = sdf->Get<std::string>("target");
    own_ = model->GetName();
    space_ = "/" + sdf->Get<std::string>("namespace");
    time_ = common::Time(sdf->Get<double>("time"));
    node_.reset(new transport::Node);
    node_->Init();
    enabled_ = node_->Subscribe(space_ + "/enable", &TouchPlugin::OnEnable, this);
    if (sdf->HasElement("enabled") && sdf->Get<bool>("enabled"))
      enable(true);
  }

private:
  void OnEnable(ConstIntPtr& message)
  {
    if (message->data() == 0 || message->data() == 1)
      enable(message->data() == 1);
  }
  void enable(bool on)
  {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (on == static_cast<bool>(touched_))
      return;
    for (const auto& sensor : sensors_)
      sensor->SetActive(on);
    since_ = common::Time::Zero;
    if (on)
    {
      touched_ = node_->Advertise<msgs::Int>(space_ + "/touched");
      update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { OnUpdate(info); });
    }
    else
      touched_->Fini(), touched_.reset(), update_.reset();
  }

  // Whether each contact there is is one of this model with the target.
  bool touches() const
  {
    bool any = false;
    for (const auto& sensor : sensors_)
    {
      const msgs::Contacts contacts = sensor->Contacts();
      for (const msgs::Contact& contact : contacts.contact())
      {
        const auto pair = [&contact](const std::string& one, const std::string& two) {
          return contact.collision1().find(one) != std::string::npos && contact.collision2().find(two) != std::string::npos;
        };
        if (!pair(target_, own_) && !pair(own_, target_))
          return false;
        any = true;
      }
    }
    return any;
  }
  void OnUpdate(const common::UpdateInfo& info)
  {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (!touched_)
      return;
    if (!touches())
      since_ = common::Time::Zero;
    else if (since_ == common::Time::Zero)
      since_ = info.simTime;
    else if (info.simTime - since_ > time_)
    {
      msgs::Int message;
      message.set_data(1);
      touched_->Publish(message);
      enable(false);
    }
  }

  std::vector<sensors::ContactSensorPtr> sensors_;
  std::string target_, own_, space_;
  common::Time time_, since_;  // since: zero while it does not touch
  std::recursive_mutex mutex_;
  transport::NodePtr node_;
  transport::SubscriberPtr enabled_;
  transport::PublisherPtr touched_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(TouchPlugin)

}  // namespace gazebo
