#include "motion/constraints.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdio>

#include "checker.hpp"

namespace motion
{
namespace
{
constexpr double SLACK = 1e-9;

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Angles a, b, c with R = Rx(a) Ry(b) Rz(c): the smaller of the two ways to say it.
Vector3 intrinsicXyz(const Eigen::Matrix3d& R)
{
  const double b = std::asin(std::min(1.0, std::max(-1.0, R(0, 2))));
  if (std::abs(R(0, 2)) > 1.0 - 1e-12)  // a and c turn about one axis
    return Vector3(std::atan2(R(1, 0), R(1, 1)), b, 0.0);
  return Vector3(std::atan2(-R(1, 2), R(2, 2)), b, std::atan2(-R(0, 1), R(0, 0)));
}

Vector3 otherXyz(const Vector3& angles)
{
  return Vector3(wrapAngle(angles[0] + M_PI), wrapAngle(M_PI - angles[1]), wrapAngle(angles[2] + M_PI));
}

Eigen::Matrix3d fromXyz(const Vector3& angles)
{
  return (Eigen::AngleAxisd(angles[0], Vector3::UnitX()) * Eigen::AngleAxisd(angles[1], Vector3::UnitY()) *
          Eigen::AngleAxisd(angles[2], Vector3::UnitZ()))
      .toRotationMatrix();
}

Vector3 excess(const Vector3& error, const Vector3& tolerance) { return (error.cwiseAbs() - tolerance).cwiseMax(0.0); }

// The deviation in the constraint's own terms; of two ways to say it, the one that breaks it less.
Vector3 deviation(const ConstraintSet::Orientation& c, const Eigen::Matrix3d& frame, const Eigen::Matrix3d& actual)
{
  const Eigen::Matrix3d difference = (frame * c.wanted).transpose() * actual;
  if (c.rotation_vector)
    return rotationVector(difference);
  const Vector3 one = intrinsicXyz(difference), two = otherXyz(one);
  return excess(one, c.tolerance).norm() <= excess(two, c.tolerance).norm() ? one : two;
}

Vector3 nearestInside(const Shape& shape, const Vector3& p, double share)
{
  switch (shape.type)
  {
    case ShapeType::Box: {
      const Vector3 half = 0.5 * share * static_cast<const Box&>(shape).size;
      return p.cwiseMax(-half).cwiseMin(half);
    }
    case ShapeType::Sphere: {
      const double radius = share * static_cast<const Sphere&>(shape).radius, length = p.norm();
      return length <= radius ? p : Vector3(p * (radius / length));
    }
    case ShapeType::Cylinder: {
      const auto& cylinder = static_cast<const Cylinder&>(shape);
      const double radius = share * cylinder.radius, half = 0.5 * share * cylinder.length, length = p.head<2>().norm();
      Vector3 out = p;
      if (length > radius)
        out.head<2>() *= radius / length;
      out.z() = std::min(std::max(p.z(), -half), half);
      return out;
    }
    case ShapeType::Plane: {
      const auto& plane = static_cast<const Plane&>(shape);
      const double above = plane.normal.dot(p) + plane.d;
      return above <= 0 ? p : Vector3(p - plane.normal * (above / plane.normal.squaredNorm()));
    }
    default: {
      Vector3 centre, half;
      localBounds(shape, centre, half);
      return contains(shape, p) ? p : centre;
    }
  }
}
}  // namespace

Eigen::Matrix3d nearestAllowed(const ConstraintSet::Orientation& c, const Eigen::Matrix3d& frame, const Eigen::Matrix3d& actual,
                               double share)
{
  const Vector3 tolerance = share * c.tolerance;
  const Vector3 angles = deviation(c, frame, actual).cwiseMax(-tolerance).cwiseMin(tolerance);
  if (!c.rotation_vector)
    return frame * c.wanted * fromXyz(angles);
  const double angle = angles.norm();
  return frame * c.wanted *
         (angle < 1e-12 ? Eigen::Matrix3d::Identity() : Eigen::AngleAxisd(angle, angles / angle).toRotationMatrix());
}

// ---------------------------------------------------------------- looking up

ConstraintSet::Frame ConstraintSet::link(const PlanningScene& scene, const std::string& name, const std::string& of) const
{
  Frame frame;
  frame.link = scene.state().frameLink(name, frame.pose);
  if (frame.link < 0)
    throwUnknown("link", name, of, scene.model()->linkNames());
  return frame;
}

ConstraintSet::Frame ConstraintSet::frame(const PlanningScene& scene, const std::string& given, const std::string& of) const
{
  const std::string name = !given.empty() && given[0] == '/' ? given.substr(1) : given;
  Frame frame;
  if (name.empty() || name == scene.frame())
    return frame;
  frame.link = scene.state().frameLink(name, frame.pose);
  if (frame.link < 0 && !scene.framePose(name, scene.state(), frame.pose))
    throwUnknown("frame", name, of, scene.frameNames());
  return frame;
}

namespace
{
// As upstream has it: angles of continuous joints count within a turn, and what lies beyond a limit as a whole means the limit.
ConstraintSet::Joint jointOf(const RobotModel& model, const JointConstraint& c)
{
  int variable = model.findVariable(c.joint);
  if (variable < 0)
  {
    const JointModel& joint = model.joint(c.joint);
    throw InvalidInput("joint constraint on '" + c.joint + "': the joint is " + joint.typeName() +
                       (joint.variable_count ? "; name one of its variables: " + listed(joint.variables) : " and cannot move"));
  }
  if (!std::isfinite(c.position) || !(c.above >= 0) || !(c.below >= 0))
    throw InvalidInput("joint constraint on '" + c.joint + "': the position must be finite and the tolerances 0 or more");
  const JointModel& joint = model.joints[model.variable_joint[variable]];
  const bool turns = joint.continuous || (joint.type == JointType::Planar && variable == joint.first_variable + 2);
  ConstraintSet::Joint out{variable, turns, turns ? wrapAngle(c.position) : c.position, c.above, c.below};
  const VariableBounds& b = model.bounds[variable];
  if (!turns && b.has_position)
  {
    if (out.position - out.below > b.max_position)
      out.position = b.max_position, out.below = 0;
    else if (out.position + out.above < b.min_position)
      out.position = b.min_position, out.above = 0;
  }
  return out;
}

}  // namespace

ConstraintSet::ConstraintSet(const PlanningScene& scene, const Constraints& constraints) : model_(scene.model())
{
  for (const JointConstraint& c : constraints.joint)
    joints.push_back(jointOf(*model_, c));
  for (const PositionConstraint& c : constraints.position)
  {
    const std::string of = "the position constraint of robot '" + model_->name + "'";
    if (c.shapes.empty())
      throw InvalidInput("position constraint on '" + c.link + "': it has no region");
    Position out{link(scene, c.link, of), frame(scene, c.frame, of), c.offset, c.shapes, c.poses, c.link};
    if (!c.offset.allFinite())
      throw InvalidInput("position constraint on '" + c.link + "': the offset is not finite");
    out.link.pose = out.link.pose * Eigen::Translation3d(c.offset);
    out.poses.resize(c.shapes.size(), Transform::Identity());
    positions.push_back(out);
  }
  for (const OrientationConstraint& c : constraints.orientation)
  {
    const std::string of = "the orientation constraint of robot '" + model_->name + "'";
    if (!c.orientation.coeffs().allFinite() || !c.tolerance.allFinite())
      throw InvalidInput("orientation constraint on '" + c.link + "': the quaternion or a tolerance is not finite");
    // As upstream: what is no rotation is taken as none.
    const bool rotation = std::abs(c.orientation.norm() - 1.0) < 1e-3;
    orientations.push_back({link(scene, c.link, of), frame(scene, c.frame, of),
                            rotation ? c.orientation.normalized().toRotationMatrix() : Eigen::Matrix3d::Identity(),
                            c.tolerance.cwiseAbs(), c.rotation_vector, c.link});
  }
  for (const VisibilityConstraint& c : constraints.visibility)
  {
    const std::string of = "the visibility constraint of robot '" + model_->name + "'";
    Sight sight{c, frame(scene, c.target_frame, of), frame(scene, c.sensor_frame, of)};
    sight.target.pose = sight.target.pose * c.target_pose;
    sight.sensor.pose = sight.sensor.pose * c.sensor_pose;
    sight.given.cone_sides = std::max(3, std::min(c.cone_sides, 64));
    sights_.push_back(sight);
  }
}

// ---------------------------------------------------------------- checks

ConstraintResult ConstraintSet::check(const RobotState& state, const Joint& c) const
{
  const double value = state.positions()[c.variable];
  const double off = c.continuous ? wrapAngle(value - c.position) : value - c.position;
  ConstraintResult result{off <= c.above + SLACK && off >= -c.below - SLACK, std::abs(off), ""};
  if (!result.satisfied)
    result.description = "joint '" + model_->variables[c.variable] + "' is at " + number(value) + ", not within " +
                         number(c.position - c.below) + " to " + number(c.position + c.above);
  return result;
}

ConstraintResult ConstraintSet::check(const RobotState& state, const Position& c) const
{
  const Vector3 point = c.link.at(state).translation();
  const Transform frame = c.frame.at(state);
  ConstraintResult result{false, std::numeric_limits<double>::infinity(), ""};
  for (std::size_t i = 0; i < c.shapes.size(); ++i)
  {
    const Transform pose = frame * c.poses[i];
    const Vector3 inside = pose.inverse() * point;
    Vector3 centre = Vector3::Zero(), half;
    localBounds(*c.shapes[i], centre, half);
    result.distance = std::min(result.distance, (inside - centre).norm());
    result.satisfied = result.satisfied || contains(*c.shapes[i], inside) ||
                       (nearestInside(*c.shapes[i], inside, 1.0) - inside).norm() < SLACK;
  }
  if (!result.satisfied)
    result.description = "link '" + c.name + "' is " + number(result.distance) + " m from the middle of its region";
  return result;
}

ConstraintResult ConstraintSet::check(const RobotState& state, const Orientation& c) const
{
  const Vector3 off = deviation(c, c.frame.at(state).linear(), c.link.at(state).linear());
  ConstraintResult result{(off.cwiseAbs() - c.tolerance).maxCoeff() <= SLACK, off.norm(), ""};
  if (!result.satisfied)
    result.description = "link '" + c.name + "' is turned by (" + number(off[0]) + ", " + number(off[1]) + ", " +
                         number(off[2]) + ") rad from what is wanted";
  return result;
}

ConstraintResult ConstraintSet::check(const RobotState& state, const Sight& c) const
{
  const Transform target = c.target.at(state), sensor = c.sensor.at(state);
  const int axis = c.given.sensor_view - 'x';
  const Vector3 view = sensor.linear().col(axis), normal = target.linear().col(2);
  if (c.given.max_view_angle > 0)
  {
    const double angle = std::acos(std::min(1.0, std::max(-1.0, -normal.dot(view))));
    if (angle > c.given.max_view_angle)
      return {false, angle, "the sensor looks at the target at " + number(angle) + " rad from its normal"};
  }
  const Vector3 way = target.translation() - sensor.translation();
  if (c.given.max_range_angle > 0)
  {
    const double angle = std::acos(std::min(1.0, std::max(-1.0, way.normalized().dot(view))));
    if (angle > c.given.max_range_angle)
      return {false, angle, "the target is " + number(angle) + " rad off the sensor's axis"};
  }
  if (c.given.target_radius <= 0)
    return {true, 0, ""};
  // The cone from the sensor to the target's disc must be free of the robot.
  std::vector<Vector3> vertices{sensor.translation(), target.translation()};
  std::vector<Eigen::Vector3i> triangles;
  const int n = c.given.cone_sides;
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2 * M_PI * i / n;
    vertices.push_back(target * Vector3(c.given.target_radius * std::cos(angle), c.given.target_radius * std::sin(angle), 0));
    triangles.emplace_back(0, 2 + i, 2 + (i + 1) % n);
    triangles.emplace_back(1, 2 + (i + 1) % n, 2 + i);
  }
  PlanningScene scene(model_);
  WorldObject cone;
  cone.id = "the sight";
  cone.shapes = {std::make_shared<Mesh>(vertices, triangles)};
  scene.addObject(cone);
  CollisionRequest request;
  request.contacts = 1;
  request.self = false;
  // What carries the sensor or the target is not in its own way.
  AllowedCollisionMatrix acm;
  for (int link : {c.sensor.link, c.target.link})
    if (link >= 0)
      acm.setEntry(cone.id, model_->links[link].name, AllowedCollisionMatrix::Allowed);
  const CollisionResult hit = scene.check(state, request, &acm);
  if (!hit.collision)
    return {true, 0, ""};
  return {false, hit.contacts.empty() ? 0 : hit.contacts[0].depth,
          "'" + (hit.contacts.empty() ? std::string("the robot") : hit.contacts[0].body_1) +
              "' is between the sensor and the target"};
}

