#include "motion/ik.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>

namespace motion
{
namespace
{
constexpr int MAX_SIZE = 64;
using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, MAX_SIZE>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, MAX_SIZE, MAX_SIZE>;
using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, MAX_SIZE, 1>;
using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); }
}  // namespace

// A joint that the solver moves: the constant way to it, turned so that the joint's axis is z.
struct IkSolver::Step
{
  Transform before;
  bool prismatic;
  int column;
  double factor, offset;
};

struct IkSolver::Chain
{
  std::vector<Step> steps;
  Transform after;
  Transform goal;
  bool position, orientation;
};

void demandIk(const RobotModel& model, const JointModelGroup& group)
{
  if (!group.single_variable_joints)
    for (int j : group.active_joints)
      if (!model.joints[j].singleVariable())
        throw InvalidInput("group '" + group.name + "': inverse kinematics needs joints with one variable, but '" +
                           model.joints[j].name + "' is " + model.joints[j].typeName());
  if (group.variables.empty())
    throw InvalidInput("group '" + group.name + "' has no joint that moves: there is no inverse kinematics");
  if (group.variables.size() > MAX_SIZE)
    throw InvalidInput("group '" + group.name + "' has " + std::to_string(group.variables.size()) +
                       " joints: inverse kinematics takes up to " + std::to_string(MAX_SIZE));
}

IkSolver::IkSolver(RobotModelPtr model, const JointModelGroup& group) : model_(std::move(model)), group_(group)
{
  demandIk(*model_, group_);
  column_of_joint_.assign(model_->joints.size(), -1);
  for (std::size_t i = 0; i < group_.active_joints.size(); ++i)
  {
    const JointModel& joint = model_->joints[group_.active_joints[i]];
    const VariableBounds& b = joint.bounds[0];
    column_of_joint_[joint.index] = static_cast<int>(i);
    const bool revolute = joint.type == JointType::Revolute;
    const bool whole_turn = joint.continuous || !b.has_position || b.max_position - b.min_position >= 2 * M_PI;
    turns_.push_back(revolute && whole_turn && joint.mimicked_by.empty());
    prismatic_.push_back(!revolute);
    lower_.push_back(b.has_position ? b.min_position : revolute ? -M_PI : -1e3);
    upper_.push_back(b.has_position ? b.max_position : revolute ? M_PI : 1e3);
  }
}

std::vector<IkSolver::Chain> IkSolver::chains(const RobotState& seed, const std::vector<IkTarget>& targets) const
{
  std::vector<Chain> out;
  for (const IkTarget& target : targets)
  {
    std::vector<int> way;
    for (int link = target.link; link >= 0; link = model_->links[link].parent_link)
      way.push_back(model_->links[link].parent_joint);
    std::reverse(way.begin(), way.end());
    Chain chain;
    Transform constant = Transform::Identity();
    for (int j : way)
    {
      const JointModel& joint = model_->joints[j];
      const bool follows = joint.mimic >= 0;
      const int column = column_of_joint_[follows ? joint.mimic : j];
      if (column < 0)
      {
        constant = constant * joint.transform(seed.joint(joint));
        continue;
      }
      const Eigen::Matrix3d to_axis = turnBetween(Vector3::UnitZ(), joint.axis).toRotationMatrix();
      Step step;
      step.before = constant * joint.origin;
      step.before.linear() = step.before.linear() * to_axis;
      step.prismatic = joint.type == JointType::Prismatic;
      step.column = column;
      step.factor = follows ? joint.mimic_factor : 1.0;
      step.offset = follows ? joint.mimic_offset : 0.0;
      chain.steps.push_back(step);
      constant.setIdentity();
      constant.linear() = to_axis.transpose();
    }
    if (chain.steps.empty())
      throw InvalidInput("group '" + group_.name + "' does not move link '" + model_->links[target.link].name +
                         "': there is no inverse kinematics for it");
    chain.after = constant;
    chain.goal = target.pose;
    chain.position = target.position;
    chain.orientation = target.orientation;
    out.push_back(std::move(chain));
  }
  return out;
}

namespace
{
// Levenberg-Marquardt whose damping is the error itself (Sugihara 2011): robust far away, quadratic near by. Joints at a
// limit that the step would break are held and the step is solved again for the others.
class Descent
{
public:
  Descent(const std::vector<IkSolver::Chain>& chains, const std::vector<double>& lower, const std::vector<double>& upper,
          const std::vector<char>& turns)
    : chains_(chains)
    , lower_(lower)
    , upper_(upper)
    , turns_(turns)
    , n_(static_cast<int>(lower.size()))
  {
  }

  double squared_error = 0;
  int iterations = 0;

