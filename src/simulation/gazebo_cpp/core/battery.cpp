// Batteries: bookkeeping alone, the laws are plugins'.
#include <gazebo/common/Battery.hh>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Event.hh>

namespace gazebo
{
namespace common
{

void Battery::Load(sdf::ElementPtr sdf)
{
  if (!sdf)
    return;
  name_ = sdf->Get<std::string>("name");
  if (sdf->HasElement("voltage"))
    first_ = sdf->Get<double>("voltage");
  Init();
}

uint32_t Battery::AddConsumer()
{
  loads_[next_] = 0;
  return next_++;
}

bool Battery::known(uint32_t consumer) const
{
  if (loads_.count(consumer))
    return true;
  gzerr << "battery '" << name_ << "' has no consumer " << consumer << "; AddConsumer() makes one\n";
  return false;
}

bool Battery::SetPowerLoad(uint32_t consumer, double load)
{
  if (!known(consumer))
    return false;
  loads_[consumer] = load;
  return true;
}

bool Battery::PowerLoad(uint32_t consumer, double& load) const
{
  if (!known(consumer))
    return false;
  load = loads_.at(consumer);
  return true;
}

void Battery::SetUpdateFunc(Law law) { law_ = std::move(law), owner_ = internal::CurrentPlugin(); }

void Battery::Update()
{
  if (!law_)
    return;
  const internal::Running running(owner_, "law of a battery");
  try
  {
    voltage_ = law_(shared_from_this());
  }
  catch (const std::exception& error)
  {
    law_ = nullptr;
    internal::Failed(owner_, "law of a battery", error.what());
  }
  catch (...)
  {
    law_ = nullptr;
    internal::Failed(owner_, "law of a battery", nullptr);
  }
}

}  // namespace common
}  // namespace gazebo