bool ConstraintSet::satisfied(const RobotState& state) const
{
  auto all = [&](const auto& list) {
    return std::all_of(list.begin(), list.end(), [&](const auto& c) { return check(state, c).satisfied; });
  };
  return all(joints) && all(positions) && all(orientations) && all(sights_);
}

std::vector<ConstraintResult> ConstraintSet::evaluate(const RobotState& state) const
{
  std::vector<ConstraintResult> results;
  auto all = [&](const auto& list) {
    for (const auto& c : list)
      results.push_back(check(state, c));
  };
  all(joints);
  all(positions);
  all(orientations);
  all(sights_);
  return results;
}

std::string ConstraintSet::problem(const RobotState& state) const
{
  for (const ConstraintResult& result : evaluate(state))
    if (!result.satisfied)
      return result.description;
  return "";
}

// ---------------------------------------------------------------- projection

namespace
{
constexpr double SHARE = 0.9;  // a little inside the tolerance, so that what comes near is in

// Normal equations of what the constraints on links want of a group's joints.
struct Wishes
{
  Wishes(RobotState& state, const JointModelGroup& group)
    : state(state)
    , group(group)
    , gradient(group.size())
    , normal(group.size(), group.size())
  {
  }

  void clear()
  {
    squared = 0;
    normal.setZero();
    gradient.setZero();
  }

