// Lacks a symbol. Like many, it includes nothing for boost::bind and _1, which Gazebo's headers bring.
#include <gazebo/gazebo.hh>

namespace gazebo
{
void defined_nowhere();

class Incomplete : public ModelPlugin
{
  void Load(physics::ModelPtr, sdf::ElementPtr) override
  {
    update_ = event::Events::ConnectWorldUpdateBegin(boost::bind(&Incomplete::OnUpdate, this, _1));
  }

  void OnUpdate(const common::UpdateInfo&) { defined_nowhere(); }

  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(Incomplete)
}  // namespace gazebo
