#include "numbers.hpp"

using namespace ignition::math;

namespace
{

const Vector3d a(1.5, -2.25, 3.125), b(-0.5, 4, 0.75), c(7, 8, -9);
const Quaterniond p(0.3, -0.7, 1.9), q(-1.2, 0.4, 2.5), raw(1, 2, 3, 4), up(0.2, IGN_PI_2, 0.5), down(0.2, -IGN_PI_2, 0.5);
const Pose3d A(1, 2, 3, 0.1, 0.2, 0.3), B(-4, 5, 0.5, -0.7, 1.1, 2.2);

}  // namespace

TEST(Math, helpers)
{
  CHECK(clamp(5.0, 1.0, 3.0));
  CHECK(clamp(-5, 1, 3));
  CHECK(equal(1.0, 1.0000005));
  CHECK(equal(1.0, 1.0000015));
  CHECK(equal(3, 3));
  CHECK(ignition::math::isnan(NAN_D));
  CHECK(fixnan(INF_D));
  CHECK(fixnan(2.5));
  CHECK(isEven(-4) + 2 * isOdd(3));
  CHECK(sgn(-2.5) + 10 * signum(7));
  CHECK(precision(1.23456, 2));
  CHECK(precision(-1.235, 2));
  CHECK(mean(std::vector<double>{ 1, 2, 4 }));
  CHECK(variance(std::vector<double>{ 1, 2, 4 }));
  CHECK(ignition::math::max(std::vector<double>{ 1, 5, 4 }));
  CHECK(ignition::math::min(std::vector<double>{ 1, 5, 4 }));
  CHECK(isPowerOfTwo(64) + 2 * isPowerOfTwo(65) + 4 * isPowerOfTwo(0));
  CHECK(roundUpPowerOfTwo(17));
  CHECK(roundUpMultiple(12, 5));
  CHECK(roundUpMultiple(-7, 5));
  CHECK(roundUpMultiple(10, 5));
  for (const char* text : { "", " 12", "-7", "x1", "12x", "1.5" })
    CHECK(parseInt(text));
  for (const char* text : { "", "1.5e3", "-2.5e-2", ".5", "1.5x", "+3", "nan", "x" })
    CHECK(parseFloat(text));
  CHECK(IGN_DTOR(90.0));
  CHECK(IGN_RTOD(1.0));
  CHECK(IGN_NORMALIZE(7.0));
  CHECK(IGN_CYLINDER_VOLUME(2.0, 3.0));
  CHECK(IGN_SPHERE_VOLUME(2.0));
  double x = 3, y = 1, z = 2;
  sort3(x, y, z);
  CHECK(x + 10 * y + 100 * z);
}

TEST(Math, vectors_of_three)
{
  CHECK(a + b);
  CHECK(a - b);
  CHECK(a * b);
  CHECK(a / b);
  CHECK(a + 2.0);
  CHECK(2.0 - a);
  CHECK(a * 2);
  CHECK(3 * a);
  CHECK(a / 0.5);
  CHECK(-a);
  CHECK(a.Dot(b));
  CHECK(a.AbsDot(b));
  CHECK(a.Cross(b));
  CHECK(a.Length());
  CHECK(a.SquaredLength());
  CHECK(a.Sum());
  CHECK(a.Distance(b));
  CHECK(a.Distance(1, 2, 3));
  CHECK(a.Normalized());
  CHECK(Vector3d(1e-7, 0, 0).Normalized());
  CHECK(a.Abs());
  CHECK(a.Rounded());
  CHECK(Vector3d(0.5, 1.5, -2.5).Rounded());
  CHECK(a.Perpendicular());
  CHECK(Vector3d::UnitX.Perpendicular());
  CHECK(Vector3d::Normal(a, b, c));
  CHECK(Vector3d(a).DistToLine(b, c));
  CHECK(a.Max());
  CHECK(a.Min());
  Vector3d v = a;
  v.Max(b);
  CHECK(v);
  v.Min(Vector3d(1, 1, 1));
  CHECK(v);
  v += a;
  v *= 2;
  v -= b;
  v /= Vector3d(2, 4, 8);
  CHECK(v);
  CHECK(v == v + 0.0005);
  CHECK(v == v + 0.0015);
  CHECK(v.Equal(v + 0.1, 0.2));
  CHECK(Vector3d(1, 2, 3) < Vector3d(0, 3, 1));
  CHECK(v[7]);
  CHECK(Vector3d(1, INF_D, 0).IsFinite());
  v.Set(NAN_D, 1, INF_D);
  v.Correct();
  CHECK(v);
  CHECK(shown(Vector3d(1.23456789, 1234567.125, 1e-9)));
  CHECK(read<Vector3d>("1 2.5 -3e2"));
  CHECK(read<Vector3d>("1 2"));
  CHECK(shown(Vector3i(7, 8, 9) / 2));
}

