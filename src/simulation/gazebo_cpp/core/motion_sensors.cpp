// Sensors of contacts, motion and place.
#include <gazebo/sensors/sensors.hh>

#include <algorithm>
#include <stdexcept>

#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace sensors
{

using ignition::math::Quaterniond;
using ignition::math::Vector3d;
using Lock = std::lock_guard<std::mutex>;

namespace
{

double noisy(const NoisePtr& noise, double value, double dt) { return noise ? noise->Apply(value, dt) : value; }

}  // namespace

// -- contacts -----------------------------------------------------------------------------------------------------------------------

ContactSensor::ContactSensor() : Sensor(OTHER) {}
ContactSensor::~ContactSensor() = default;

void ContactSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr contact = inside(sdf, "contact");
  for (auto named = inside(contact, "collision"); named; named = named->GetNextElement("collision"))
  {
    const std::string name = named->Get<std::string>();
    collisions_.push_back(name.compare(0, ParentName().size() + 2, ParentName() + "::") == 0 ? name
                                                                                             : ParentName() + "::" + name);
  }
  topic_ = topicOf("");
  if (contact && contact->HasElement("topic") && contact->Get<std::string>("topic") != "__default_topic__")
    topic_ = contact->Get<std::string>("topic");
  publisher_ = node->Advertise<msgs::Contacts>(topic_, 100);
}

bool ContactSensor::UpdateImpl(bool)
{
  const auto mine = [&](const physics::Collision* collision) {
    return std::find(collisions_.begin(), collisions_.end(), collision->GetScopedName()) != collisions_.end();
  };
  msgs::Contacts now;
  for (const physics::Contact* contact : physics::get_world()->Physics()->GetContactManager()->GetContacts())
    if (mine(contact->collision1) || mine(contact->collision2))
      contact->FillMsg(*now.add_contact());
  msgs::Set(now.mutable_time(), lastMeasurementTime);
  {
    const Lock lock(mutex_);
    contacts_ = now;
  }
  if (listened())
    publisher_->Publish(now);
  return true;
}

msgs::Contacts ContactSensor::Contacts() const
{
  const Lock lock(mutex_);
  return contacts_;
}

std::map<std::string, physics::Contact> ContactSensor::Contacts(const std::string& collision)
{
  std::map<std::string, physics::Contact> found;
  const msgs::Contacts now = Contacts();
  for (const msgs::Contact& contact : now.contact())
    if (contact.collision1() == collision)
      found[contact.collision2()] = contact;
    else if (contact.collision2() == collision)
      found[contact.collision1()] = contact;
  return found;
}

unsigned int ContactSensor::GetCollisionContactCount(const std::string& collision) const
{
  unsigned int count = 0;
  const msgs::Contacts now = Contacts();
  for (const msgs::Contact& contact : now.contact())
    if (contact.collision1() == collision || contact.collision2() == collision)
      count += static_cast<unsigned int>(contact.position_size());
  return count;
}

// -- IMU ----------------------------------------------------------------------------------------------------------------------------

ImuSensor::ImuSensor() : Sensor(OTHER) {}
ImuSensor::~ImuSensor() = default;

void ImuSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr imu = inside(sdf, "imu");
  const auto rates = inside(imu, "angular_velocity"), accelerations = inside(imu, "linear_acceleration");
  static const char* const axes[] = { "x", "y", "z" };
  for (int k = 0; k < 3; ++k)
  {
    noiseFrom(inside(rates, axes[k]), static_cast<SensorNoiseType>(IMU_ANGVEL_X_NOISE_RADIANS_PER_S + k));
    noiseFrom(inside(accelerations, axes[k]), static_cast<SensorNoiseType>(IMU_LINACC_X_NOISE_METERS_PER_S_SQR + k));
  }
  q_WR_ = worldPose().Rot();  // as it stands when it is made
  topic_ = topicOf("/imu");
  publisher_ = node->Advertise<msgs::IMU>(topic_, 500);
  message_.set_entity_name(ParentName());
  for (auto* vector : { message_.mutable_angular_velocity(), message_.mutable_linear_acceleration() })
    msgs::Set(vector, Vector3d());
  msgs::Set(message_.mutable_orientation(), Quaterniond());
  msgs::Set(message_.mutable_stamp(), common::Time());
}