  // Wants link's point moved by d, or the link turned by it (model frame).
  void add(int link, const Vector3& point, const Vector3& d, bool turn)
  {
    squared += d.squaredNorm();
    if (d.squaredNorm() < 1e-20 || link < 0)
      return;
    Jacobian J = state.jacobian(group, link, point);
    if (group.base_link >= 0)
    {
      const Eigen::Matrix3d R = state.linkPose(group.base_link).linear();
      J.topRows<3>() = R * J.topRows<3>();
      J.bottomRows<3>() = R * J.bottomRows<3>();
    }
    const auto rows = turn ? J.bottomRows<3>() : J.topRows<3>();
    normal.noalias() += rows.transpose() * rows;
    gradient.noalias() += rows.transpose() * d;
  }

  Eigen::VectorXd step()
  {
    normal.diagonal().array() += 0.5 * squared + 1e-9;
    return normal.ldlt().solve(gradient);
  }

  RobotState& state;
  const JointModelGroup& group;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd normal;
  double squared = 0;
};

void comply(RobotState& state, const RobotModel& model, const std::vector<ConstraintSet::Joint>& joints)
{
  for (const ConstraintSet::Joint& c : joints)
  {
    const double off =
        c.continuous ? wrapAngle(state.positions()[c.variable] - c.position) : state.positions()[c.variable] - c.position;
    double low = -c.below, high = c.above;
    const VariableBounds& b = model.bounds[c.variable];
    if (!c.continuous && b.has_position)
      low = std::max(low, b.min_position - c.position), high = std::min(high, b.max_position - c.position);
    if (low <= off && off <= high)
      continue;
    const double middle = std::min(std::max(0.0, low), high);
    const double inside = std::min(std::max(off, middle + SHARE * (low - middle)), middle + SHARE * (high - middle));
    state.setVariable(c.variable, c.continuous ? wrapAngle(c.position + inside) : c.position + inside);
  }
}
}  // namespace

