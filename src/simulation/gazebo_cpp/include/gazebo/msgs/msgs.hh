// Messages, and what turns them into other things and back.
#pragma once
#include <string>

#include <gazebo/common/SphericalCoordinates.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/msgs/MessageTypes.hh>
#include <ignition/math/Color.hh>
#include <ignition/math/Inertial.hh>
#include <ignition/math/Plane.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>

namespace gazebo
{
namespace msgs
{

#define GZ_CONVERT(Message, Type)                    \
  GAZEBO_VISIBLE Message Convert(const Type& value); \
  GAZEBO_VISIBLE void Set(Message* message, const Type& value);
GZ_CONVERT(Vector3d, ignition::math::Vector3d)
GZ_CONVERT(Vector2d, ignition::math::Vector2d)
GZ_CONVERT(Quaternion, ignition::math::Quaterniond)
GZ_CONVERT(Pose, ignition::math::Pose3d)
GZ_CONVERT(Color, ignition::math::Color)
GZ_CONVERT(Time, common::Time)
GZ_CONVERT(Inertial, ignition::math::Inertiald)
GZ_CONVERT(PlaneGeom, ignition::math::Planed)
GZ_CONVERT(SphericalCoordinates, common::SphericalCoordinates)
#undef GZ_CONVERT

GAZEBO_VISIBLE ignition::math::Vector3d ConvertIgn(const Vector3d& message);
GAZEBO_VISIBLE ignition::math::Vector2d ConvertIgn(const Vector2d& message);
GAZEBO_VISIBLE ignition::math::Quaterniond ConvertIgn(const Quaternion& message);
GAZEBO_VISIBLE ignition::math::Pose3d ConvertIgn(const Pose& message);
GAZEBO_VISIBLE ignition::math::Planed ConvertIgn(const PlaneGeom& message);
GAZEBO_VISIBLE ignition::math::Inertiald Convert(const Inertial& message);
GAZEBO_VISIBLE ignition::math::Color Convert(const Color& message);
GAZEBO_VISIBLE common::Time Convert(const Time& message);

GAZEBO_VISIBLE Any ConvertAny(double value);
GAZEBO_VISIBLE Any ConvertAny(int value);
GAZEBO_VISIBLE Any ConvertAny(bool value);
GAZEBO_VISIBLE Any ConvertAny(const std::string& value);
GAZEBO_VISIBLE Any ConvertAny(const char* value);
GAZEBO_VISIBLE Any ConvertAny(const ignition::math::Vector3d& value);
GAZEBO_VISIBLE Any ConvertAny(const ignition::math::Color& value);
GAZEBO_VISIBLE Any ConvertAny(const ignition::math::Pose3d& value);
GAZEBO_VISIBLE Any ConvertAny(const ignition::math::Quaterniond& value);
GAZEBO_VISIBLE Any ConvertAny(const common::Time& value);

/// The caller owns it.
GAZEBO_VISIBLE Request* CreateRequest(const std::string& request, const std::string& data = "");
GAZEBO_VISIBLE void Init(google::protobuf::Message& message,
                         const std::string& id = "");  // header, stamped, where there is one
GAZEBO_VISIBLE Header* GetHeader(google::protobuf::Message& message);
GAZEBO_VISIBLE void Stamp(Header* header);
GAZEBO_VISIBLE void Stamp(Time* time);
GAZEBO_VISIBLE std::string Package(const std::string& type, const google::protobuf::Message& message);

}  // namespace msgs
}  // namespace gazebo
