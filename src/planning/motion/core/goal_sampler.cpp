#include "goal_sampler.hpp"

#include <algorithm>

namespace motion
{
namespace
{
double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

constexpr int RESTARTS = 40;  // of one inverse kinematics problem
constexpr int BUDGET = 4000;  // restarts altogether before a goal counts as not to be met
}  // namespace

GoalSampler::GoalSampler(const PlanningScene& scene, const RobotState& start, const JointModelGroup& group,
                         const Constraints& goal, const ConstraintSet& path, const CollisionFree& free)
  : model_(scene.model())
  , start_(start)
  , group_(group)
  , goal_(scene, goal)
  , path_(path)
  , free_(free)
{
}

bool GoalSampler::good(const RobotState& state)
{
  ++refusals_.reached;
  if (!state.satisfiesBounds(&group_, 1e-9))
    return ++refusals_.out_of_bounds, false;
  if (!goal_.satisfied(state))
    return ++refusals_.goal, false;
  if (!path_.satisfied(state))
    return ++refusals_.path, false;
  if (!free_(state))
  {
    if (!refusals_.colliding++)
    {
      refusals_.example.resize(group_.size());
      state.getGroup(group_, refusals_.example.data());
    }
    return false;
  }
  return true;
}

void GoalSampler::keep(const RobotState& state)
{
  std::vector<double> values(group_.size());
  state.getGroup(group_, values.data());
  for (const auto& other : found_)
  {
    double apart = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      apart = std::max(apart, std::abs(values[i] - other[i]));
    if (apart < 1e-6)
      return;
  }
  found_.push_back(std::move(values));
}

bool GoalSampler::allJointsConstrained() const
{
  return std::all_of(group_.variables.begin(), group_.variables.end(), [&](int variable) {
    return std::any_of(goal_.joints.begin(), goal_.joints.end(), [&](const auto& c) { return c.variable == variable; });
  });
}

std::vector<std::vector<double>> GoalSampler::sample(std::size_t wanted, Random& random, const std::function<bool()>& stop)
{
  found_.clear();
  if (goal_.positions.empty() && goal_.orientations.empty() && allJointsConstrained())
    sampleJoints(wanted, random, stop);
  else
  {
    // Inverse kinematics knows nothing of constraints on joints.
    if (goal_.joints.empty())
      samplePoses(wanted, random, stop);
    if (found_.empty() && !stop())
      sampleByProjection(wanted, random, stop);
  }
  return found_;
}

void GoalSampler::sampleJoints(std::size_t wanted, Random& random, const std::function<bool()>& stop)
{
  RobotState state(start_);
  double widest = 0;
  for (const auto& c : goal_.joints)
    widest = std::max({widest, c.above, c.below});
  // Within tolerances as tight as usual all samples are one goal.
  const std::size_t enough = widest < 0.01 ? 1 : wanted;
  const int attempts = widest < 1e-9 ? 1 : widest < 0.01 ? 50 : 1000;
  for (int attempt = 0; attempt < attempts && found_.size() < enough && !(attempt % 16 == 15 && stop()); ++attempt)
  {
    for (const auto& c : goal_.joints)
    {
      const VariableBounds& b = model_->bounds[c.variable];
      double low = c.position - c.below, high = c.position + c.above;
      if (!c.continuous && b.has_position)
      {
        low = std::max(low, b.min_position);
        high = std::min(high, b.max_position);
      }
      const double value = attempt == 0 ? std::min(std::max(c.position, low), high) : low + (high - low) * uniform(random);
      state.setVariable(c.variable, c.continuous ? wrapAngle(value) : value);
    }
    if (good(state))
      keep(state);
  }
}

// Poses of links inside their regions; false if inverse kinematics cannot be asked for them.
bool GoalSampler::makeTargets(bool centre, Random& random, std::vector<IkTarget>& targets) const
{
  targets.clear();
  auto target = [&](const ConstraintSet::Frame& link) -> IkTarget& {
    for (IkTarget& t : targets)
      if (t.link == link.link)
        return t;
    targets.push_back({link.link, Transform::Identity(), false, false});
    return targets.back();
  };
  for (const auto& c : goal_.orientations)
  {
    if (c.frame.link >= 0 && group_.link_updated[c.frame.link])
      return false;
    const Eigen::Matrix3d frame = c.frame.at(start_).linear();
    Vector3 angles = Vector3::Zero();
    if (!centre)
      for (int i = 0; i < 3; ++i)
        angles[i] = (2 * uniform(random) - 1) * std::min(c.tolerance[i], M_PI);
    const Eigen::Matrix3d turned =
        frame * c.wanted *
        (c.rotation_vector && angles.norm() > 1e-12
             ? Eigen::AngleAxisd(angles.norm(), angles.normalized()).toRotationMatrix()
             : (Eigen::AngleAxisd(angles[0], Vector3::UnitX()) * Eigen::AngleAxisd(angles[1], Vector3::UnitY()) *
                Eigen::AngleAxisd(angles[2], Vector3::UnitZ()))
                   .toRotationMatrix());
    IkTarget& t = target(c.link);
    if (t.orientation)
      return false;
    t.orientation = true;
    t.pose.linear() = turned * c.link.pose.linear().transpose();
  }
  for (const auto& c : goal_.positions)
  {
    if (c.frame.link >= 0 && group_.link_updated[c.frame.link])
      return false;
    const std::size_t which =
        centre ? 0 : std::min<std::size_t>(c.shapes.size() - 1, static_cast<std::size_t>(uniform(random) * c.shapes.size()));
    Vector3 point = Vector3::Zero(), half;
    localBounds(*c.shapes[which], point, half);
    if (!centre && !sampleInside(
                       *c.shapes[which], [&]() { return uniform(random); }, point))
      return false;
    IkTarget& t = target(c.link);
    const Vector3 offset = c.link.pose.translation();
    if (t.position || (!t.orientation && offset.norm() > 1e-9))
      return false;
    t.position = true;
    t.pose.translation() = c.frame.at(start_) * c.poses[which] * point - t.pose.linear() * offset;
  }
  return !targets.empty() && std::all_of(targets.begin(), targets.end(),
                                         [&](const IkTarget& t) { return t.link >= 0 && group_.link_updated[t.link]; });
}

void GoalSampler::samplePoses(std::size_t wanted, Random& random, const std::function<bool()>& stop)
{
  if (!group_.single_variable_joints || group_.variables.empty())
    return;
  const IkSolver solver(model_, group_);
  std::vector<IkTarget> targets;
  RobotState state(start_);
  IkOptions options;
  options.timeout = 0.2;  // a net: the number of restarts ends it, so that seeded runs repeat
  options.max_restarts = RESTARTS;
  options.valid = [&](const double* values) {
    state.setGroup(group_, values);
    return good(state);
  };
  int spent = 0;
  for (int attempt = 0; found_.size() < wanted && spent < BUDGET && !stop(); ++attempt)
  {
    if (!makeTargets(attempt == 0, random, targets))
      return;
    options.solutions = wanted - found_.size();
    options.random_seed = random();
    const IkResult result = solver.solve(start_, targets, options);
    spent += result.restarts + 1;
    for (const auto& values : result.solutions)
    {
      state.setGroup(group_, values.data());
      keep(state);
    }
    if (!found_.empty() && attempt >= 4)
      return;  // some families are enough
  }
}

// Whatever the constraints are: random states brought to them.
void GoalSampler::sampleByProjection(std::size_t wanted, Random& random, const std::function<bool()>& stop)
{
  RobotState state(start_);
  for (int attempt = 0; attempt < 1000 && found_.size() < wanted && !stop(); ++attempt)
  {
    if (attempt == 0)
      state = start_;
    else
      state.randomize(&group_, random);
    const bool reached = goal_.projectable() ? goal_.project(state, group_) : true;
    if (reached && good(state))
      keep(state);
  }
}
}  // namespace motion
