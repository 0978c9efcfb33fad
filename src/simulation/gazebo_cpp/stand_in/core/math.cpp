#include <ignition/math.hh>

#include <cstdlib>
#include <iostream>
#include <mutex>
#include <stdexcept>

namespace ignition
{
namespace math
{
inline namespace v6
{

int parseInt(const std::string& input)
{
  try
  {
    return std::stoi(input);
  }
  catch (const std::logic_error&)
  {
    return NAN_I;
  }
}

double parseFloat(const std::string& input)
{
  try
  {
    return std::stod(input);
  }
  catch (const std::logic_error&)
  {
    return NAN_D;
  }
}

// ----- chance

namespace
{

struct Chance
{
  Chance() { seed(std::random_device{}()); }
  void seed(unsigned int value)
  {
    used = value;
    std::seed_seq sequence{ value };
    generator.seed(sequence);
  }
  std::mutex mutex;
  unsigned int used = 0;
  GeneratorType generator;
};

Chance& chance()
{
  static Chance one;
  return one;
}

template <typename Distribution>
auto draw(Distribution distribution)
{
  const std::lock_guard<std::mutex> lock(chance().mutex);
  return distribution(chance().generator);
}

}  // namespace

void Rand::Seed(unsigned int seed)
{
  const std::lock_guard<std::mutex> lock(chance().mutex);
  chance().seed(seed);
}
unsigned int Rand::Seed() { return chance().used; }
double Rand::DblUniform(double min, double max) { return draw(std::uniform_real_distribution<double>(min, max)); }
double Rand::DblNormal(double mean, double sigma) { return draw(std::normal_distribution<double>(mean, sigma)); }
std::int32_t Rand::IntUniform(int min, int max) { return draw(std::uniform_int_distribution<std::int32_t>(min, max)); }
std::int32_t Rand::IntNormal(int mean, int sigma)
{
  return static_cast<std::int32_t>(draw(std::normal_distribution<double>(mean, sigma)));
}

// ----- colours

void Color::Set(float r, float g, float b, float a)
{
  const auto part = [](float v) { return std::isnan(v) || v < 0 ? 0.0f : v > 1 ? v / 255.0f : v; };
  r_ = part(r);
  g_ = part(g);
  b_ = part(b);
  a_ = std::isnan(a) || a < 0 ? 0.0f : std::min(a, 1.0f);
}

Vector3f Color::HSV() const
{
  const float max = std::max(r_, std::max(g_, b_)), min = std::min(r_, std::min(g_, b_)), range = max - min;
  Vector3f hsv(0, 0, max);
  if (equal(range, 0.0f))
    return hsv;
  hsv.Y(range / max);
  float sixth = 0;
  if (equal(r_, max))
    sixth = (g_ - b_) / range;
  else if (equal(g_, max))
    sixth = 2.0f + (b_ - r_) / range;
  else
    sixth = 4.0f + (r_ - g_) / range;
  hsv.X(sixth * 60.0f < 0 ? sixth * 60.0f + 360.0f : sixth * 60.0f);
  return hsv;
}

void Color::SetFromHSV(float h, float s, float v)
{
  float turn = std::fmod(h, 360.0f);
  if (turn < 0)
    turn += 360.0f;
  const float sixth = turn / 60.0f;
  const int side = static_cast<int>(std::floor(sixth));
  const float rest = sixth - static_cast<float>(side), p = v * (1 - s), q = v * (1 - s * rest), t = v * (1 - s * (1 - rest));
  switch (side)
  {
    case 0:
      return Set(v, t, p, a_);
    case 1:
      return Set(q, v, p, a_);
    case 2:
      return Set(p, v, t, a_);
    case 3:
      return Set(p, q, v, a_);
    case 4:
      return Set(t, p, v, a_);
    default:
      return Set(v, p, q, a_);
  }
}

Vector3f Color::YUV() const
{
  const float y = 0.299f * r_ + 0.587f * g_ + 0.114f * b_;
  return Vector3f(y, -0.1679f * r_ - 0.332f * g_ + 0.5f * b_ + 0.5f, 0.5f * r_ - 0.4189f * g_ - 0.08105f * b_ + 0.5f);
}

void Color::SetFromYUV(float y, float u, float v) { Set(y + 1.140f * v, y - 0.395f * u - 0.581f * v, y + 2.032f * u, a_); }

unsigned int Color::packed(unsigned int first, unsigned int second, unsigned int third, unsigned int last) const
{
  unsigned int all = 0;
  for (const unsigned int each : { first, second, third, last })
    all = (all << 8) | static_cast<std::uint8_t>(part(each) * 255.0f);
  return all;
}

void Color::unpack(unsigned int v, unsigned int first, unsigned int second, unsigned int third, unsigned int last)
{
  float* const parts[] = { &r_, &g_, &b_, &a_ };
  for (const unsigned int each : { last, third, second, first })
  {
    *parts[each] = static_cast<float>(v & 0xff) / 255.0f;
    v >>= 8;
  }
}

std::istream& operator>>(std::istream& in, Color& c)
{
  in.setf(std::ios_base::skipws);
  Color read;
  in >> read.r_ >> read.g_ >> read.b_;
  if (!in.fail() && !(in >> read.a_))  // three are a colour, too
  {
    in.clear(in.rdstate() & ~std::ios_base::failbit);
    read.a_ = 1;
  }
  if (!in.fail())
    c = read;
  return in;
}

// ----- boxes

std::tuple<bool, double> AxisAlignedBox::IntersectDist(const Vector3d& origin, const Vector3d& direction, double min,
                                                       double max) const
{
  const Vector3d along = direction.Normalized();
  double near = min, far = max;
  for (unsigned int i = 0; i < 3; ++i)
  {
    if (along[i] == 0 && (origin[i] < min_[i] || origin[i] > max_[i]))
      return std::make_tuple(false, 0.0);
    if (along[i] == 0)
      continue;
    const double a = (min_[i] - origin[i]) / along[i], b = (max_[i] - origin[i]) / along[i];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? std::make_tuple(true, near) : std::make_tuple(false, 0.0);
}

bool AxisAlignedBox::IntersectCheck(const Vector3d& origin, const Vector3d& direction, double min, double max) const
{
  return std::get<0>(IntersectDist(origin, direction, min, max));
}

std::tuple<bool, double, Vector3d> AxisAlignedBox::Intersect(const Vector3d& origin, const Vector3d& direction, double min,
                                                             double max) const
{
  const auto [met, distance] = IntersectDist(origin, direction, min, max);
  return met ? std::make_tuple(true, distance, origin + direction.Normalized() * distance)
             : std::make_tuple(false, 0.0, Vector3d::Zero);
}

std::tuple<bool, double, Vector3d> AxisAlignedBox::Intersect(const Line3d& line) const
{
  return Intersect(line[0], line.Direction(), 0, line.Length());
}

// ----- control

double PID::Update(double error, const std::chrono::duration<double>& dt)
{
  if (dt.count() == 0 || std::isnan(error) || std::isinf(error))
    return 0;
  p_error_ = error;
  i_error_ += i_ * dt.count() * error;
  double integral = i_error_;
  if (imax_ >= imin_)
    integral = i_error_ = clamp(i_error_, imin_, imax_);
  d_error_ = (p_error_ - last_error_) / dt.count();
  last_error_ = p_error_;
  cmd_ = cmd_offset_ - p_ * p_error_ - integral - d_ * d_error_;
  if (cmd_max_ >= cmd_min_)
    cmd_ = clamp(cmd_, cmd_min_, cmd_max_);
  return cmd_;
}

// ----- the earth

namespace
{

const double equator = 6378137.0, pole = 6356752.314245;
const double eccentricity2 = 1 - (pole * pole) / (equator * equator);

/// Between the heading's axes and east and north. What comes in as LOCAL is turned by half a turn and against the heading: an error that
/// everybody's worlds have come to rely on, and for which LOCAL2 was made.
Vector3d turned(const Vector3d& v, double cosine, double sine)
{
  return Vector3d(v.X() * cosine - v.Y() * sine, v.X() * sine + v.Y() * cosine, v.Z());
}

Vector3d earth_centred(double latitude, double longitude, double height)
{
  const double sine = std::sin(latitude), radius = equator / std::sqrt(1 - eccentricity2 * sine * sine);
  return Vector3d((radius + height) * std::cos(latitude) * std::cos(longitude),
                  (radius + height) * std::cos(latitude) * std::sin(longitude), ((1 - eccentricity2) * radius + height) * sine);
}

Vector3d spherical(const Vector3d& p)
{
  const double across = std::hypot(p.X(), p.Y()), angle = std::atan(p.Z() * equator / (across * pole));  // Bowring
  const double second = (equator * equator) / (pole * pole) - 1;
  const double latitude = std::atan((p.Z() + second * pole * std::pow(std::sin(angle), 3)) /
                                    (across - eccentricity2 * equator * std::pow(std::cos(angle), 3)));
  const double radius = equator / std::sqrt(1 - eccentricity2 * std::sin(latitude) * std::sin(latitude));
  return Vector3d(latitude, std::atan2(p.Y(), p.X()), across / std::cos(latitude) - radius);
}

}  // namespace

SphericalCoordinates::SurfaceType SphericalCoordinates::Convert(const std::string& text)
{
  if (text != "EARTH_WGS84")
    std::cerr << "SurfaceType string not recognized, EARTH_WGS84 returned by default" << std::endl;
  return EARTH_WGS84;
}

std::string SphericalCoordinates::Convert(SurfaceType) { return "EARTH_WGS84"; }

double SphericalCoordinates::Distance(const Angle& latA, const Angle& lonA, const Angle& latB, const Angle& lonB)
{
  const double north = std::sin((latB - latA).Radian() / 2), east = std::sin((lonB - lonA).Radian() / 2);
  const double a = north * north + east * east * std::cos(latA.Radian()) * std::cos(latB.Radian());
  return 6371000.0 * 2 * std::atan2(std::sqrt(a), std::sqrt(1 - a));
}

void SphericalCoordinates::UpdateTransformationMatrix()
{
  const double sin_lat = std::sin(latitude_.Radian()), cos_lat = std::cos(latitude_.Radian());
  const double sin_lon = std::sin(longitude_.Radian()), cos_lon = std::cos(longitude_.Radian());
  to_global_ = Matrix3d(-sin_lon, cos_lon, 0, -cos_lon * sin_lat, -sin_lon * sin_lat, cos_lat, cos_lat * cos_lon,
                        cos_lat * sin_lon, sin_lat);
  origin_ = earth_centred(latitude_.Radian(), longitude_.Radian(), elevation_);
}

Vector3d SphericalCoordinates::SphericalFromLocalPosition(const Vector3d& xyz) const
{
  Vector3d result = PositionTransform(xyz, LOCAL, SPHERICAL);
  result.X(IGN_RTOD(result.X()));
  result.Y(IGN_RTOD(result.Y()));
  return result;
}

Vector3d SphericalCoordinates::LocalFromSphericalPosition(const Vector3d& place) const
{
  return PositionTransform(Vector3d(IGN_DTOR(place.X()), IGN_DTOR(place.Y()), place.Z()), SPHERICAL, LOCAL);
}

Vector3d SphericalCoordinates::PositionTransform(const Vector3d& position, const CoordinateType& in,
                                                 const CoordinateType& out) const
{
  const double cosine = std::cos(heading_.Radian()), sine = std::sin(heading_.Radian());
  Vector3d p = position;
  if (in == SPHERICAL)
    p = earth_centred(p.X(), p.Y(), p.Z());
  else if (in != ECEF)
  {
    if (in == LOCAL)
      p = turned(p * Vector3d(-1, -1, 1), cosine, -sine);
    else if (in == LOCAL2)
      p = turned(p, cosine, sine);
    p = origin_ + to_global_.Transposed() * p;
  }
  if (out == SPHERICAL)
    return spherical(p);
  if (out == ECEF)
    return p;
  p = to_global_ * (p - origin_);
  return out == LOCAL || out == LOCAL2 ? turned(p, cosine, -sine) : p;
}

Vector3d SphericalCoordinates::VelocityTransform(const Vector3d& velocity, const CoordinateType& in,
                                                 const CoordinateType& out) const
{
  if (in == SPHERICAL || out == SPHERICAL)
  {
    std::cerr << "Velocities have no spherical coordinates" << std::endl;
    return velocity;
  }
  const double cosine = std::cos(heading_.Radian()), sine = std::sin(heading_.Radian());
  Vector3d v = velocity;
  if (in == LOCAL)
    v = turned(v * Vector3d(-1, -1, 1), cosine, -sine);
  else if (in == LOCAL2)
    v = turned(v, cosine, sine);
  if (in != ECEF)
    v = to_global_.Transposed() * v;
  if (out == ECEF)
    return v;
  v = to_global_ * v;
  return out == LOCAL || out == LOCAL2 ? turned(v, cosine, -sine) : v;
}

bool SphericalCoordinates::operator==(const SphericalCoordinates& other) const
{
  return surface_ == other.surface_ && latitude_ == other.latitude_ && longitude_ == other.longitude_ &&
         equal(elevation_, other.elevation_) && heading_ == other.heading_;
}

}  // namespace v6
}  // namespace math
}  // namespace ignition
