// Adapters that mend the state that a motion starts in.
#include <class_loader/class_loader.hpp>
#include <moveit/kinematic_constraints/kinematic_constraint.h>

#include <cmath>

#include "adapter.hpp"

namespace default_planner_request_adapters
{
using moveit::core::JointModel;
using moveit::core::RobotState;

namespace
{
const std::vector<const JointModel*>& jointsOf(const planning_scene::PlanningScene& scene, const std::string& group)
{
  const moveit::core::RobotModelConstPtr& model = scene.getRobotModel();
  return model->hasJointModelGroup(group) ? model->getJointModelGroup(group)->getJointModels() : model->getJointModels();
}

std::string valuesOf(const RobotState& state, const JointModel& joint)
{
  std::ostringstream text;
  for (std::size_t k = 0; k < joint.getVariableCount(); ++k)
    text << (k ? ", " : "") << state.getJointPositions(&joint)[k] << " (" << joint.getVariableBounds()[k].min_position_
         << " to " << joint.getVariableBounds()[k].max_position_ << ")";
  return text.str();
}
}  // namespace

// Joints that are a little outside their limits start at them; turns of continuous joints and angles are taken into (-pi, pi].
class FixStartStateBounds : public Adapter
{
public:
  void initialize(const ros::NodeHandle& nh) override
  {
    error_ = parameter(nh, "start_state_max_bounds_error", 0.05);
    most_ = parameter(nh, "start_state_max_dt", 0.5);
  }
  std::string getDescription() const override { return "Fix Start State Bounds"; }
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& added_path_index) const override
  {
    RobotState start = startOf(scene, req);
    bool changed = false, moved = false;
    for (const JointModel* joint : jointsOf(*scene, req.group_name))
      changed = turnBack(start, *joint) || changed;
    const RobotState true_start(start);
    for (const JointModel* joint : jointsOf(*scene, req.group_name))
      moved = putInside(start, *joint) || moved;
    if (!changed && !moved)
      return planner(scene, req, res);
    Request mended(req);
    moveit::core::robotStateToRobotStateMsg(start, mended.start_state);
    const bool solved = planner(scene, mended, res);
    if (moved)
      addStart(true_start, most_, res, added_path_index);
    return solved;
  }

private:
  static bool turnBack(RobotState& start, const JointModel& joint)
  {
    const bool turns = joint.getType() == JointModel::REVOLUTE && !joint.getVariableBounds()[0].position_bounded_;
    if (!turns && joint.getType() != JointModel::PLANAR && joint.getType() != JointModel::FLOATING)
      return false;
    const std::vector<double> before(start.getJointPositions(&joint),
                                     start.getJointPositions(&joint) + joint.getVariableCount());
    if (turns)
      start.enforceBounds(&joint);
    else if (joint.getType() == JointModel::PLANAR)
    {
      std::vector<double> values(before);
      values[2] = std::remainder(values[2], 2 * M_PI);
      start.setJointPositions(&joint, values);
    }
    else
    {
      std::vector<double> values(before);
      const double norm =
          std::sqrt(values[3] * values[3] + values[4] * values[4] + values[5] * values[5] + values[6] * values[6]);
      if (norm > 1e-9)
        for (int k = 3; k < 7; ++k)
          values[k] /= norm;
      start.setJointPositions(&joint, values);
    }
    for (std::size_t k = 0; k < before.size(); ++k)
      if (std::abs(before[k] - start.getJointPositions(&joint)[k]) > 1e-12)
        return true;
    return false;
  }

  bool putInside(RobotState& start, const JointModel& joint) const
  {
    if (joint.getVariableCount() == 0 || start.satisfiesBounds(&joint))
      return false;
    if (!start.satisfiesBounds(&joint, error_))
    {
      ROS_WARN(
          "Joint '%s' from the starting state is outside bounds by a significant margin: %s; the error is above the "
          "~start_state_max_bounds_error parameter (currently set to %g)",
          joint.getName().c_str(), valuesOf(start, joint).c_str(), error_);
      return false;
    }
    ROS_INFO("Starting state is just outside bounds (joint '%s'). Assuming within bounds.", joint.getName().c_str());
    start.enforceBounds(&joint);
    return true;
  }

  double error_ = 0.05, most_ = 0.5;
};