bool ImuSensor::UpdateImpl(bool)
{
  const physics::LinkPtr on = link();
  if (!on)
    return false;
  const Quaterniond q_WS = worldPose().Rot();
  const Vector3d v = velocity(), g = physics::get_world()->Gravity();
  const double dt = sinceLast();
  const Lock lock(mutex_);
  const Vector3d a = moved_ && dt > 0 ? (v - last_velocity_) / dt : Vector3d();
  last_velocity_ = v, moved_ = true;
  rates_ = q_WS.RotateVectorReverse(on->WorldAngularVel());
  acceleration_ = q_WS.RotateVectorReverse(a - g);
  Vector3d rates = rates_, acceleration = acceleration_;
  for (int k = 0; k < 3; ++k)
  {
    rates[k] = noisy(Noise(static_cast<SensorNoiseType>(IMU_ANGVEL_X_NOISE_RADIANS_PER_S + k)), rates[k], dt);
    acceleration[k] = noisy(Noise(static_cast<SensorNoiseType>(IMU_LINACC_X_NOISE_METERS_PER_S_SQR + k)), acceleration[k], dt);
  }
  msgs::Set(message_.mutable_stamp(), lastMeasurementTime);
  msgs::Set(message_.mutable_orientation(), q_WR_.Inverse() * q_WS);
  msgs::Set(message_.mutable_angular_velocity(), rates);
  msgs::Set(message_.mutable_linear_acceleration(), acceleration);
  if (listened())
    publisher_->Publish(message_);
  return true;
}

msgs::IMU ImuSensor::ImuMessage() const
{
  const Lock lock(mutex_);
  return message_;
}

Vector3d ImuSensor::AngularVelocity(bool noise_free) const
{
  const Lock lock(mutex_);
  return noise_free ? rates_ : msgs::ConvertIgn(message_.angular_velocity());
}

Vector3d ImuSensor::LinearAcceleration(bool noise_free) const
{
  const Lock lock(mutex_);
  return noise_free ? acceleration_ : msgs::ConvertIgn(message_.linear_acceleration());
}

Quaterniond ImuSensor::Orientation() const
{
  const Lock lock(mutex_);
  return msgs::ConvertIgn(message_.orientation());
}

void ImuSensor::SetReferencePose() { q_WR_ = worldPose().Rot(); }

// -- place --------------------------------------------------------------------------------------------------------------------------

GpsSensor::GpsSensor() : Sensor(OTHER) {}
GpsSensor::~GpsSensor() = default;

void GpsSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr gps = inside(sdf, "gps");
  const auto position = inside(gps, "position_sensing"), speed = inside(gps, "velocity_sensing");
  noiseFrom(inside(position, "horizontal"), GPS_POSITION_LATITUDE_NOISE_METERS);
  noiseFrom(inside(position, "horizontal"), GPS_POSITION_LONGITUDE_NOISE_METERS);
  noiseFrom(inside(position, "vertical"), GPS_POSITION_ALTITUDE_NOISE_METERS);
  noiseFrom(inside(speed, "horizontal"), GPS_VELOCITY_LATITUDE_NOISE_METERS);
  noiseFrom(inside(speed, "horizontal"), GPS_VELOCITY_LONGITUDE_NOISE_METERS);
  noiseFrom(inside(speed, "vertical"), GPS_VELOCITY_ALTITUDE_NOISE_METERS);
  topic_ = topicOf("/gps");
  publisher_ = node->Advertise<msgs::GPS>(topic_, 50);
  message_.set_link_name(ParentName());
  UpdateImpl(true);
}

bool GpsSensor::UpdateImpl(bool)
{
  const physics::WorldPtr world = physics::get_world();
  const double dt = sinceLast();
  const auto with_noise = [&](Vector3d v, SensorNoiseType x, SensorNoiseType y, SensorNoiseType z) {
    return Vector3d(noisy(Noise(x), v.X(), dt), noisy(Noise(y), v.Y(), dt), noisy(Noise(z), v.Z(), dt));
  };
  const Vector3d p = with_noise(worldPose().Pos(), GPS_POSITION_LATITUDE_NOISE_METERS, GPS_POSITION_LONGITUDE_NOISE_METERS,
                                GPS_POSITION_ALTITUDE_NOISE_METERS);
  const Vector3d v = with_noise(world->SphericalCoords()->GlobalFromLocal(velocity()), GPS_VELOCITY_LATITUDE_NOISE_METERS,
                                GPS_VELOCITY_LONGITUDE_NOISE_METERS, GPS_VELOCITY_ALTITUDE_NOISE_METERS);
  const Vector3d place = world->SphericalCoords()->SphericalFromLocal(p);  // degrees and m
  const Lock lock(mutex_);
  msgs::Set(message_.mutable_time(), lastMeasurementTime);
  message_.set_latitude_deg(place.X()), message_.set_longitude_deg(place.Y()), message_.set_altitude(place.Z());
  message_.set_velocity_east(v.X()), message_.set_velocity_north(v.Y()), message_.set_velocity_up(v.Z());
  if (listened())
    publisher_->Publish(message_);
  return true;
}

