// Messages from numbers, and numbers from messages.
#include <gazebo/msgs/msgs.hh>

#include <atomic>

namespace gazebo
{
namespace msgs
{

void Set(Vector3d* m, const ignition::math::Vector3d& v) { m->set_x(v.X()), m->set_y(v.Y()), m->set_z(v.Z()); }
void Set(Vector2d* m, const ignition::math::Vector2d& v) { m->set_x(v.X()), m->set_y(v.Y()); }
void Set(Quaternion* m, const ignition::math::Quaterniond& q)
{
  m->set_x(q.X()), m->set_y(q.Y()), m->set_z(q.Z()), m->set_w(q.W());
}
void Set(Pose* m, const ignition::math::Pose3d& X)
{
  Set(m->mutable_position(), X.Pos());
  Set(m->mutable_orientation(), X.Rot());
}
void Set(Color* m, const ignition::math::Color& c) { m->set_r(c.R()), m->set_g(c.G()), m->set_b(c.B()), m->set_a(c.A()); }
void Set(Time* m, const common::Time& t) { m->set_sec(t.sec), m->set_nsec(t.nsec); }
void Set(Inertial* m, const ignition::math::Inertiald& inertial)
{
  const auto& mass = inertial.MassMatrix();
  m->set_mass(mass.Mass());
  m->set_ixx(mass.Ixx()), m->set_ixy(mass.Ixy()), m->set_ixz(mass.Ixz());
  m->set_iyy(mass.Iyy()), m->set_iyz(mass.Iyz()), m->set_izz(mass.Izz());
  Set(m->mutable_pose(), inertial.Pose());
}
void Set(PlaneGeom* m, const ignition::math::Planed& plane)
{
  Set(m->mutable_normal(), plane.Normal());
  m->mutable_size()->set_x(plane.Size().X()), m->mutable_size()->set_y(plane.Size().Y());
  m->set_d(plane.Offset());
}
void Set(SphericalCoordinates* m, const common::SphericalCoordinates& s)
{
  m->set_surface_model(SphericalCoordinates::EARTH_WGS84);
  m->set_latitude_deg(s.LatitudeReference().Degree()), m->set_longitude_deg(s.LongitudeReference().Degree());
  m->set_heading_deg(s.HeadingOffset().Degree()), m->set_elevation(s.GetElevationReference());
}

#define GZ_CONVERT(Message, Type)    \
  Message Convert(const Type& value) \
  {                                  \
    Message message;                 \
    Set(&message, value);            \
    return message;                  \
  }
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

ignition::math::Vector3d ConvertIgn(const Vector3d& m) { return { m.x(), m.y(), m.z() }; }
ignition::math::Vector2d ConvertIgn(const Vector2d& m) { return { m.x(), m.y() }; }
ignition::math::Quaterniond ConvertIgn(const Quaternion& m) { return { m.w(), m.x(), m.y(), m.z() }; }
ignition::math::Pose3d ConvertIgn(const Pose& m) { return { ConvertIgn(m.position()), ConvertIgn(m.orientation()) }; }
ignition::math::Planed ConvertIgn(const PlaneGeom& m)
{
  return { ConvertIgn(m.normal()), ignition::math::Vector2d(m.size().x(), m.size().y()), m.d() };
}
ignition::math::Inertiald Convert(const Inertial& m)
{
  return { ignition::math::MassMatrix3d(m.mass(), { m.ixx(), m.iyy(), m.izz() }, { m.ixy(), m.ixz(), m.iyz() }),
           ConvertIgn(m.pose()) };
}
ignition::math::Color Convert(const Color& m) { return { m.r(), m.g(), m.b(), m.a() }; }
common::Time Convert(const Time& m) { return { m.sec(), m.nsec() }; }

#define GZ_ANY(Type, kind, set) \
  Any ConvertAny(Type value)    \
  {                             \
    Any any;                    \
    any.set_type(Any::kind);    \
    set;                        \
    return any;                 \
  }
GZ_ANY(double, DOUBLE, any.set_double_value(value))
GZ_ANY(int, INT32, any.set_int_value(value))
GZ_ANY(bool, BOOLEAN, any.set_bool_value(value))
GZ_ANY(const std::string&, STRING, any.set_string_value(value))
GZ_ANY(const char*, STRING, any.set_string_value(value))
GZ_ANY(const ignition::math::Vector3d&, VECTOR3D, Set(any.mutable_vector3d_value(), value))
GZ_ANY(const ignition::math::Color&, COLOR, Set(any.mutable_color_value(), value))
GZ_ANY(const ignition::math::Pose3d&, POSE3D, Set(any.mutable_pose3d_value(), value))
GZ_ANY(const ignition::math::Quaterniond&, QUATERNIOND, Set(any.mutable_quaternion_value(), value))
GZ_ANY(const common::Time&, TIME, Set(any.mutable_time_value(), value))
#undef GZ_ANY

Request* CreateRequest(const std::string& request, const std::string& data)
{
  static std::atomic<int> next{ 1 };
  auto* message = new Request;
  message->set_request(request);
  message->set_data(data);
  message->set_id(next++);
  return message;
}

Header* GetHeader(google::protobuf::Message& message)
{
  if (auto* own = dynamic_cast<Header*>(&message))
    return own;
  const auto* field = message.GetDescriptor()->FindFieldByName("header");
  if (!field || field->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE || field->is_repeated())
    return nullptr;
  return dynamic_cast<Header*>(message.GetReflection()->MutableMessage(&message, field));
}

void Init(google::protobuf::Message& message, const std::string& id)
{
  Header* header = GetHeader(message);
  if (!header)
    return;
  if (!id.empty())
    header->set_str_id(id);
  Stamp(header);
}

void Stamp(Header* header) { Stamp(header->mutable_stamp()); }
void Stamp(Time* time) { Set(time, common::Time::GetWallTime()); }

std::string Package(const std::string& type, const google::protobuf::Message& message)
{
  gazebo::msgs::Packet packet;
  Stamp(packet.mutable_stamp());
  packet.set_type(type);
  packet.set_serialized_data(message.SerializeAsString());
  return packet.SerializeAsString();
}

}  // namespace msgs
}  // namespace gazebo
