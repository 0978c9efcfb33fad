// What both faces of execution hold of trajectories and controllers.
#include "execution.hpp"

#include <moveit_msgs/MoveItErrorCodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <tuple>

namespace execution
{
namespace
{
using Codes = moveit_msgs::MoveItErrorCodes;
using JointPoints = std::vector<trajectory_msgs::JointTrajectoryPoint>;
using MultiPoints = std::vector<trajectory_msgs::MultiDOFJointTrajectoryPoint>;

__attribute__((format(printf, 1, 2))) std::string text(const char* format, ...)
{
  std::array<char, 512> line;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  return line.data();
}

bool finite(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

std::vector<double> numbers(const geometry_msgs::Transform& t)
{
  return { t.translation.x, t.translation.y, t.translation.z, t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w };
}

std::string wrongCount(std::size_t point, std::size_t count, const char* what, std::size_t joints)
{
  return text("Wrong trajectory: point %zu has %zu %s for %zu joints", point, count, what, joints);
}

std::string notFinite(std::size_t point)
{
  return text("Wrong trajectory: point %zu holds a number that is not finite", point);
}

std::string faultOf(std::size_t number, const trajectory_msgs::JointTrajectoryPoint& point, std::size_t joints)
{
  const std::pair<const char*, const std::vector<double>*> fields[] = { { "positions", &point.positions },
                                                                        { "velocities", &point.velocities },
                                                                        { "accelerations", &point.accelerations },
                                                                        { "effort", &point.effort } };
  for (const auto& [what, values] : fields)
  {
    if (values->empty() && values != &point.positions)
      continue;
    if (values->size() != joints)
      return wrongCount(number, values->size(), what, joints);
    if (!finite(*values))
      return notFinite(number);
  }
  return "";
}

std::string faultOf(std::size_t number, const trajectory_msgs::MultiDOFJointTrajectoryPoint& point, std::size_t joints)
{
  if (point.transforms.size() != joints)
    return wrongCount(number, point.transforms.size(), "transforms", joints);
  for (const auto& transform : point.transforms)
    if (!finite(numbers(transform)))
      return notFinite(number);
  return "";
}

template <typename Trajectory>
std::string faultOfPoints(const Trajectory& trajectory)
{
  ros::Duration before(-1.0);
  for (std::size_t i = 0; i < trajectory.points.size(); ++i)
  {
    const std::string fault = faultOf(i, trajectory.points[i], trajectory.joint_names.size());
    if (!fault.empty())
      return fault;
    const ros::Duration now = trajectory.points[i].time_from_start;
    if (now <= before)
      return text("Wrong trajectory: point %zu comes at %g s, not after the one before", i, now.toSec());
    before = now;
  }
  return "";
}

template <typename Trajectory>
double lastTime(const Trajectory& trajectory)
{
  return trajectory.points.empty() ? 0.0 : trajectory.points.back().time_from_start.toSec();
}

template <typename Trajectory>
std::vector<std::size_t> columnsOf(const Trajectory& trajectory, const Joints& joints)
{
  std::vector<std::size_t> columns;
  for (const std::string& joint : joints)
  {
    const auto found = std::find(trajectory.joint_names.begin(), trajectory.joint_names.end(), joint);
    if (found != trajectory.joint_names.end())
      columns.push_back(found - trajectory.joint_names.begin());
  }
  return columns;
}

template <typename Value>
std::vector<Value> picked(const std::vector<Value>& values, const std::vector<std::size_t>& columns)
{
  std::vector<Value> some;
  for (const std::size_t column : columns)
    if (column < values.size())
      some.push_back(values[column]);
  return some;
}

trajectory_msgs::JointTrajectoryPoint pointOf(const trajectory_msgs::JointTrajectoryPoint& whole,
                                              const std::vector<std::size_t>& columns, double scaling)
{
  trajectory_msgs::JointTrajectoryPoint point;
  point.positions = picked(whole.positions, columns);
  point.velocities = picked(whole.velocities, columns);
  for (double& velocity : point.velocities)
    velocity *= scaling;
  point.accelerations = picked(whole.accelerations, columns);
  point.effort = picked(whole.effort, columns);
  point.time_from_start = whole.time_from_start;
  return point;
}

trajectory_msgs::MultiDOFJointTrajectoryPoint pointOf(const trajectory_msgs::MultiDOFJointTrajectoryPoint& whole,
                                                      const std::vector<std::size_t>& columns, double)
{
  trajectory_msgs::MultiDOFJointTrajectoryPoint point;
  point.transforms = picked(whole.transforms, columns);
  point.time_from_start = whole.time_from_start;
  return point;
}

template <typename Trajectory>
Trajectory shareOf(const Trajectory& whole, const Joints& joints, double scaling)
{
  Trajectory part;
  const std::vector<std::size_t> columns = columnsOf(whole, joints);
  if (columns.empty())
    return part;
  part.header = whole.header;
  part.joint_names = picked(whole.joint_names, columns);
  for (const auto& point : whole.points)
    part.points.push_back(pointOf(point, columns, scaling));
  return part;
}

// ---------------------------------------------------------------- controllers

bool intersects(const Joints& a, const Joints& b)
{
  return std::any_of(a.begin(), a.end(), [&b](const std::string& joint) { return b.count(joint) > 0; });
}

using Option = std::vector<const Controller*>;  // by name

// Controllers that share joints, if only through others. What one of these groups does is nothing to the rest.
std::vector<Option> connected(const std::vector<Controller>& controllers)
{
  std::vector<std::pair<Option, Joints>> groups;
  for (const Controller& controller : controllers)
  {
    std::pair<Option, Joints> mine({ &controller }, controller.joints);
    std::vector<std::pair<Option, Joints>> others;
    for (auto& group : groups)
      if (intersects(group.second, controller.joints))
      {
        mine.first.insert(mine.first.end(), group.first.begin(), group.first.end());
        mine.second.insert(group.second.begin(), group.second.end());
      }
      else
        others.push_back(std::move(group));
    others.push_back(std::move(mine));
    groups = std::move(others);
  }
  std::vector<Option> result;
  for (auto& group : groups)
  {
    std::sort(group.first.begin(), group.first.end(),
              [](const Controller* a, const Controller* b) { return a->name < b->name; });
    result.push_back(group.first);
  }
  return result;
}

// Smaller is better.
auto rankOf(const Option& option)
{
  int preferred = 0, active = 0;
  std::size_t joints = 0;
  std::vector<std::string> names;
  for (const Controller* controller : option)
  {
    preferred += controller->preferred;
    active += controller->active;
    joints += controller->joints.size();
    names.push_back(controller->name);
  }
  std::sort(names.begin(), names.end());
  return std::make_tuple(option.size(), -preferred, joints, -active, names);
}

// The best set of `useful` that moves all of `wanted`, none of them a joint twice; empty: there is none.
class BestOption
{
public:
  BestOption(const Option& useful, const Joints& wanted) : useful_(useful), wanted_(wanted) { extend({}, {}); }
  const Option& best() const { return best_; }

private:
  void extend(const Option& option, const Joints& covered)
  {
    if (!best_.empty() && option.size() > best_.size())
      return;
    const auto next =
        std::find_if(wanted_.begin(), wanted_.end(), [&covered](const std::string& joint) { return !covered.count(joint); });
    if (next == wanted_.end())
    {
      if (best_.empty() || rankOf(option) < rankOf(best_))
        best_ = option;
      return;
    }
    for (const Controller* controller : useful_)
      if (controller->joints.count(*next) && !intersects(controller->joints, covered))
      {
        Option longer = option;
        longer.push_back(controller);
        Joints more = covered;
        more.insert(controller->joints.begin(), controller->joints.end());
        extend(longer, more);
      }
  }

  const Option& useful_;
  const Joints& wanted_;
  Option best_;
};

// Empty: some of `wanted` has nobody.
Option bestOf(const std::vector<Option>& groups, const Joints& wanted, bool active_only)
{
  Option all;
  Joints left = wanted;
  for (const Option& group : groups)
  {
    Option useful;
    Joints own;
    for (const Controller* controller : group)
      for (const std::string& joint : controller->joints)
        if (wanted.count(joint))
          own.insert(joint);
    std::copy_if(group.begin(), group.end(), std::back_inserter(useful),
                 [active_only](const Controller* controller) { return !active_only || controller->active; });
    const Option best = BestOption(useful, own).best();
    all.insert(all.end(), best.begin(), best.end());
    if (!best.empty())
      for (const std::string& joint : own)
        left.erase(joint);
  }
  return left.empty() ? all : Option();
}

// ---------------------------------------------------------------- where the robot is

std::string deviation(const std::string& joint, double off, const char* unit, double allowed, const std::string& values)
{
  return text(
      "Invalid Trajectory: start point deviates from current robot state more than %g: joint '%s' is %.4f%s off%s. "
      "Plan again from where the robot is now",
      allowed, joint.c_str(), off, unit, values.c_str());
}

std::string deviationOf(const motion::JointModel& joint, double expected, const motion::RobotState& now, double allowed)
{
  double wanted = expected, current = *now.joint(joint);
  joint.enforceBounds(&wanted);
  joint.enforceBounds(&current);
  const double off = joint.distance(&wanted, &current);
  if (off <= allowed)
    return "";
  return deviation(joint.name, off, "", allowed, text(" (expected: %g, current: %g)", expected, *now.joint(joint)));
}

std::string deviationOf(const motion::JointModel& joint, const geometry_msgs::Transform& expected,
                        const motion::RobotState& now, double allowed)
{
  const auto& q = expected.rotation;
  const Eigen::Quaterniond wanted = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
  const motion::Transform current = joint.origin.inverse() * joint.transform(now.joint(joint));
  const auto& t = expected.translation;
  const double off = (current.translation() - motion::Vector3(t.x, t.y, t.z)).cwiseAbs().maxCoeff();
  if (!(off <= allowed))
    return deviation(joint.name, off, " m", allowed, "");
  const double angle = wanted.angularDistance(Eigen::Quaterniond(current.linear()));
  return angle <= allowed ? "" : deviation(joint.name, angle, " rad", allowed, "");
}
}  // namespace

// ---------------------------------------------------------------- trajectories

std::string fault(const moveit_msgs::RobotTrajectory& trajectory, const motion::RobotModel& robot)
{
  for (const auto* names : { &trajectory.joint_trajectory.joint_names, &trajectory.multi_dof_joint_trajectory.joint_names })
    for (const std::string& name : *names)
      if (!robot.findJoint(name))
        return text("the trajectory moves joint '%s', which the robot '%s' does not have", name.c_str(), robot.name.c_str());
  const std::string fault = faultOfPoints(trajectory.joint_trajectory);
  return fault.empty() ? faultOfPoints(trajectory.multi_dof_joint_trajectory) : fault;
}

bool takesNoTime(const moveit_msgs::RobotTrajectory& trajectory)
{
  const auto& joints = trajectory.joint_trajectory;
  const auto& multi = trajectory.multi_dof_joint_trajectory;
  if (joints.points.empty() && multi.points.empty())
    return true;
  return joints.header.stamp.isZero() && multi.header.stamp.isZero() && duration(trajectory) == 0.0;
}

double duration(const moveit_msgs::RobotTrajectory& trajectory)
{
  return std::max(lastTime(trajectory.joint_trajectory), lastTime(trajectory.multi_dof_joint_trajectory));
}

double allowedDuration(const moveit_msgs::RobotTrajectory& share, const ros::Time& now, double scaling, double margin)
{
  const auto delay = [&now](const std_msgs::Header& header) { return std::max(0.0, (header.stamp - now).toSec()); };
  const auto& joints = share.joint_trajectory;
  const auto& multi = share.multi_dof_joint_trajectory;
  const double longest =
      std::max(delay(joints.header) + lastTime(joints), multi.points.empty() ? 0.0 : delay(multi.header) + lastTime(multi));
  return longest * scaling + margin;
}

// ---------------------------------------------------------------- controllers

Joints actuated(const std::vector<std::string>& joints, const motion::RobotModel& robot)
{
  Joints wanted;
  for (const std::string& name : joints)
    if (const motion::JointModel* joint = robot.findJoint(name))
      if (joint->active() && !joint->passive)
        wanted.insert(name);
  return wanted;
}

std::vector<std::string> choose(const Joints& wanted, std::vector<Controller> controllers, bool manage)
{
  controllers.erase(std::remove_if(controllers.begin(), controllers.end(),
                                   [&wanted](const Controller& controller) { return !intersects(controller.joints, wanted); }),
                    controllers.end());
  const std::vector<Option> groups = connected(controllers);
  Option best;
  if (!manage)
    best = bestOf(groups, wanted, true);
  if (best.empty())
    best = bestOf(groups, wanted, false);
  std::vector<std::string> names;
  for (const Controller* controller : best)
    names.push_back(controller->name);
  std::sort(names.begin(), names.end());
  return names;
}

moveit_msgs::RobotTrajectory share(const moveit_msgs::RobotTrajectory& whole, const Joints& joints, double scaling)
{
  moveit_msgs::RobotTrajectory part;
  part.joint_trajectory = shareOf(whole.joint_trajectory, joints, scaling);
  part.multi_dof_joint_trajectory = shareOf(whole.multi_dof_joint_trajectory, joints, scaling);
  return part;
}

// ---------------------------------------------------------------- where the robot is

double StartTolerance::of(const std::string& joint) const
{
  const auto own = joints.find(joint);
  return own == joints.end() ? all : own->second;
}

bool StartTolerance::any() const
{
  return all > 0.0 || std::any_of(joints.begin(), joints.end(), [](const auto& own) { return own.second > 0.0; });
}

std::string startDeviation(const moveit_msgs::RobotTrajectory& share, const motion::RobotState& now,
                           const StartTolerance& tolerance)
{
  const auto first = [&](const auto& trajectory, const auto& values_of, bool single) -> std::string {
    if (trajectory.points.empty())
      return "";
    const auto& values = values_of(trajectory.points.front());
    for (std::size_t i = 0; i < std::min(trajectory.joint_names.size(), values.size()); ++i)
    {
      const motion::JointModel* joint = now.model()->findJoint(trajectory.joint_names[i]);
      const double allowed = tolerance.of(trajectory.joint_names[i]);
      if (!joint || !(allowed > 0.0) || joint->singleVariable() != single)
        continue;
      const std::string line = deviationOf(*joint, values[i], now, allowed);
      if (!line.empty())
        return line;
    }
    return "";
  };
  const std::string line = first(
      share.joint_trajectory, [](const auto& point) -> const auto& { return point.positions; }, true);
  if (!line.empty())
    return line;
  return first(
      share.multi_dof_joint_trajectory, [](const auto& point) -> const auto& { return point.transforms; }, false);
}

bool moved(const std::vector<std::string>& joints, const motion::RobotState& before, const motion::RobotState& now,
           const StartTolerance& tolerance, double part)
{
  return std::any_of(joints.begin(), joints.end(), [&](const std::string& name) {
    const motion::JointModel* joint = now.model()->findJoint(name);
    const double allowed = tolerance.of(name);
    return joint && joint->singleVariable() && allowed > 0.0 &&
           std::abs(*now.joint(*joint) - *before.joint(*joint)) > part * allowed;
  });
}

// ---------------------------------------------------------------- plans

bool mayPlanAgain(int code)
{
  return code == Codes::PLANNING_FAILED || code == Codes::INVALID_MOTION_PLAN || waitsBeforePlanning(code);
}

bool waitsBeforePlanning(int code)
{
  return code == Codes::UNABLE_TO_AQUIRE_SENSOR_DATA || code == Codes::MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE;
}

int goesOnFrom(const std::vector<std::optional<std::string>>& groups, std::size_t index)
{
  int last = -1;
  bool same = false;
  for (std::size_t i = 0; i < std::min(index, groups.size()); ++i)
    if (groups[i] && (!same || groups[i] == groups[index]))
    {
      last = static_cast<int>(i);
      same = groups[i] == groups[index];
    }
  return last;
}

// ---------------------------------------------------------------- what is left of a path

int firstInvalid(std::size_t way_points, int expected, const std::function<motion::RobotState(std::size_t)>& way_point,
                 const motion::RobotState& now, const std::function<bool(const motion::RobotState&)>& valid)
{
  for (std::size_t i = std::max(expected - 1, 0); i < way_points; ++i)
  {
    motion::RobotState state = way_point(i);
    state.clearAttached();
    for (const auto& body : now.attached())
      state.attach(body.second);
    if (!valid(state))
      return static_cast<int>(i);
  }
  return -1;
}
}  // namespace execution
