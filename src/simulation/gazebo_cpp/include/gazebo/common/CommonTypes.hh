#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>

#include <gazebo/util/system.hh>

namespace gazebo
{
class WorldPlugin;
class ModelPlugin;
class SensorPlugin;
class SystemPlugin;
class VisualPlugin;
class GUIPlugin;
typedef boost::shared_ptr<WorldPlugin> WorldPluginPtr;
typedef boost::shared_ptr<ModelPlugin> ModelPluginPtr;
typedef boost::shared_ptr<SensorPlugin> SensorPluginPtr;
typedef boost::shared_ptr<GUIPlugin> GUIPluginPtr;
typedef boost::shared_ptr<SystemPlugin> SystemPluginPtr;
typedef boost::shared_ptr<VisualPlugin> VisualPluginPtr;

namespace common
{
class SphericalCoordinates;
class UpdateInfo;
class Time;
class PID;
class Animation;
class Battery;
class PoseAnimation;
class NumericAnimation;
typedef boost::shared_ptr<Animation> AnimationPtr;
typedef boost::shared_ptr<PoseAnimation> PoseAnimationPtr;
typedef boost::shared_ptr<NumericAnimation> NumericAnimationPtr;
typedef std::shared_ptr<Battery> BatteryPtr;
typedef std::map<std::string, std::string> StrStr_M;
typedef boost::shared_ptr<SphericalCoordinates> SphericalCoordinatesPtr;
}  // namespace common

namespace event
{
class Connection;
typedef boost::shared_ptr<Connection> ConnectionPtr;
typedef std::vector<ConnectionPtr> Connection_V;
}  // namespace event
}  // namespace gazebo
