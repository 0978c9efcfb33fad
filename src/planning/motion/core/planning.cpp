#include "motion/planning.hpp"

#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/tools/multiplan/ParallelPlan.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <shared_mutex>
#include <thread>

#include "found_goals.hpp"
#include "goal_sampler.hpp"
#include "hybrid.hpp"
#include "joint_space.hpp"
#include "planner_table.hpp"
#include "start_and_goals.hpp"
#include "way_round.hpp"

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace motion
{
namespace
{
using Clock = std::chrono::steady_clock;
constexpr int CLOSER = 3;                 // times that a path which cuts corners is looked at again; the last time all along
constexpr std::size_t LONG_STEPS = 2000;  // states that RRTConnect looks at before its steps become shorter
constexpr double FINER = 4.0;             // how much nearer to each other are the states then, each time

double since(Clock::time_point started) { return std::chrono::duration<double>(Clock::now() - started).count(); }

// OMPL draws the seeds of all random numbers from one place: a seeded plan has it for itself.
std::shared_timed_mutex& seeding()
{
  static std::shared_timed_mutex mutex;
  return mutex;
}

class Planning
{
public:
  Planning(const PlanningScene& scene, const RobotState& start, const PlanRequest& request, const CancelFlag& cancel)
    : scene_(scene)
    , start_(start)
    , request_(request)
    , cancel_(cancel)
    , group_(scene.model()->group(request.group))
    , pool_(start)
    , free_(scene, start, request.group)
    , path_(scene, request.path)
    , random_(request.seed ? *request.seed : std::random_device{}())
    , time_(request.time)
  {
  }

  PlanResult run()
  {
    quiet();
    result_.planner = plannerName(request_.planner);
    const std::string problem = plannerProblem(request_.planner, {});
    if (!problem.empty())
      return fail(PlanStatus::UnknownPlanner, problem);
    if (group_.variables.empty())
      return fail(PlanStatus::Failed, "group '" + group_.name + "' has no joint that moves");
    if (!startIsGood() || !findGoals())
      return finish();
    std::shared_lock<std::shared_timed_mutex> shared(seeding(), std::defer_lock);
    std::unique_lock<std::shared_timed_mutex> alone(seeding(), std::defer_lock);
    while (!(request_.seed ? alone.try_lock_for(std::chrono::milliseconds(10))
                           : shared.try_lock_for(std::chrono::milliseconds(10))))
      if (stopped())
        return stopResult();
    if (request_.seed)
      ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(*request_.seed % 0xFFFFFFFEul + 1));
    build();
    solve();
    return finish();
  }

private:
  PlanResult fail(PlanStatus status, const std::string& message)
  {
    result_.status = status;
    result_.message = message;
    return finish();
  }

  PlanResult finish()
  {
    result_.planning_time = since(started_);
    if (validity_)
      result_.states_checked = validity_->checked;
    return result_;
  }

  bool cancelled() const { return cancel_ && *cancel_; }
  bool stopped() const { return cancelled() || since(started_) >= time_; }

  PlanResult stopResult()
  {
    if (cancelled())
      return fail(PlanStatus::Cancelled, "planning was cancelled");
    char text[200];
    std::snprintf(text, sizeof text, "no path found within %.3g s by %s; more planning time or another planner may help",
                  request_.time, result_.planner.c_str());
    return fail(PlanStatus::Timeout, text + (goals_.empty() ? "" : wayRound(*scene_.model(), group_, start_, goals_.front())));
  }

  // -------------------------------------------------------------- start and goals

  bool startIsGood()
  {
    std::string outside = outsideLimits(*scene_.model(), group_, start_);
    if (outside.empty() && request_.has_workspace)
      outside = emptyWorkspace(*scene_.model(), group_, request_.workspace_min, request_.workspace_max);
    if (!outside.empty())
    {
      fail(PlanStatus::InvalidStart, outside);
      return false;
    }
    if (!free_(start_))
    {
      fail(PlanStatus::StartInCollision, "the start state is in collision: " + touching(scene_, start_, request_.group));
      return false;
    }
    if (request_.feasible && !request_.feasible(start_))
    {
      fail(PlanStatus::InvalidStart, "the start state is not feasible for the scene's own test");
      return false;
    }
    const std::string broken = path_.problem(start_);
    if (!broken.empty())
    {
      fail(PlanStatus::StartViolatesPathConstraints, "the start state breaks the path constraints: " + broken);
      return false;
    }
    return true;
  }

  bool findGoals()
  {
    GoalSampler::Refusals refusals;
    bool any = false;
    const std::size_t wanted = static_cast<std::size_t>(std::max(1, request_.goal_samples));
    for (const Constraints& goal : request_.goals)
    {
      if (goal.empty())
        continue;
      any = true;
      GoalSampler sampler(scene_, start_, group_, goal, path_, free_);
      for (auto& values : sampler.sample(wanted, random_, [this]() { return stopped(); }))
        if (feasible(values))
          goals_.push_back(std::move(values));
      if (sampler.refusals().reached >= refusals.reached)
        refusals = sampler.refusals();
    }
    if (!any)
      fail(PlanStatus::NoGoal, "the request has no goal: set joint values, a pose or other constraints to reach");
    else if (cancelled())
      stopResult();
    else if (goals_.empty())
      explainGoal(refusals);
    if (result_.status == PlanStatus::Failed && !result_.message.empty())
      return false;
    if (!any || cancelled() || goals_.empty())
      return false;
    goals_ = nearestFirst(start_, group_, goals_);
    result_.goals = static_cast<int>(goals_.size());
    return true;
  }

  bool feasible(const std::vector<double>& values) const
  {
    if (!request_.feasible)
      return true;
    RobotState state(start_);
    state.setGroup(group_, values.data());
    return request_.feasible(state);
  }

  void explainGoal(const GoalSampler::Refusals& refusals)
  {
    if (refusals.colliding)
    {
      RobotState state(start_);
      state.setGroup(group_, refusals.example.data());
      fail(PlanStatus::GoalInCollision, "the goal is in collision in all " + std::to_string(refusals.colliding) +
                                            " ways found to reach it; in the first " + touching(scene_, state, request_.group));
    }
    else if (refusals.path)
      fail(PlanStatus::GoalViolatesPathConstraints, "the goal can be reached, but breaks the path constraints");
    else if (refusals.reached)
      fail(PlanStatus::InvalidGoal, "the goal demands what cannot be at once, or joint values beyond the limits");
    else
      fail(PlanStatus::NoIk, "no joint values of group '" + group_.name + "' reach the goal: the pose is out of reach");
  }

  // -------------------------------------------------------------- OMPL

  void build()
  {
    space_ = std::make_shared<JointSpace>(scene_.model(), group_, pool_);
    for (std::size_t i = 0; i < group_.variables.size(); ++i)
      for (const auto& c : path_.joints)
        if (c.variable == group_.variables[i] && !c.continuous)
          space_->limit(i, c.position - c.below, c.position + c.above);
    if (request_.has_workspace)
      boundsOfWorkspace(*scene_.model(), group_, start_, goals_, request_.workspace_min, request_.workspace_max,
                        [this](std::size_t variable, double low, double high) { space_->limit(variable, low, high); });
    if (!path_.positions.empty() || !path_.orientations.empty())
      space_->projectOnto(&path_);
    for (const std::string& problem : space_->setProjection(request_.projection))
      warn(problem);
    si_ = std::make_shared<ob::SpaceInformation>(space_);
    const ConstraintSet* constraints = path_.empty() ? nullptr : &path_;
    if (request_.feasible)
      validity_ = std::make_shared<FeasibleValidity>(si_, *space_, free_, constraints, request_.feasible);
    else
      validity_ = std::make_shared<JointSpaceValidity>(si_, *space_, free_, constraints);
    si_->setStateValidityChecker(validity_);
    si_->setStateValidityCheckingResolution(request_.segment_fraction);
    if (space_->projects())
      si_->setMotionValidator(std::make_shared<ProjectedMotion>(si_));
    si_->setup();
    problem_ = std::make_shared<ob::ProblemDefinition>(si_);
    ob::State* start = si_->allocState();
    start_.getGroup(group_, JointSpace::values(start));
    space_->enforceBounds(start);
    problem_->addStartState(start);
    si_->freeState(start);
    problem_->setGoal(std::make_shared<FoundGoals>(si_, goals_));
    // Without an objective each planner has its own default; given one, PRM and LazyPRM would use all of their time.
    if (const auto wanted = objective())
      problem_->setOptimizationObjective(wanted);
  }

  std::string parameter(const std::string& key) const
  {
    const auto found = request_.parameters.find(key);
    return found == request_.parameters.end() ? "" : found->second;
  }

  ob::OptimizationObjectivePtr objective()
  {
    const std::string name = parameter("optimization_objective");
    const ob::OptimizationObjectivePtr made = makeObjective(name, si_);
    if (!name.empty() && !made)
      warn("optimization_objective '" + name.substr(0, 60) + "' is not known; the planner's own is used");
    return made;
  }

  ob::PlannerPtr planner()
  {
    const ob::PlannerPtr planner = makePlanner(result_.planner, si_);
    for (const auto& [key, value] : request_.parameters)
      if (planner->params().hasParam(key) && !planner->params().setParam(key, value))
        warn("planner " + result_.planner + ": '" + value + "' is no value for parameter '" + key + "'; its default is used");
    planner->setProblemDefinition(problem_);
    return planner;
  }

  void warn(const std::string& text)
  {
    if (std::find(result_.warnings.begin(), result_.warnings.end(), text) == result_.warnings.end())
      result_.warnings.push_back(text);
  }

  // A path may cut corners between the states that were looked at. Then it is shortened once more with states nearer to each other,
  // in the end all along its motions; the search itself is repeated only if what it found, not yet shortened, is no way.
  void solve()
  {
    og::PathGeometric found(si_);
    if (!search(found))
      return;
    for (int look = 0;; ++look)
    {
      og::PathGeometric path(found);
      if (request_.simplify)
        simplify(path);
      if (cancelled())
      {
        stopResult();
        return;
      }
      if (!request_.closely || hit(path) < 0)
        return take(path);
      if (look == CLOSER)
        return take(found, hit(found));
      lookCloser(look);
      if (!found.check() && !search(found))
        return;
    }
  }

  int hit(const og::PathGeometric& path) const { return firstHit(scene_, start_, group_, rows(path)); }

  void lookCloser(int look)
  {
    if (look + 1 == CLOSER)
      si_->setMotionValidator(std::make_shared<CloseMotion>(si_, *space_, scene_.checker(start_, group_.name)));
    else
      si_->setStateValidityCheckingResolution(request_.segment_fraction / std::pow(FINER, look + 1));
    si_->setup();
    time_ = std::max(time_, since(started_) + std::min(1.0, request_.time));
  }

  bool search(og::PathGeometric& found)
  {
    problem_->clearSolutionPaths();
    result_.attempts = 0;
    const ob::PlannerTerminationCondition done =
        makeTermination(parameter("termination_condition"), problem_, [this]() { return stopped(); });
    try
    {
      const ob::PlannerStatus status = request_.attempts > 1 ? solveSeveral(done) : solveOnce(done);
      if (!report(status))
        return false;
    }
    catch (const ompl::Exception& error)
    {
      fail(PlanStatus::Failed, std::string("planner ") + result_.planner + ": " + error.what());
      return false;
    }
    found = *problem_->getSolutionPath()->as<og::PathGeometric>();
    return true;
  }

  ob::PlannerStatus solveOnce(const ob::PlannerTerminationCondition& done)
  {
    ++result_.attempts;
    const ob::PlannerPtr one = planner();
    one->setup();
    if (hasNoRange(result_.planner, request_.parameters))
    {
      const std::size_t until = validity_->checked + LONG_STEPS;
      const ob::PlannerStatus status =
          one->solve(ob::PlannerTerminationCondition([this, &done, until]() { return done() || validity_->checked >= until; }));
      if (done || status == ob::PlannerStatus::EXACT_SOLUTION)
        return status;
      stepShort(*one, space_->getMaximumExtent());
    }
    return one->solve(done);
  }

  // Several planners, side by side unless a seed asks for the same path each time; their paths are mixed.
  ob::PlannerStatus solveSeveral(const ob::PlannerTerminationCondition& done)
  {
    const int side_by_side = request_.seed ? 1 : request_.threads > 0 ? request_.threads : 4;
    ob::PlannerStatus status = ob::PlannerStatus::TIMEOUT;
    for (int made = 0; made < request_.attempts && !done;)
    {
      const int batch = std::min(side_by_side, request_.attempts - made);
      made += batch;
      if (batch == 1)
      {
        status = solveOnce(done);
        continue;
      }
      ompl::tools::ParallelPlan parallel(problem_);
      for (int i = 0; i < batch; ++i)
      {
        const ob::PlannerPtr one = planner();
        if (i % 2 && hasNoRange(result_.planner, request_.parameters))
          stepShort(*one, space_->getMaximumExtent());
        parallel.addPlanner(one);
      }
      status = parallel.solve(done, 1, batch, false);
      result_.attempts += batch;
    }
    if (!problem_->hasExactSolution())
      return status;
    if (request_.hybridize && !stopped())
      hybridize(si_, *problem_);
    return ob::PlannerStatus::EXACT_SOLUTION;
  }

  // Is there a path?
  bool report(const ob::PlannerStatus& status)
  {
    if (cancelled())
      stopResult();
    else if (problem_->hasExactSolution())
      return true;
    else if (stopped() || status == ob::PlannerStatus::TIMEOUT)
      stopResult();
    else if (problem_->hasApproximateSolution())
      fail(PlanStatus::Approximate, "planner " + result_.planner + " came near the goal, but not there");
    else if (status == ob::PlannerStatus::INVALID_GOAL)
      fail(PlanStatus::InvalidGoal, "planner " + result_.planner + " refused the goal");
    else if (status == ob::PlannerStatus::INVALID_START)
      fail(PlanStatus::InvalidStart, "planner " + result_.planner + " refused the start state");
    else
      fail(PlanStatus::Failed, "planner " + result_.planner + " ended with '" + status.asString() + "'");
    return false;
  }

  void simplify(og::PathGeometric& path)
  {
    if (stopped())
      return;
    const auto before = Clock::now();
    og::PathSimplifier simplifier(si_, problem_->getGoal(), problem_->getOptimizationObjective());
    og::PathGeometric simpler(path);
    // Simplifying may not make a valid path invalid; check, for it interpolates anew.
    simplifier.simplify(simpler, ob::PlannerTerminationCondition([this]() { return stopped(); }), false);
    if (simpler.check())
      path = simpler;
    result_.simplify_time += since(before);
  }

  // `hit`: after which way point the path touches something; -1 if it does nowhere.
  void take(og::PathGeometric& path, int hit = -1)
  {
    si_->setStateValidityCheckingResolution(request_.segment_fraction);  // way points are as far apart as was asked for
    si_->setup();
    if (request_.interpolate)
    {
      if (request_.maximum_waypoint_distance > 0)
        path.interpolate(
            std::max<unsigned int>(static_cast<unsigned int>(0.5 + path.length() / request_.maximum_waypoint_distance),
                                   std::max(2, request_.minimum_waypoints)));
      else
        path.interpolate();
      if (path.getStateCount() < static_cast<std::size_t>(std::max(2, request_.minimum_waypoints)))
        path.interpolate(static_cast<unsigned int>(std::max(2, request_.minimum_waypoints)));
    }
    result_.path = rows(path);
    result_.status = PlanStatus::Solved;
    result_.message.clear();
    if (hit < 0)
      return;
    result_.status = PlanStatus::InvalidPath;
    result_.hit = firstHit(scene_, start_, group_, result_.path);
    result_.message = cutsCorners(result_.hit, result_.path.size());
  }

  std::vector<std::vector<double>> rows(const og::PathGeometric& path) const
  {
    std::vector<std::vector<double>> out;
    for (std::size_t i = 0; i < path.getStateCount(); ++i)
    {
      const double* values = JointSpace::values(path.getState(i));
      out.emplace_back(values, values + space_->size());
    }
    return out;
  }

  const PlanningScene& scene_;
  const RobotState& start_;
  const PlanRequest& request_;
  const CancelFlag& cancel_;
  const JointModelGroup& group_;
  StatePool pool_;
  const CollisionFree free_;
  const ConstraintSet path_;
  Random random_;
  const Clock::time_point started_ = Clock::now();
  double time_;  // s from then on
  PlanResult result_;
  std::vector<std::vector<double>> goals_;
  std::shared_ptr<JointSpace> space_;
  ob::SpaceInformationPtr si_;
  std::shared_ptr<JointSpaceValidity> validity_;
  ob::ProblemDefinitionPtr problem_;
};

}  // namespace

PlanResult plan(const PlanningScene& scene, const RobotState& start, const PlanRequest& request, const CancelFlag& cancel)
{
  if (!(request.time > 0) || !std::isfinite(request.time))
    throw InvalidInput("the allowed planning time must be a number above 0 s");
  if (!(request.segment_fraction > 0 && request.segment_fraction <= 1))
    throw InvalidInput("longest_valid_segment_fraction must be above 0 and at most 1");
  RobotState from(start);
  from.normalizeContinuous(&scene.model()->group(request.group));
  from.linkPoses();
  return Planning(scene, from, request, cancel).run();
}

}  // namespace motion
