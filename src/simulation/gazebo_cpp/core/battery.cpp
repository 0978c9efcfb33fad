// Batteries: bookkeeping alone, the laws are plugins'.
#include <gazebo/common/Battery.hh>
#include <gazebo/common/Console.hh>

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

bool Battery::SetPowerLoad(uint32_t consumer, double load)
{
  const auto found = loads_.find(consumer);
  if (found == loads_.end())
    gzerr << "battery '" << name_ << "' has no consumer " << consumer << "; AddConsumer() makes one\n";
  else
    found->second = load;
  return found != loads_.end();
}

bool Battery::PowerLoad(uint32_t consumer, double& load) const
{
  const auto found = loads_.find(consumer);
  if (found == loads_.end())
    gzerr << "battery '" << name_ << "' has no consumer " << consumer << "; AddConsumer() makes one\n";
  else
    load = found->second;
  return found != loads_.end();
}

void Battery::Update()
{
  if (law_)
    voltage_ = law_(shared_from_this());
}

}  // namespace common
}  // namespace gazebo
