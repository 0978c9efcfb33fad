// Between ode_sim's numbers and those of ignition::math, and what all of physics shares.
#pragma once
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include <boost/thread/recursive_mutex.hpp>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>

#include "world.hpp"

namespace gazebo
{
namespace physics
{

inline ignition::math::Vector3d ign(const ode_sim::Vec3& v) { return { v.x, v.y, v.z }; }
inline ignition::math::Pose3d ign(const ode_sim::Pose& X) { return { X.p.x, X.p.y, X.p.z, X.q.w, X.q.x, X.q.y, X.q.z }; }
inline ode_sim::Vec3 ode(const ignition::math::Vector3d& v) { return { v.X(), v.Y(), v.Z() }; }
inline ode_sim::Pose ode(const ignition::math::Pose3d& X)
{
  return { ode(X.Pos()), { X.Rot().X(), X.Rot().Y(), X.Rot().Z(), X.Rot().W() } };
}

/// Held during a step, and while something other than numbers is changed.
boost::recursive_mutex& step_mutex();

/// One line, once for each text: what a plugin asked for and did not get.
void refused(const std::string& text);

/// Changes the world between steps. What the core refuses (a number that is none) becomes one line.
void change(const std::string& who, const std::function<void()>& f);

/// The world of a model of the core; null when it has been removed.
inline ode_sim::World* world_of(const ode_sim::Model* model) { return model ? model->world : nullptr; }

/// An axis of a joint; null where it has none of that number, or a plugin has made it.
inline ode_sim::Axis* axis_of(const std::shared_ptr<ode_sim::Joint>& core, unsigned int index)
{
  return core && index < static_cast<unsigned int>(core->axis_count) ? &core->axes[index] : nullptr;
}

}  // namespace physics
}  // namespace gazebo
