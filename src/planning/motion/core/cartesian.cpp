#include "motion/cartesian.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "motion/ik.hpp"

namespace motion
{
namespace
{
constexpr int MIN_STEPS_FOR_JUMPS = 10;  // fewer say nothing of the mean
constexpr double TURN_PER_METRE = 3.5;   // rad of a step for each metre of its longest way, as upstream: 2 degrees for 1 cm
constexpr std::size_t MOST_STEPS = 200000;
constexpr int ATTEMPTS = 6;
constexpr double BESIDE = 0.02, NEAR = 0.5;  // rad or m
constexpr int HALVINGS = 5;                  // of a step that is too long for the joints' values to be found from the last ones

class Line
{
public:
  Line(const PlanningScene& scene, const RobotState& start, const CartesianRequest& request, const ConstraintSet& constraints)
    : group_(scene.model()->group(request.group))
    , request_(request)
    , constraints_(constraints)
    , solver_(scene.model(), group_)
    , free_(scene, start, request.group)
    , state_(start)
    , candidate_(start)
  {
    frame_.link = start.frameLink(request.link, frame_.pose);
    if (frame_.link < 0)
      throwUnknown("link", request.link, "robot '" + scene.model()->name + "'", scene.model()->linkNames());
  }

  CartesianPath run()
  {
    keep();
    const std::size_t count = request_.waypoints.size();
    path_.fraction = count ? 0.0 : 1.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double part = follow(request_.waypoints[i]);
      path_.fraction = (static_cast<double>(i) + part) / static_cast<double>(count);
      if (part < 1.0)
        break;
    }
    cutJumps();
    return path_;
  }

private:
  void keep()
  {
    std::vector<double> values(group_.size());
    state_.getGroup(group_, values.data());
    path_.points.push_back(std::move(values));
  }

  // Share of the line to `goal` that could be followed.
  double follow(const Transform& goal)
  {
    const Transform from = frame_.at(state_);
    const double length = (goal.translation() - from.translation()).norm();
    const double turn = Quaternion(from.linear()).angularDistance(Quaternion(goal.linear()));
    const double wanted =
        std::floor(std::max(length, request_.position_only ? 0.0 : turn / TURN_PER_METRE) / request_.max_step) + 1;
    if (!(wanted < MOST_STEPS))
      throw InvalidInput("a Cartesian path of " + std::to_string(length) + " m and " + std::to_string(turn) +
                         " rad in steps of " + std::to_string(request_.max_step) + " m: that is too many steps");
    const bool jumps = request_.jump_threshold > 0 || request_.prismatic_jump > 0 || request_.revolute_jump > 0;
    const int steps = std::max(static_cast<int>(wanted), jumps ? MIN_STEPS_FOR_JUMPS : 1);
    for (int i = 1; i <= steps; ++i)
    {
      const RobotState before = state_;
      if (!reach(between(from, goal, static_cast<double>(i) / steps), HALVINGS))
      {
        state_ = before;
        return static_cast<double>(i - 1) / steps;
      }
      keep();
    }
    return 1.0;
  }

  static Transform between(const Transform& from, const Transform& to, double t)
  {
    Transform pose = Transform::Identity();
    pose.translation() = (1 - t) * from.translation() + t * to.translation();
    pose.linear() = Quaternion(from.linear()).slerp(t, Quaternion(to.linear())).toRotationMatrix();
    return pose;
  }

  // Near a stretched arm a centimetre is a long way for the elbow: it is gone in smaller steps then.
  bool reach(const Transform& pose, int halvings)
  {
    const Transform from = frame_.at(state_);
    if (step(pose))
      return true;
    if (halvings == 0 || !reach(between(from, pose, 0.5), halvings - 1) || !reach(pose, halvings - 1))
      return false;
    path_.message.clear();
    return true;
  }

