#include "plugin_solver.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>

#include "motion/ik.hpp"

namespace kinematics_plugin_loader
{
namespace
{
using Clock = std::chrono::steady_clock;
constexpr double OTHER_ROBOT = 0.01;  // a pose error (m and rad together) that no calibration explains
constexpr int BARREN = 5;             // tries without a new solution after which there are no more

double seconds(Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); }

class PluginSolver : public motion::GroupSolver
{
public:
  PluginSolver(motion::RobotModel& robot, const urdf::ModelInterfaceSharedPtr& urdf_model,
               const srdf::ModelConstSharedPtr& srdf_model, const std::string& group, const SolverRequest& request)
    : robot_(robot)
    , group_(robot.group(group))
    , timeout_(request.timeout)
  {
    // The robot owns this solver: a pointer that counts would keep both for ever.
    const std::shared_ptr<motion::RobotModel> borrowed(std::shared_ptr<void>(), &robot);
    model_ = std::make_shared<moveit::core::RobotModel>(borrowed, urdf_model, srdf_model);
    solver_ = makeSolver(request, *model_->getJointModelGroup(group));
    if (solver_->getTipFrames().size() != 1)
      throw std::runtime_error("kinematics solver '" + request.plugin + "' wants several tips at once");
    tip_ = robot.rigidParent(robot.link(solver_->getTipFrame()).index, tip_in_parent_);
    base_ = solver_->getBaseFrame();
    // Which of the group's values is each of the solver's? It may know only some of them.
    for (const std::string& name : solver_->getJointNames())
    {
      const motion::JointModel* joint = robot.findJoint(name);
      if (!joint)
        throw std::runtime_error("kinematics solver '" + request.plugin + "' moves a joint '" + name +
                                 "', which the robot lacks");
      const auto found = std::find(group_.active_joints.begin(), group_.active_joints.end(), joint->index);
      if (found != group_.active_joints.end())
        place_.push_back(static_cast<int>(found - group_.active_joints.begin()));
      else if (joint->type != motion::JointType::Fixed)
        throw std::runtime_error("kinematics solver '" + request.plugin + "' moves joint '" + name +
                                 "', which is not in group '" + group + "'");
    }
    check(borrowed, request.plugin);
  }

  bool takes(const std::vector<motion::IkTarget>& targets) const override
  {
    motion::Transform unused;
    return targets.size() == 1 && targets[0].position && targets[0].orientation &&
           robot_.rigidParent(targets[0].link, unused) == tip_;
  }

  motion::IkResult solve(const motion::RobotState& seed, const std::vector<motion::IkTarget>& targets,
                         const motion::IkOptions& options) const override
  {
    const auto started = Clock::now();
    std::lock_guard<std::mutex> lock(one_at_a_time_);  // solvers keep scratch data
    Search search(*this, seed, options);
    motion::Transform target_in_parent, base = motion::Transform::Identity();
    robot_.rigidParent(targets[0].link, target_in_parent);
    seed.framePose(base_, base);
    search.target = targets[0];
    search.pose = tf2::toMsg(Eigen::Isometry3d(base.inverse() * targets[0].pose * target_in_parent.inverse() * tip_in_parent_));
    search.run(started);
    return search.result;
  }

private:
  struct Search
  {
    const PluginSolver& own;
    const motion::RobotState& seed;
    const motion::IkOptions& options;
    motion::IkTarget target;
    geometry_msgs::Pose pose;
    motion::IkResult result;
    std::vector<std::vector<double>> tried;

    Search(const PluginSolver& own, const motion::RobotState& seed, const motion::IkOptions& options)
      : own(own)
      , seed(seed)
      , options(options)
    {
    }

    std::vector<double> inGroup(const std::vector<double>& solution) const
    {
      std::vector<double> values(own.group_.size());
      seed.getGroup(own.group_, values.data());
      for (std::size_t i = 0; i < own.place_.size() && i < solution.size(); ++i)
        values[own.place_[i]] = solution[i];
      return values;
    }

    double error(const std::vector<double>& values) const
    {
      motion::RobotState state(seed);
      state.setGroup(own.group_, values.data());
      return motion::poseError(state.linkPose(target.link), target.pose).norm();
    }

    // Is it new, within the limits, where it should be, and good for the caller? A new one is kept.
    bool keep(const std::vector<double>& solution)
    {
      const std::vector<double> values = inGroup(solution);
      motion::RobotState state(seed);
      state.setGroup(own.group_, values.data());
      for (double value : values)
        if (!std::isfinite(value))
          return false;
      if (!state.satisfiesBounds(&own.group_, 1e-6))
        return false;
      for (const auto& other : tried)
      {
        double apart = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
          apart = std::max(apart, std::abs(values[i] - other[i]));
        if (apart < 0.02)
          return false;
      }
      tried.push_back(values);
      const double off = error(values);
      if (off > OTHER_ROBOT || (options.valid && !options.valid(values.data())))
      {
        ++result.rejected;
        return false;
      }
      result.solutions.push_back(values);
      result.error = std::max(result.error, off);
      return true;
    }

    bool ask(const std::vector<double>& from, const std::vector<double>& limits, double time)
    {
      bool kept = false;
      const kinematics::KinematicsBase::IKCallbackFn callback =
          [&](const geometry_msgs::Pose& /*pose*/, const std::vector<double>& solution, moveit_msgs::MoveItErrorCodes& code) {
            kept = keep(solution);
            code.val = kept ? moveit_msgs::MoveItErrorCodes::SUCCESS : moveit_msgs::MoveItErrorCodes::NO_IK_SOLUTION;
          };
      std::vector<double> solution;
      moveit_msgs::MoveItErrorCodes code;
      ++result.iterations;
      try
      {
        if (own.solver_->searchPositionIK({ pose }, from, time, limits, solution, callback, code) && !kept)
          kept = keep(solution);  // a solver that takes no notice of the callback
      }
      catch (const std::exception& thrown)
      {
        ROS_ERROR_THROTTLE(10.0, "the kinematics solver of group '%s' failed: %s", own.group_.name.c_str(), thrown.what());
      }
      return kept;
    }