TEST(Math, vectors_of_two_and_four)
{
  const Vector2d s(3, -4.5), t(0.25, 8);
  CHECK(s + t * 2 - s / t);
  CHECK(s.Dot(t));
  CHECK(s.Length());
  CHECK(s.Distance(t));
  CHECK(s.Normalized());
  CHECK(s.Abs());
  CHECK(s.Max() + 10 * s.Min());
  CHECK(s == s + 1e-5);
  CHECK(s < t);
  CHECK(shown(Vector2d(1.23456789, 2)));
  CHECK(read<Vector2d>("4 5"));
  CHECK(shown(read<Vector2i>("4 5")));
  const Vector4d u(1, -2, 3.5, 4), w(0.5, 0.25, -8, 2);
  CHECK(u + w * 2 - u / w);
  CHECK(u.Dot(w));
  CHECK(u.Length());
  CHECK(u.Distance(w));
  CHECK(u.Normalized());
  CHECK(u.Sum());
  CHECK(u * Matrix4d(A));
  CHECK(shown(u));
  CHECK(read<Vector4d>("4 5 6 7"));
}

TEST(Math, angles)
{
  CHECK(Angle(4).Normalized());
  CHECK(Angle(1.0).Degree());
  CHECK(Angle::HalfPi + Angle::Pi * 2 - Angle::TwoPi / 4);
  CHECK(*Angle(2.5) + Angle(1)());
  CHECK(Angle(1) == Angle(1.0005));
  CHECK(Angle(1) == Angle(1.0015));
  CHECK(Angle(1) < Angle(1.1));
  CHECK(Angle(1) <= Angle(1));
  CHECK(Angle(1) > Angle(1.1));
  Angle angle;
  angle.SetDegree(30);
  CHECK(angle);
  CHECK(shown(angle));
  CHECK(read<Angle>("1.25"));
}

TEST(Math, quaternions)
{
  CHECK(p);
  CHECK(Quaterniond(a, 0.7));
  CHECK(Quaterniond(Vector3d::Zero, 0.7));
  CHECK(Quaterniond(Vector3d(0.1, 0.2, 0.3)));
  CHECK(p * q);
  CHECK(p + q);
  CHECK(p - q);
  CHECK(p * 2.0);
  CHECK(-p);
  CHECK(p * a);
  CHECK(raw * a);
  CHECK(p.RotateVector(a));
  CHECK(raw.RotateVector(a));
  CHECK(p.RotateVectorReverse(a));
  CHECK(raw.Inverse());
  CHECK(raw.Normalized());
  CHECK(Quaterniond::Zero.Normalized());
  CHECK(Quaterniond::Zero.Inverse());
  Quaterniond inverted = raw;
  inverted.Invert();
  CHECK(inverted);
  for (const Quaterniond& each : { p, q, raw, up, down })
  {
    CHECK(each.Euler());
    CHECK(each.Roll() + 10 * each.Pitch() + 100 * each.Yaw());
    Vector3d axis;
    double angle = 0;
    each.ToAxis(axis, angle);
    if (each.W() <= 1)
    {
      CHECK(axis);
      CHECK(angle);
    }
    CHECK(each.Log());
    CHECK(each.Exp());
    CHECK(each.XAxis());
    CHECK(each.YAxis());
    CHECK(each.ZAxis());
    CHECK(Quaterniond(Matrix3d(each)));
    CHECK(shown(each));
  }
}