  // Improves `q`; true when the error fell below the tolerance.
  bool run(Values& q, double tolerance, int most)
  {
    const double goal = tolerance * tolerance;
    double checkpoint = std::numeric_limits<double>::infinity();
    for (int i = 0;; ++i)
    {
      linearise(q);
      if (squared_error <= goal)
        return true;
      if (i == most)
        return false;
      if (i % 6 == 5)
      {
        if (squared_error > 0.25 * checkpoint)
          return false;  // stuck: another start is cheaper
        checkpoint = squared_error;
      }
      ++iterations;
      step(q);
    }
  }

private:
  void linearise(const Values& q)
  {
    normal_.setZero(n_, n_);
    gradient_.setZero(n_);
    squared_error = 0;
    for (const IkSolver::Chain& chain : chains_)
      add(chain, q);
  }

  void add(const IkSolver::Chain& chain, const Values& q)
  {
    const int count = static_cast<int>(chain.steps.size());
    axes_.resize(6, count);
    origins_.resize(6, count);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Vector3 p = Vector3::Zero();
    for (int i = 0; i < count; ++i)
    {
      const IkSolver::Step& s = chain.steps[i];
      p.noalias() += R * s.before.translation();
      R = (R * s.before.linear()).eval();
      const double value = s.factor * q[s.column] + s.offset;
      axes_.block<3, 1>(0, i) = R.col(2);
      if (s.prismatic)
        p += value * R.col(2);
      else
      {
        const double c = std::cos(value), sn = std::sin(value);
        const Vector3 x = R.col(0);
        R.col(0) = c * x + sn * R.col(1);
        R.col(1) = c * R.col(1) - sn * x;
      }
      origins_.block<3, 1>(0, i) = p;
    }
    p.noalias() += R * chain.after.translation();
    R = (R * chain.after.linear()).eval();
    Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
    if (chain.position)
      error.head<3>() = chain.goal.translation() - p;
    if (chain.orientation)
      error.tail<3>() = rotationVector(chain.goal.linear() * R.transpose());
    squared_error += error.squaredNorm();
    J_.setZero(6, n_);
    for (int i = 0; i < count; ++i)
    {
      const IkSolver::Step& s = chain.steps[i];
      const Vector3 axis = s.factor * axes_.block<3, 1>(0, i);
      if (s.prismatic)
      {
        if (chain.position)
          J_.block<3, 1>(0, s.column) += axis;
        continue;
      }
      if (chain.position)
        J_.block<3, 1>(0, s.column) += axis.cross(p - origins_.block<3, 1>(0, i));
      if (chain.orientation)
        J_.block<3, 1>(3, s.column) += axis;
    }
    normal_.noalias() += J_.transpose() * J_;
    gradient_.noalias() += J_.transpose() * error;
  }

  void step(Values& q)
  {
    const double damping = 0.5 * squared_error + 1e-10;
    normal_.diagonal().array() += damping;
    for (int round = 0; round < 4; ++round)
    {
      const Values dq = normal_.ldlt().solve(gradient_);
      bool held = false;
      for (int j = 0; j < n_; ++j)
      {
        if (turns_[j] || gradient_[j] == 0.0)
          continue;
        if ((q[j] <= lower_[j] && dq[j] < 0) || (q[j] >= upper_[j] && dq[j] > 0))
        {
          normal_.row(j).setZero();
          normal_.col(j).setZero();
          normal_(j, j) = 1;
          gradient_[j] = 0;
          held = true;
        }
      }
      if (held && round < 3)
        continue;
      for (int j = 0; j < n_; ++j)
      {
        q[j] += std::min(std::max(dq[j], -1.5), 1.5);
        if (!turns_[j])
          q[j] = std::min(std::max(q[j], lower_[j]), upper_[j]);
      }
      return;
    }
  }