  bool step(const Transform& pose)
  {
    IkOptions options;
    options.timeout = std::max(request_.timeout, 0.05);
    options.max_restarts = request_.timeout > 0 ? -1 : 0;
    options.random_seed = path_.points.size();
    std::string why;
    bool turned = false;
    options.valid = [&](const double* values) {
      why = turnedOver(values);
      turned = !why.empty();
      if (turned)
        return false;
      candidate_.setGroup(group_, values);
      if (!constraints_.empty())
        why = constraints_.problem(candidate_);
      if (why.empty() && request_.avoid_collisions && !free_(candidate_))
        why = "the robot would collide";
      return why.empty();
    };
    const IkTarget target{frame_.link, pose * frame_.pose.inverse(), true, !request_.position_only};
    IkResult found = solver_.solve(state_, {target}, options);
    if (found.solutions.empty() && turned)  // arms with joints to spare may have another way
    {
      options.consistency.assign(group_.size(), 0.99 * M_PI);
      const std::string limit = why;
      found = solver_.solve(state_, {target}, options);
      if (why.empty())
        why = limit;
    }
    else if (found.solutions.empty() && why.empty())
      found = fromBeside(target, options);
    if (found.solutions.empty())
    {
      path_.message = why.empty() ? "no joint values bring '" + request_.link + "' further along the line" : why;
      return false;
    }
    state_.setGroup(group_, found.solutions[0].data());
    return true;
  }

  // Beyond a limit the same pose may be had by turning a joint all the way back, which is no step along a line.
  std::string turnedOver(const double* values) const
  {
    const double* from = values;
    for (const int j : group_.active_joints)
    {
      const JointModel& joint = state_.model()->joints[j];
      const double apart = std::abs(*from - state_.joint(joint)[0]);
      if (joint.type == JointType::Revolute && !joint.continuous && apart > M_PI)
        return "the line leads joint '" + joint.name + "' beyond its limit";
      from += joint.variable_count;
    }
    return "";
  }

  // A stretched arm has no slope to follow inwards. From values beside the last ones there is one; what it leads to still has
  // to be near them.
  IkResult fromBeside(const IkTarget& target, IkOptions options)
  {
    std::mt19937 random(static_cast<unsigned>(path_.points.size()));
    std::uniform_real_distribution<double> little(-BESIDE, BESIDE);
    std::vector<double> last(group_.size()), values;
    state_.getGroup(group_, last.data());
    const auto valid = options.valid;
    options.valid = [&](const double* found) {
      for (std::size_t i = 0; i < last.size(); ++i)
        if (std::abs(found[i] - last[i]) > NEAR)
          return false;
      return valid(found);
    };
    IkResult result;
    for (int attempt = 0; attempt < ATTEMPTS && result.solutions.empty(); ++attempt)
    {
      values = last;
      for (double& value : values)
        value += little(random);
      RobotState beside(state_);
      beside.setGroup(group_, values.data());
      result = solver_.solve(beside, {target}, options);
    }
    return result;
  }

  // Ends the path before the first step that is too large in joint space.
  void cutJumps()
  {
    const std::size_t steps = path_.points.size() - 1;
    if (steps == 0)
      return;
    std::vector<double> distances;
    double sum = 0;
    for (std::size_t i = 0; i < steps; ++i)
    {
      state_.setGroup(group_, path_.points[i].data());
      candidate_.setGroup(group_, path_.points[i + 1].data());
      distances.push_back(state_.distance(candidate_, &group_));
      sum += distances.back();
    }
    const double most = request_.jump_threshold > 0 ? request_.jump_threshold * sum / static_cast<double>(steps)
                                                    : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < steps; ++i)
      if ((steps + 1 >= MIN_STEPS_FOR_JUMPS && distances[i] > most) || jointJumps(i))
      {
        path_.message = "a joint jumps at step " + std::to_string(i + 1) + " of the line";
        path_.fraction *= static_cast<double>(i) / static_cast<double>(steps);
        path_.points.resize(i + 1);
        return;
      }
  }

  bool jointJumps(std::size_t i) const
  {
    const auto& model = *state_.model();
    for (std::size_t j = 0; j < group_.active_joints.size(); ++j)
    {
      const JointModel& joint = model.joints[group_.active_joints[j]];
      const double most = joint.type == JointType::Prismatic ? request_.prismatic_jump : request_.revolute_jump;
      if (most > 0 && joint.distance(&path_.points[i][j], &path_.points[i + 1][j]) > most)
        return true;
    }
    return false;
  }

  const JointModelGroup& group_;
  const CartesianRequest& request_;
  const ConstraintSet& constraints_;
  IkSolver solver_;
  CollisionFree free_;
  RobotState state_, candidate_;
  ConstraintSet::Frame frame_;
  CartesianPath path_;
};
}  // namespace

CartesianPath cartesianPath(const PlanningScene& scene, const RobotState& start, const CartesianRequest& request,
                            const ConstraintSet& constraints)
{
  if (!(request.max_step > 1e-9))
    throw InvalidInput("the step of a Cartesian path must be above 0 m");
  return Line(scene, start, request, constraints).run();
}
}  // namespace motion