ignition::math::Angle GpsSensor::Latitude() const
{
  const Lock lock(mutex_);
  return IGN_DTOR(message_.latitude_deg());
}

ignition::math::Angle GpsSensor::Longitude() const
{
  const Lock lock(mutex_);
  return IGN_DTOR(message_.longitude_deg());
}

double GpsSensor::Altitude() const
{
  const Lock lock(mutex_);
  return message_.altitude();
}

Vector3d GpsSensor::VelocityENU() const
{
  const Lock lock(mutex_);
  return { message_.velocity_east(), message_.velocity_north(), message_.velocity_up() };
}

AltimeterSensor::AltimeterSensor() : Sensor(OTHER) {}
AltimeterSensor::~AltimeterSensor() = default;

void AltimeterSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr altimeter = inside(sdf, "altimeter");
  noiseFrom(inside(altimeter, "vertical_position"), ALTIMETER_POSITION_NOISE_METERS);
  noiseFrom(inside(altimeter, "vertical_velocity"), ALTIMETER_VELOCITY_NOISE_METERS_PER_S);
  topic_ = topicOf("/altimeter");
  publisher_ = node->Advertise<msgs::Altimeter>(topic_, 50);
  message_.set_vertical_reference(worldPose().Pos().Z());
  message_.set_vertical_position(0), message_.set_vertical_velocity(0);
}

bool AltimeterSensor::UpdateImpl(bool)
{
  const double height = worldPose().Pos().Z(), speed = velocity().Z(), dt = sinceLast();
  const Lock lock(mutex_);
  msgs::Set(message_.mutable_time(), lastMeasurementTime);
  message_.set_vertical_position(noisy(Noise(ALTIMETER_POSITION_NOISE_METERS), height - message_.vertical_reference(), dt));
  message_.set_vertical_velocity(noisy(Noise(ALTIMETER_VELOCITY_NOISE_METERS_PER_S), speed, dt));
  if (listened())
    publisher_->Publish(message_);
  return true;
}

double AltimeterSensor::Altitude() const
{
  const Lock lock(mutex_);
  return message_.vertical_position();
}

double AltimeterSensor::VerticalVelocity() const
{
  const Lock lock(mutex_);
  return message_.vertical_velocity();
}

double AltimeterSensor::ReferenceAltitude() const
{
  const Lock lock(mutex_);
  return message_.vertical_reference();
}

void AltimeterSensor::SetReferenceAltitude(double altitude)
{
  const Lock lock(mutex_);
  message_.set_vertical_reference(altitude);
}

MagnetometerSensor::MagnetometerSensor() : Sensor(OTHER) {}
MagnetometerSensor::~MagnetometerSensor() = default;

void MagnetometerSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr magnetometer = inside(sdf, "magnetometer");
  static const char* const axes[] = { "x", "y", "z" };
  for (int k = 0; k < 3; ++k)
    noiseFrom(inside(magnetometer, axes[k]), static_cast<SensorNoiseType>(MAGNETOMETER_X_NOISE_TESLA + k));
  topic_ = topicOf("/magnetometer");
  publisher_ = node->Advertise<msgs::Magnetometer>(topic_, 50);
  UpdateImpl(true);
}

bool MagnetometerSensor::UpdateImpl(bool)
{
  Vector3d field = worldPose().Rot().RotateVectorReverse(physics::get_world()->MagneticField());
  const Lock lock(mutex_);
  for (int k = 0; k < 3; ++k)
    field[k] = noisy(Noise(static_cast<SensorNoiseType>(MAGNETOMETER_X_NOISE_TESLA + k)), field[k], sinceLast());
  msgs::Set(message_.mutable_time(), lastMeasurementTime);
  msgs::Set(message_.mutable_field_tesla(), field);
  if (listened())
    publisher_->Publish(message_);
  return true;
}

Vector3d MagnetometerSensor::MagneticField() const
{
  const Lock lock(mutex_);
  return msgs::ConvertIgn(message_.field_tesla());
}

}  // namespace sensors
}  // namespace gazebo