  const std::vector<IkSolver::Chain>& chains_;
  const std::vector<double>&lower_, &upper_;
  const std::vector<char>& turns_;
  const int n_;
  Columns J_, axes_, origins_;
  Square normal_;
  Values gradient_;
};

// Between which values a search may go, and which joints come round again after a turn.
struct Room
{
  std::vector<double> lower, upper;
  std::vector<char> turns, endless;
};

void checkSeed(const Values& seed, const JointModelGroup& group, const IkOptions& options)
{
  const std::size_t n = group.size();
  for (std::size_t j = 0; j < n; ++j)
    if (!std::isfinite(seed[j]))
      throw InvalidInput("the seed of the inverse kinematics is not finite at '" + group.variable_names[j] + "'");
  if (!options.consistency.empty() && options.consistency.size() != n)
    throw InvalidInput("consistency limits: " + std::to_string(options.consistency.size()) + " values for the " +
                       std::to_string(n) + " joints of group '" + group.name + "'");
}

// Not further from the seed than `consistency` allows.
void narrow(Room& room, const Values& seed, const std::vector<double>& consistency)
{
  for (std::size_t j = 0; j < consistency.size(); ++j)
  {
    const double low = seed[j] - consistency[j], high = seed[j] + consistency[j];
    if (high - low >= 2 * M_PI && room.turns[j])
      continue;
    const double lower = room.lower[j], upper = room.upper[j];
    room.lower[j] = room.endless[j] ? low : std::max(lower, low);
    room.upper[j] = room.endless[j] ? high : std::min(upper, high);
    if (room.lower[j] > room.upper[j])  // the seed is outside the limits by more than may be moved
      room.lower[j] = room.upper[j] = std::min(std::max(seed[j], lower), upper);
    room.turns[j] = 0;
  }
}

// Into the limits, by whole turns and near the seed; false if that cannot be.
bool settle(const Room& room, const Values& seed, const Values& q, std::vector<double>& candidate)
{
  for (std::size_t j = 0; j < candidate.size(); ++j)
  {
    double value = q[j];
    if (room.turns[j])
    {
      if (room.endless[j])
        value = wrapAngle(value);
      else
      {
        value = seed[j] + wrapAngle(value - seed[j]);
        while (value > room.upper[j])
          value -= 2 * M_PI;
        while (value < room.lower[j])
          value += 2 * M_PI;
        if (value > room.upper[j])
          return false;
      }
    }
    candidate[j] = value;
  }
  return true;
}

bool known(const Room& room, const std::vector<std::vector<double>>& solutions, const std::vector<double>& candidate)
{
  for (const auto& other : solutions)
  {
    double apart = 0;
    for (std::size_t j = 0; j < candidate.size(); ++j)
      apart = std::max(apart, std::abs(room.turns[j] ? wrapAngle(candidate[j] - other[j]) : candidate[j] - other[j]));
    if (apart < 0.02)
      return true;
  }
  return false;
}

void scatter(const Room& room, const std::vector<char>& prismatic, Random& random, Values& q)
{
  for (std::size_t j = 0; j < room.lower.size(); ++j)
  {
    const double reach = prismatic[j] && room.upper[j] - room.lower[j] > 100 ? 1.0 : 0.0;
    const double low = reach ? -reach : room.lower[j], high = reach ? reach : room.upper[j];
    q[j] = low + (high - low) * (static_cast<double>(random() >> 11) * 0x1.0p-53);
  }
}

void clip(const Room& room, Values& q)
{
  for (std::size_t j = 0; j < room.lower.size(); ++j)
    if (!room.turns[j])
      q[j] = std::min(std::max(q[j], room.lower[j]), room.upper[j]);
}

void nearestFirst(std::vector<std::vector<double>>& solutions, const Values& seed)
{
  auto away = [&](const std::vector<double>& values) {
    double sum = 0;
    for (std::size_t j = 0; j < values.size(); ++j)
      sum += std::abs(values[j] - seed[j]);
    return sum;
  };
  std::stable_sort(solutions.begin(), solutions.end(), [&](const auto& a, const auto& b) { return away(a) < away(b); });
}
}  // namespace

IkResult IkSolver::solve(const RobotState& state, const std::vector<IkTarget>& targets, const IkOptions& options) const
{
  const GroupSolver* other = model_->solver(group_.name);
  if (other && other->takes(targets))
    return other->solve(state, targets, options);
  const auto started = Clock::now();
  const int n = static_cast<int>(group_.size());
  Values seed(n), q(n), best(n);
  state.getGroup(group_, seed.data());
  checkSeed(seed, group_, options);
  Room room{lower_, upper_, turns_, {}};
  for (int j = 0; j < n; ++j)
    room.endless.push_back(model_->joints[group_.active_joints[j]].continuous);
  narrow(room, seed, options.consistency);

  const std::vector<Chain> ways = chains(state, targets);
  Descent descent(ways, room.lower, room.upper, room.turns);
  Random random(options.random_seed * 0x9E3779B97F4A7C15ull + 0x632BE59BD9B4E019ull);
  IkResult result;
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> candidate(n);
  for (int attempt = 0;; ++attempt)
  {
    if (attempt == 0)
      q = seed;
    else
      scatter(room, prismatic_, random, q);
    clip(room, q);
    if (descent.run(q, options.tolerance, 60))
    {
      if (settle(room, seed, q, candidate) && !known(room, result.solutions, candidate))
      {
        if (!options.valid || options.valid(candidate.data()))
          result.solutions.push_back(candidate);
        else
          ++result.rejected;
      }
    }
    else if (descent.squared_error < least && settle(room, seed, q, candidate))
    {
      least = descent.squared_error;
      best = Eigen::Map<const Eigen::VectorXd>(candidate.data(), n);
    }
    if (result.solutions.size() >= options.solutions || (options.max_restarts >= 0 && attempt >= options.max_restarts) ||
        seconds(started) >= options.timeout || (options.cancelled && *options.cancelled))
      break;
    ++result.restarts;
  }
  result.iterations = descent.iterations;
  result.error = result.solutions.empty() ? std::sqrt(least) : options.tolerance;
  if (result.solutions.empty() && options.return_approximate && std::isfinite(least))
  {
    result.approximate = true;
    result.solutions.emplace_back(best.data(), best.data() + n);
  }
  nearestFirst(result.solutions, seed);
  result.time = seconds(started);
  return result;
}
}  // namespace motion
