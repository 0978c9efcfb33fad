// What both faces of execution (TrajectoryExecutionManager in C++, move_group's in Python) hold of trajectories and controllers.
// Source: what MoveIt 1's trajectory_execution_manager.cpp and plan_execution.cpp do. Angles in rad, lengths in m, times in s.
// Nothing is kept and no node is needed: any thread may call these.
#pragma once

#include <moveit_msgs/RobotTrajectory.h>

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "motion/robot_state.hpp"

namespace execution
{
using Joints = std::set<std::string>;

struct Controller
{
  std::string name;
  Joints joints;
  bool active = false;     // takes trajectories now
  bool preferred = false;  // "default" in its manager's list
};

// ---------------------------------------------------------------- trajectories

// One line about the first point that cannot be executed; empty when there is none. Each point needs a finite position, and where it
// gives any a finite velocity, acceleration and effort, for each joint, or a transform for each multi-DOF joint, and comes after the
// one before. A joint that the robot lacks is a fault as well.
std::string fault(const moveit_msgs::RobotTrajectory& trajectory, const motion::RobotModel& robot);

// It has no point, or ends as it starts, now.
bool takesNoTime(const moveit_msgs::RobotTrajectory& trajectory);

// The time of its last point after its start.
double duration(const moveit_msgs::RobotTrajectory& trajectory);

// How long a controller may take for its share: from now to the last point, times `scaling`, and `margin`.
double allowedDuration(const moveit_msgs::RobotTrajectory& share, const ros::Time& now, double scaling, double margin);

// ---------------------------------------------------------------- controllers

// Those that need a controller: of the robot, not fixed, passive or mimic.
Joints actuated(const std::vector<std::string>& joints, const motion::RobotModel& robot);

// Names of the controllers that together move `wanted`, none of them a joint twice; empty if none do. As few as possible; of those with
// more preferred ones, fewer joints, more active ones, by name. Where this node may not switch controllers (`manage`), what is active
// already goes before, even if there are more of them.
std::vector<std::string> choose(const Joints& wanted, std::vector<Controller> controllers, bool manage);

// The part of a trajectory that moves `joints`, which come in alphabetical order; velocities times `scaling`.
moveit_msgs::RobotTrajectory share(const moveit_msgs::RobotTrajectory& whole, const Joints& joints, double scaling);

// ---------------------------------------------------------------- where the robot is

// How far a joint may be from a trajectory's first point. 0: it is not looked at.
struct StartTolerance
{
  double all = 0.0;
  std::map<std::string, double> joints;  // those with their own

  double of(const std::string& joint) const;
  bool any() const;
};

// One line about the first joint that is not where a trajectory starts; empty when there is none. Single joints are compared within
// their bounds, continuous ones over the shorter way; multi-DOF joints by each coordinate and by the angle between.
std::string startDeviation(const moveit_msgs::RobotTrajectory& share, const motion::RobotState& now,
                           const StartTolerance& tolerance);

// Has a joint moved by more than its tolerance times `part` from one state to the next?
bool moved(const std::vector<std::string>& joints, const motion::RobotState& before, const motion::RobotState& now,
           const StartTolerance& tolerance, double part);

// ---------------------------------------------------------------- plans

// Codes (MoveItErrorCodes) after which another plan may do better, and those of them after which one waits before it.
bool mayPlanAgain(int code);
bool waitsBeforePlanning(int code);

// The trajectory from whose end the continuous joints of trajectory `index` go on: the last one before it of the same group, else the
// last; -1: there is none, they go on from where the robot is. `groups`: each one's, none where there is no trajectory or no point.
int goesOnFrom(const std::vector<std::optional<std::string>>& groups, std::size_t index);

// ---------------------------------------------------------------- what is left of a path

// The first of a trajectory's way points, from the one before `expected` on, that is not `valid`; -1: there is none. Each is looked at
// with the bodies that are attached in the state `now`: what was attached since the plan was made counts, what was put down does not.
int firstInvalid(std::size_t way_points, int expected, const std::function<motion::RobotState(std::size_t)>& way_point,
                 const motion::RobotState& now, const std::function<bool(const motion::RobotState&)>& valid);
}  // namespace execution