TEST(Math, rotations)
{
  CHECK(p.Dot(q));
  for (const double t : { 0.0, 0.3, 1.0 })
  {
    CHECK(Quaterniond::Slerp(t, p, q));
    CHECK(Quaterniond::Slerp(t, p, -q, true));
    CHECK(Quaterniond::Slerp(t, p, p));
    CHECK(Quaterniond::Squad(t, p, q, raw.Normalized(), -q, true));
  }
  CHECK(p.Integrate(a, 0.01));
  CHECK(p.Integrate(Vector3d(1e-90, 0, 0), 0.01));
  Quaterniond r = p;
  r.Scale(0.5);
  CHECK(r);
  for (const Vector3d& to : { b, c, -a, a * 2, Vector3d::Zero })
  {
    r.From2Axes(a, to);
    CHECK(r);
  }
  r.From2Axes(Vector3d::UnitX, -Vector3d::UnitX);
  CHECK(r.RotateVector(Vector3d::UnitX));
  r.From2Axes(Vector3d::UnitZ, Vector3d::UnitX);
  CHECK(r);
  CHECK(p == p * 1.0001);
  CHECK(p == q);
  r.Set(NAN_D, 1, 0, INF_D);
  r.Correct();
  CHECK(r);
  r.Round(2);
  CHECK(read<Quaterniond>("0.1 0.2 0.3"));
}

TEST(Math, poses)
{
  CHECK(A + B);
  CHECK(A - B);
  CHECK(A * B);
  CHECK(-A);
  CHECK(A.Inverse());
  CHECK(A * A.Inverse());
  CHECK(A.CoordPositionAdd(a));
  CHECK(A.CoordPositionAdd(B));
  CHECK(A.CoordPositionSub(B));
  CHECK(A.CoordRotationAdd(q));
  CHECK(A.CoordRotationSub(q));
  CHECK(A.CoordPoseSolve(B));
  CHECK(A.RotatePositionAboutOrigin(q));
  CHECK(Pose3d(1, 2, 3, 0.5, 0.5, 0.5, 0.5));
  CHECK(A.X() + A.Y() + A.Z() + A.Roll() + A.Pitch() + A.Yaw());
  CHECK(A == B);
  CHECK(A != A + Pose3d(0, 0, 0.0001, 0, 0, 0));
  Pose3d pose = A;
  pose += B;
  pose -= A;
  pose *= B;
  CHECK(pose);
  pose.Round(2);
  CHECK(pose);
  pose.Set(a, Vector3d(0.1, 0.2, 0.3));
  CHECK(pose);
  CHECK(shown(A));
  CHECK(shown(Pose3d::Zero));
  CHECK(read<Pose3d>("1 2 3 0.1 -0.2 0.3"));
}

TEST(Math, matrices)
{
  const Matrix3d m(1, 2, 3, -4, 5, 6, 7, 8.5, -9), n(p);
  CHECK(m * n);
  CHECK(m + n);
  CHECK(m - n);
  CHECK(m * 2.0);
  CHECK(m * a);
  CHECK(a * m);
  CHECK(m.Determinant());
  CHECK(m.Inverse());
  CHECK(m.Transposed());
  CHECK(Matrix3d(raw));
  CHECK(m == m * 1.0000001);
  CHECK(m(5, 5));
  CHECK(shown(m));
  Matrix3d k;
  k.Axis(a.Normalized(), 0.8);
  CHECK(k);
  k.Axes(a, b, c);
  CHECK(k);
  for (const Vector3d& to : { b, a * 3, -a })
  {
    k.From2Axes(a, to);
    CHECK(k);
  }
  k.Col(1, c);
  CHECK(k);
  const Matrix4d f(A), g(2, 1, 0, 3, 4, -5, 6, 7, 8, 9, 1, 2, 3, 5, 7, 11);
  CHECK(f * g);
  CHECK(f * a);
  CHECK(g.Determinant());
  CHECK(g.Inverse());
  CHECK(g.Transposed());
  CHECK(f.Translation());
  CHECK(f.Rotation());
  CHECK(f.Pose());
  CHECK(f.EulerRotation(true));
  CHECK(f.EulerRotation(false));
  CHECK(g.Scale());
  CHECK(f.IsAffine() + 2 * g.IsAffine());
  CHECK(Matrix4d(raw));
  CHECK(Matrix4d(up).EulerRotation(true));
  Matrix4d h = Matrix4d::Identity;
  h.Scale(2, 3, 4);
  h.SetTranslation(a);
  CHECK(h);
  h = n;
  CHECK(h);
  CHECK(Matrix4d::LookAt(a, b));
  CHECK(Matrix4d::LookAt(a, b, c));
  CHECK(Matrix4d::LookAt(a, a));
  CHECK(Matrix4d::LookAt(Vector3d::Zero, Vector3d::UnitZ));
  CHECK(shown(f));
}