// A start in collision is moved a little, at random, until it touches nothing.
class FixStartStateCollision : public Adapter
{
public:
  void initialize(const ros::NodeHandle& nh) override
  {
    most_ = parameter(nh, "start_state_max_dt", 0.5);
    jiggle_ = parameter(nh, "jiggle_fraction", 0.02);
    attempts_ = std::max(1, static_cast<int>(parameter(nh, "max_sampling_attempts", 100)));
  }
  std::string getDescription() const override { return "Fix Start State In Collision"; }
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& added_path_index) const override
  {
    const RobotState start = startOf(scene, req);
    if (!touches(*scene, start, req.group_name))
      return planner(scene, req, res);
    RobotState near(start);
    if (!findNear(*scene, req.group_name, start, near))
    {
      ROS_WARN("Unable to find a valid state nearby the start state (using jiggle fraction of %lf and %d sampling attempts).",
               jiggle_, attempts_);
      scene->isStateColliding(start, req.group_name, true);  // says what touches
      res.error_code_.val = moveit_msgs::MoveItErrorCodes::START_STATE_IN_COLLISION;
      return false;
    }
    ROS_INFO("Found a valid state near the start state at distance %lf", start.distance(near));
    Request mended(req);
    moveit::core::robotStateToRobotStateMsg(near, mended.start_state);
    const bool solved = planner(scene, mended, res);
    if (solved)
      addStart(start, most_, res, added_path_index);
    return solved;
  }

private:
  static bool touches(const planning_scene::PlanningScene& scene, const RobotState& state, const std::string& group)
  {
    collision_detection::CollisionRequest request;
    collision_detection::CollisionResult result;
    request.group_name = group;
    scene.checkCollision(request, result, state);
    return result.collision;
  }

  bool findNear(const planning_scene::PlanningScene& scene, const std::string& group, const RobotState& start,
                RobotState& near) const
  {
    random_numbers::RandomNumberGenerator& random = near.getRandomNumberGenerator();
    for (int attempt = 0; attempt < attempts_; ++attempt)
      for (const JointModel* joint : jointsOf(scene, group))
      {
        if (joint->getVariableCount() == 0 || joint->getMimic())
          continue;
        std::vector<double> values(joint->getVariableCount());
        joint->getVariableRandomPositionsNearBy(random, values.data(), start.getJointPositions(joint),
                                                joint->getMaximumExtent() * jiggle_);
        near.setJointPositions(joint, values);
        if (!touches(scene, near, group))
          return true;
      }
    return false;
  }

  double most_ = 0.5, jiggle_ = 0.02;
  int attempts_ = 100;
};

// A start that breaks the path constraints is first moved to where they are kept.
class FixStartStatePathConstraints : public Adapter
{
public:
  std::string getDescription() const override { return "Fix Start State Path Constraints"; }
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& added_path_index) const override
  {
    const RobotState start = startOf(scene, req);
    if (scene->isStateValid(start, req.group_name) && !scene->isStateValid(start, req.path_constraints, req.group_name))
    {
      ROS_INFO("Path constraints not satisfied for start state...");
      scene->isStateConstrained(start, req.path_constraints, true);
      return planTwice(planner, scene, req, res, added_path_index);
    }
    return planner(scene, req, res);
  }

private:
  static bool planTwice(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                        std::vector<std::size_t>& added_path_index)
  {
    Request first(req);
    first.goal_constraints.assign(1, req.path_constraints);
    first.path_constraints = moveit_msgs::Constraints();
    Response there;
    std::vector<std::size_t> kept;
    kept.swap(added_path_index);  // what inner adapters add to the first way is no part of the answer
    const bool arrived = planner(scene, first, there);
    kept.swap(added_path_index);
    if (!arrived || !there.trajectory_ || there.trajectory_->empty())
    {
      ROS_WARN("Unable to plan to path constraints.");
      res.error_code_.val = moveit_msgs::MoveItErrorCodes::START_STATE_VIOLATES_PATH_CONSTRAINTS;
      res.planning_time_ = there.planning_time_;
      return false;
    }
    ROS_INFO("Planned to path constraints. Resuming original planning request.");
    Request second(req);
    moveit::core::robotStateToRobotStateMsg(there.trajectory_->getLastWayPoint(), second.start_state);
    const bool solved = planner(scene, second, res);
    res.planning_time_ += there.planning_time_;
    if (!solved || !res.trajectory_)
      return solved;
    const std::size_t before = there.trajectory_->getWayPointCount();
    for (std::size_t& index : added_path_index)
      index += before;
    for (std::size_t i = 0; i < before; ++i)
      added_path_index.push_back(i);
    there.trajectory_->append(*res.trajectory_, 0.0);
    there.trajectory_->swap(*res.trajectory_);
    return true;
  }
};
}  // namespace default_planner_request_adapters

CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::FixStartStateBounds,
                            planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::FixStartStateCollision,
                            planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::FixStartStatePathConstraints,
                            planning_request_adapter::PlanningRequestAdapter)