bool ConstraintSet::project(RobotState& state, const JointModelGroup& group, int iterations) const
{
  const int n = static_cast<int>(group.size());
  Eigen::VectorXd q(n);
  Wishes wishes(state, group);
  comply(state, *model_, joints);
  auto locked = [&](int variable) {
    return std::any_of(joints.begin(), joints.end(), [&](const Joint& c) { return c.variable == variable; });
  };
  for (int i = 0; i < iterations; ++i)
  {
    bool inside = true;
    wishes.clear();
    auto want = [&](const Frame& link, const Vector3& d, bool turn) {
      wishes.add(link.link, link.pose.translation(), d, turn);
    };
    for (const Position& c : positions)
    {
      if (check(state, c).satisfied)
        continue;
      inside = false;
      const Vector3 point = c.link.at(state).translation();
      Vector3 best = Vector3::Constant(1e9);
      for (std::size_t k = 0; k < c.shapes.size(); ++k)
      {
        const Transform pose = c.frame.at(state) * c.poses[k];
        const Vector3 move = pose * nearestInside(*c.shapes[k], pose.inverse() * point, SHARE) - point;
        if (move.norm() < best.norm())
          best = move;
      }
      want(c.link, best, false);
    }
    for (const Orientation& c : orientations)
    {
      if (check(state, c).satisfied)
        continue;
      inside = false;
      const Eigen::Matrix3d actual = c.link.at(state).linear();
      want(c.link, rotationVector(nearestAllowed(c, c.frame.at(state).linear(), actual, SHARE) * actual.transpose()), true);
    }
    if (inside)
      return state.satisfiesBounds(&group, SLACK);
    state.getGroup(group, q.data());
    const Eigen::VectorXd dq = wishes.step();
    for (int j = 0; j < n; ++j)
    {
      if (locked(group.variables[j]))
        continue;
      q[j] += std::min(std::max(dq[j], -0.5), 0.5);
      const VariableBounds& b = model_->bounds[group.variables[j]];
      if (b.has_position)
        q[j] = std::min(std::max(q[j], b.min_position), b.max_position);
    }
    state.setGroup(group, q.data());
    state.normalizeContinuous(&group);
  }
  return false;
}
}  // namespace motion
