// The functions of gazebo_ros_utils.h are inline; packages name this library where they link, so it has them as well.
#include <gazebo_plugins/gazebo_ros_utils.h>

namespace gazebo
{

namespace
{

template <class Parent>
GazeboRosPtr made(Parent& parent, const sdf::ElementPtr& sdf, const std::string& plugin)
{
  return GazeboRosPtr(new GazeboRos(parent, sdf, plugin));
}

}  // namespace

extern const void* const gazebo_ros_utils[];
const void* const gazebo_ros_utils[] = { reinterpret_cast<const void*>(&made<physics::ModelPtr>),
                                         reinterpret_cast<const void*>(&made<sensors::SensorPtr>) };

}  // namespace gazebo
