#include "numbers.hpp"

using namespace ignition::math;

TEST(Shapes, colours)
{
  CHECK(Color());
  CHECK(Color(0.1f, 0.2f, 0.3f));
  CHECK(Color(300, 20, 1.5f, 2));
  CHECK(Color(-1, NAN_F, 0, 1));
  const Color c(0.2f, 0.6f, 0.4f, 0.5f), d(0.1f, 0.3f, 0.9f, 1);
  CHECK(c + d);
  CHECK(c - d);
  CHECK(c * d);
  CHECK(c / 2.0f);
  CHECK(c * 0.5f);
  CHECK(c == d);
  CHECK(c.AsRGBA());
  CHECK(c.AsARGB());
  CHECK(c.AsBGRA());
  CHECK(c.AsABGR());
  Color e;
  e.SetFromRGBA(0x10204080u);
  CHECK(e);
  e.SetFromARGB(0x10204080u);
  CHECK(e);
  CHECK(c.HSV().X());
  CHECK(c.HSV().Y());
  CHECK(c.HSV().Z());
  for (const float hue : { 10.0f, 70.0f, 130.0f, 200.0f, 250.0f, 330.0f })
  {
    e.SetFromHSV(hue, 0.5f, 0.8f);
    CHECK(e);
  }
  CHECK(c.YUV().X());
  CHECK(c.YUV().Y());
  CHECK(c.YUV().Z());
  e.SetFromYUV(0.5f, 0.1f, 0.2f);
  CHECK(e);
  CHECK(shown(c));
  CHECK(read<Color>("0.1 0.2 0.3 0.4"));
  CHECK(Color::Magenta);
}

TEST(Shapes, boxes)
{
  const AxisAlignedBox none, box(1, 2, 3, 0, 5, 6), other(0.5, 4, 4, 9, 9, 9), far(20, 20, 20, 30, 30, 30);
  CHECK(none.XLength() + none.Volume());
  CHECK(shown(none));
  CHECK(shown(box));
  CHECK(box.Size());
  CHECK(box.Center());
  CHECK(box.Volume());
  CHECK(shown(box + other));
  CHECK(shown(none + box));
  CHECK(shown(box + Vector3d(1, 1, 1)));
  CHECK(shown(box - Vector3d(1, 1, 1)));
  CHECK(box.Intersects(other));
  CHECK(box.Intersects(far));
  CHECK(box.Contains(Vector3d(0.5, 3, 4)));
  CHECK(box.Contains(Vector3d(0.5, 3, 7)));
  CHECK(box == box);
  CHECK(box.IntersectCheck(Vector3d(-5, 3, 4), Vector3d(1, 0, 0), 0, 10));
  CHECK(box.IntersectCheck(Vector3d(-5, 3, 4), Vector3d(1, 0, 0), 0, 2));
  CHECK(std::get<1>(box.IntersectDist(Vector3d(-5, 3, 4), Vector3d(1, 0, 0), 0, 10)));
  CHECK(std::get<2>(box.Intersect(Vector3d(-5, 3, 4), Vector3d(1, 0.1, 0), 0, 10)));
}

