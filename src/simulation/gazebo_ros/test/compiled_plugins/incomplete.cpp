// Lacks a symbol.
#include <gazebo/gazebo.hh>

namespace gazebo
{
void defined_nowhere();

class Incomplete : public ModelPlugin
{
  void Load(physics::ModelPtr, sdf::ElementPtr) override { defined_nowhere(); }
};
GZ_REGISTER_MODEL_PLUGIN(Incomplete)
}  // namespace gazebo