    void run(Clock::time_point started)
    {
      motion::Random random(options.random_seed + 1);
      motion::RobotState from(seed);
      std::vector<double> values(own.group_.size()), limits;
      // Planning counts restarts and leaves it to kinematics.yaml how long one of them may take.
      const bool counted = options.max_restarts >= 0 && own.timeout_ > 0.0;
      const double most = counted ? std::max(options.timeout, own.timeout_) : options.timeout;
      if (options.consistency.size() == values.size())
        for (int place : own.place_)
          limits.push_back(options.consistency[place]);
      for (int barren = 0;;)
      {
        from.getGroup(own.group_, values.data());
        std::vector<double> start;
        for (int place : own.place_)
          start.push_back(values[place]);
        const double left = std::max(std::min(most - seconds(started), counted ? own.timeout_ : most), 1e-3);
        barren = ask(start, limits, left) ? 0 : barren + 1;
        if (result.solutions.size() >= options.solutions || (!result.solutions.empty() && barren >= BARREN) ||
            (options.max_restarts >= 0 && result.restarts >= options.max_restarts) || seconds(started) >= most ||
            (options.cancelled && *options.cancelled) || !limits.empty())
          break;
        ++result.restarts;
        from.randomize(&own.group_, random);
      }
      seed.getGroup(own.group_, values.data());
      auto away = [&values](const std::vector<double>& solution) {
        double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
          sum += std::abs(solution[i] - values[i]);
        return sum;
      };
      std::stable_sort(result.solutions.begin(), result.solutions.end(),
                       [&](const auto& a, const auto& b) { return away(a) < away(b); });
      result.time = seconds(started);
    }
  };

  // Poses that the robot surely reaches: where do the solver's answers take it?
  void check(const std::shared_ptr<motion::RobotModel>& robot, const std::string& plugin)
  {
    motion::Random random(1);
    motion::RobotState state(robot);
    const motion::IkOptions options;
    const int link = robot->link(solver_->getTipFrame()).index;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 10; ++i)
    {
      state.randomize(&group_, random);
      Search search(*this, state, options);
      search.target = { link, state.linkPose(link), true, true };
      motion::Transform base = motion::Transform::Identity();
      state.framePose(base_, base);
      std::vector<double> seed, solution;
      for (int place : place_)
        seed.push_back(state.positions()[group_.variables[place]]);
      moveit_msgs::MoveItErrorCodes code;
      if (solver_->searchPositionIK(tf2::toMsg(Eigen::Isometry3d(base.inverse() * search.target.pose)), seed, 0.1, solution,
                                    code))
        least = std::min(least, search.error(search.inGroup(solution)));
    }
    if (std::isfinite(least) && least > OTHER_ROBOT)
      throw std::runtime_error("kinematics solver '" + plugin + "' is made for another robot: its solutions for group '" +
                               group_.name + "' are " + std::to_string(least) + " off");
  }

  const motion::RobotModel& robot_;
  const motion::JointModelGroup& group_;
  moveit::core::RobotModelPtr model_;
  kinematics::KinematicsBasePtr solver_;
  motion::Transform tip_in_parent_;
  int tip_;
  std::string base_;
  std::vector<int> place_;
  double timeout_;  // s
  mutable std::mutex one_at_a_time_;
};

// Made by the first question.
class LateSolver : public motion::GroupSolver
{
public:
  LateSolver(std::function<std::unique_ptr<PluginSolver>()> make, const std::string& group)
    : make_(std::move(make))
    , group_(group)
  {
  }

  bool takes(const std::vector<motion::IkTarget>& targets) const override
  {
    std::call_once(once_, [this]() {
      try
      {
        made_ = make_();
      }
      catch (const std::exception& error)
      {
        ROS_WARN("The motion library's inverse kinematics plans for group '%s': %s", group_.c_str(), error.what());
      }
    });
    return made_ && made_->takes(targets);
  }

  motion::IkResult solve(const motion::RobotState& seed, const std::vector<motion::IkTarget>& targets,
                         const motion::IkOptions& options) const override
  {
    return made_->solve(seed, targets, options);
  }

private:
  std::function<std::unique_ptr<PluginSolver>()> make_;
  std::string group_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<PluginSolver> made_;
};
}  // namespace

void installSolver(const std::shared_ptr<motion::RobotModel>& robot, const std::string& urdf, const std::string& srdf,
                   const std::string& group, const SolverRequest& request)
{
  const auto urdf_model = std::make_shared<urdf::Model>();
  const auto srdf_model = std::make_shared<srdf::Model>();
  if (!urdf_model->initString(urdf) || !srdf_model->initString(*urdf_model, srdf))
    throw std::runtime_error("the robot's description cannot be read");
  robot->setSolver(group, std::make_shared<PluginSolver>(*robot, urdf_model, srdf_model, group, request));
}

void installSolverLate(const moveit::core::RobotModel& model, const std::string& group, const SolverRequest& request)
{
  motion::RobotModel& robot = *model.core();
  robot.setSolver(group, std::make_shared<LateSolver>(
                             [&robot, urdf = model.getURDF(), srdf = model.getSRDF(), group, request]() {
                               return std::make_unique<PluginSolver>(robot, urdf, srdf, group, request);
                             },
                             group));
}
}  // namespace kinematics_plugin_loader