TEST(Shapes, planes_and_lines)
{
  const Planed plane(Vector3d(0, 0, 1), Vector2d(3, 4), 2.5);
  CHECK(plane.Distance(Vector3d(1, 2, 7)));
  CHECK(plane.Distance(Vector3d(1, 2, 7), Vector3d(0, 0.6, -0.8)));
  CHECK(plane.Distance(Vector3d(1, 2, 7), Vector3d(1, 0, 0)));
  CHECK(plane.Intersection(Vector3d(1, 2, 7), Vector3d(1, 0, 0)).has_value());
  CHECK(plane.Side(Vector3d(0, 0, 3)));
  CHECK(plane.Side(Vector3d(0, 0, 2)));
  CHECK(plane.Side(Vector3d(0, 0, 2.5)));
  CHECK(plane.Side(AxisAlignedBox(0, 0, 0, 1, 1, 1)));
  CHECK(plane.Side(AxisAlignedBox(0, 0, 0, 1, 1, 9)));
  CHECK(plane.Size());
  const Line2d s(0, 0, 4, 2), t(0, 2, 4, 0), u(8, 4, 9, 4.5), v(2, 1, 9, 4.5);
  CHECK(s.CrossProduct(t));
  CHECK(s.CrossProduct(Vector2d(1, 3)));
  CHECK(s.Parallel(u) + 2 * s.Parallel(t));
  CHECK(s.Collinear(Vector2d(2, 1)) + 2 * s.Collinear(Vector2d(2, 2)));
  CHECK(s.Collinear(v) + 2 * s.Collinear(u) + 4 * s.Collinear(t));
  CHECK(s.OnSegment(Vector2d(2, 1)) + 2 * s.OnSegment(Vector2d(8, 4)));
  CHECK(s.Intersect(t) + 2 * s.Intersect(u) + 4 * s.Intersect(v));
  Vector2d at;
  CHECK(s.Intersect(t, at));
  CHECK(at);
  CHECK(s.Length());
  CHECK(s.Slope());
  CHECK(Line2d(1, 1, 1, 2).Slope());
  CHECK(shown(s));
  const Line3d x(0, 0, 0, 4, 0, 0), y(1, -1, 2, 1, 3, 2), z(1, -1, 0, 1, 3, 0);
  CHECK(x.Direction());
  CHECK(x.Length());
  CHECK(Line3d(x).Distance(Vector3d(6, 3, 0)));
  Line3d between;
  CHECK(x.Distance(y, between));
  CHECK(between.Length());
  CHECK(x.Intersect(y) + 2 * x.Intersect(z));
  Vector3d point;
  CHECK(x.Intersect(z, point));
  CHECK(point);
  CHECK(x.Coplanar(z) + 2 * x.Coplanar(y));
  CHECK(x.Parallel(z) + 2 * x.Parallel(x));
  CHECK(shown(x));
}

TEST(Shapes, masses)
{
  MassMatrix3d m;
  CHECK(m.SetFromBox(6.0, Vector3d(1, 2, 3)));
  CHECK(m.DiagonalMoments());
  CHECK(m.SetFromBox(6.0, Vector3d(1, 2, 3), Quaterniond(0.3, 0.4, 0.5)));
  CHECK(m.Moi());
  CHECK(m.PrincipalMoments());
  const Matrix3d axes(m.PrincipalAxesOffset());
  const Vector3d moments = m.PrincipalMoments();
  CHECK(axes * Matrix3d(moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2]) * axes.Transposed());
  Vector3d size;
  Quaterniond rotation;
  CHECK(m.EquivalentBox(size, rotation));
  CHECK(size);
  CHECK(m.IsValid() + 2 * m.IsPositive());
  CHECK(m.SetIxx(500));
  CHECK(m.SetFromSphere(2.0, 0.5));
  CHECK(m.Moi());
  CHECK(m.SetFromCylinderZ(2.0, 0.5, 0.25));
  CHECK(m.Moi());
  CHECK(m.SetFromSphere(-2.0, 0.5));
  CHECK(MassMatrix3d(1, Vector3d(1, 1, 1), Vector3d::Zero).IsValid());
  CHECK(MassMatrix3d(1, Vector3d(1, 1, 9), Vector3d::Zero).IsValid());
  CHECK(MassMatrix3d(1, Vector3d(0.1, 0.2, 0.25), Vector3d::Zero).Mass());
  const Inertiald first(MassMatrix3d(2, Vector3d(0.1, 0.2, 0.25), Vector3d(0.01, 0, 0.02)), Pose3d(1, 0, 0, 0.1, 0.2, 0.3));
  const Inertiald second(MassMatrix3d(3, Vector3d(0.4, 0.3, 0.2), Vector3d::Zero), Pose3d(0, 1, -1, 0, 0, 1));
  CHECK(first.Moi());
  const Inertiald sum = first + second;
  CHECK(sum.Pose());
  CHECK(sum.MassMatrix().Mass());
  CHECK(sum.Moi());
  Inertiald turned = first;
  CHECK(turned.SetInertialRotation(Quaterniond(0.5, 0.6, 0.7)));
  CHECK(turned.Moi());
  CHECK(turned.MassMatrix().DiagonalMoments());
}

TEST(Shapes, the_earth)
{
  typedef SphericalCoordinates Earth;
  const Earth earth(Earth::EARTH_WGS84, Angle(0.6), Angle(-1.2), 400, Angle(0.3));
  CHECK(earth.SphericalFromLocalPosition(Vector3d(100, -250, 30)));
  CHECK(earth.LocalFromSphericalPosition(Vector3d(34.4, -68.8, 350)));
  CHECK(earth.GlobalFromLocalVelocity(Vector3d(1, 2, 3)));
  CHECK(earth.LocalFromGlobalVelocity(Vector3d(1, 2, 3)));
  const Vector3d places[] = {
    {}, { 0.61, -1.19, 300 }, { 1.2e6, -5e6, 3.6e6 }, { 100, 200, 30 }, { 100, 200, 30 }, { 100, 200, 30 }
  };
  for (int in = 1; in <= 5; ++in)
    for (int out = 1; out <= 5; ++out)
    {
      CHECK(
          earth.PositionTransform(places[in], static_cast<Earth::CoordinateType>(in), static_cast<Earth::CoordinateType>(out)));
      if (in > 1 && out > 1)
        CHECK(earth.VelocityTransform(Vector3d(1, 2, 3), static_cast<Earth::CoordinateType>(in),
                                      static_cast<Earth::CoordinateType>(out)));
    }
  CHECK(Earth::Distance(Angle(0.6), Angle(-1.2), Angle(0.61), Angle(-1.1)));
  CHECK(Earth::Convert("EARTH_WGS84"));
  CHECK(earth == Earth());
}

TEST(Shapes, chance)
{
  Rand::Seed(42);
  CHECK(Rand::Seed());
  CHECK(Rand::DblUniform(1, 2));
  CHECK(Rand::DblNormal(1, 2));
  CHECK(Rand::DblNormal(1, 2));
  CHECK(Rand::IntUniform(1, 100));
  CHECK(Rand::IntNormal(10, 5));
  CHECK(Rand::DblUniform());
}

TEST(Shapes, control_and_filters)
{
  PID pid(2, 0.5, 0.1, 0.3, -0.3, 5, -5, 0.25);
  for (const double error : { 1.0, 0.5, -2.0, 4.0 })
    CHECK(pid.Update(error, std::chrono::duration<double>(0.1)));
  CHECK(pid.Update(1, std::chrono::duration<double>(0)));
  double pe = 0, ie = 0, de = 0;
  pid.Errors(pe, ie, de);
  CHECK(Vector3d(pe, ie, de));
  PID open(1, 1, 0);
  CHECK(open.Update(100, std::chrono::duration<double>(1)));
  CHECK(PID().IMax() + 10 * PID().CmdMax());
  OnePole<double> one(3, 100);
  BiQuad<double> two(3, 100);
  OnePoleQuaternion turn(3, 100);
  for (const double value : { 1.0, 2.0, -1.0 })
  {
    CHECK(one.Process(value));
    CHECK(two.Process(value));
    CHECK(turn.Process(Quaterniond(value, 0, 0)));
  }
  BiQuadVector3 three(5, 50);
  CHECK(three.Process(Vector3d(1, 2, 3)));
  const Temperature warm(300);
  CHECK(warm.Celsius());
  CHECK(warm.Fahrenheit());
  CHECK((warm + 10.0).Kelvin());
  CHECK(warm < Temperature(301));
  CHECK(shown(warm));
}
