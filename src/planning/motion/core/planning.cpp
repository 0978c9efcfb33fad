#include "motion/planning.hpp"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>
#include <ompl/base/objectives/MechanicalWorkOptimizationObjective.h>
#include <ompl/base/objectives/MinimaxObjective.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/CostConvergenceTerminationCondition.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/tools/multiplan/ParallelPlan.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>
#include <shared_mutex>
#include <thread>

#include "goal_sampler.hpp"
#include "joint_space.hpp"
#include "planner_table.hpp"

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace motion
{
namespace
{
using Clock = std::chrono::steady_clock;

double since(Clock::time_point started)
{
  return std::chrono::duration<double>(Clock::now() - started).count();
}

// OMPL writes on the console; what matters comes back in the result.
void quiet()
{
  static const bool done = (ompl::msg::noOutputHandler(), true);
  (void)done;
}

// The states that were found for the goal. OMPL's own GoalStates may not be sampled by several threads at once.
class FoundGoals : public ob::GoalSampleableRegion
{
public:
  FoundGoals(const ob::SpaceInformationPtr& si, const std::vector<std::vector<double>>& goals) : GoalSampleableRegion(si)
  {
    setThreshold(1e-9);
    for (const auto& values : goals)
    {
      ob::State* state = si_->allocState();
      std::copy(values.begin(), values.end(), JointSpace::values(state));
      states_.push_back(state);
    }
  }
  ~FoundGoals() override
  {
    for (ob::State* state : states_)
      si_->freeState(state);
  }
  void sampleGoal(ob::State* state) const override { si_->copyState(state, states_[next_++ % states_.size()]); }
  unsigned int maxSampleCount() const override { return static_cast<unsigned int>(states_.size()); }
  double distanceGoal(const ob::State* state) const override
  {
    double least = std::numeric_limits<double>::infinity();
    for (const ob::State* goal : states_)
      least = std::min(least, si_->distance(state, goal));
    return least;
  }

private:
  std::vector<ob::State*> states_;
  mutable std::atomic<std::size_t> next_{0};
};

// OMPL draws the seeds of all random numbers from one place: a seeded plan has it for itself.
std::shared_timed_mutex& seeding()
{
  static std::shared_timed_mutex mutex;
  return mutex;
}

// What the caller asks of states, too.
class FeasibleValidity : public JointSpaceValidity
{
public:
  FeasibleValidity(const ob::SpaceInformationPtr& si, const JointSpace& space, const CollisionFree& free,
                   const ConstraintSet* constraints, const std::function<bool(const RobotState&)>& feasible)
    : JointSpaceValidity(si, space, free, constraints), joints_(space), feasible_(feasible)
  {
  }
  bool isValid(const ob::State* state) const override
  {
    if (!JointSpaceValidity::isValid(state))
      return false;
    StatePool::Lease lease(joints_.pool());
    (*lease).setGroup(joints_.group(), JointSpace::values(state));
    return feasible_(*lease);
  }

private:
  const JointSpace& joints_;
  const std::function<bool(const RobotState&)>& feasible_;
};

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
    while (!(request_.seed ? alone.try_lock_for(std::chrono::milliseconds(10)) : shared.try_lock_for(std::chrono::milliseconds(10))))
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
  bool stopped() const { return cancelled() || since(started_) >= request_.time; }

  PlanResult stopResult()
  {
    if (cancelled())
      return fail(PlanStatus::Cancelled, "planning was cancelled");
    char text[200];
    std::snprintf(text, sizeof text, "no path found within %.3g s by %s; more planning time or another planner may help",
                  request_.time, result_.planner.c_str());
    return fail(PlanStatus::Timeout, text);
  }

  // -------------------------------------------------------------- start and goals

  bool startIsGood()
  {
    for (std::size_t i = 0; i < group_.variables.size(); ++i)
    {
      const int variable = group_.variables[i];
      const JointModel& joint = scene_.model()->joints[scene_.model()->variable_joint[variable]];
      if (joint.satisfiesBounds(start_.joint(joint), 1e-6))
        continue;
      const VariableBounds& b = scene_.model()->bounds[variable];
      char text[300];
      std::snprintf(text, sizeof text, "the start state is outside the limits: '%s' is at %.4g, allowed is %.4g to %.4g",
                    group_.variable_names[i].c_str(), start_.positions()[variable], b.min_position, b.max_position);
      fail(PlanStatus::InvalidStart, text);
      return false;
    }
    if (!free_(start_))
    {
      fail(PlanStatus::StartInCollision, "the start state is in collision: " + touching(start_));
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

  std::string touching(const RobotState& state) const
  {
    CollisionRequest request;
    request.group = request_.group;
    request.contacts = 1;
    const CollisionResult result = scene_.check(state, request);
    if (result.contacts.empty())
      return "bodies overlap";
    return "'" + result.contacts[0].body_1 + "' and '" + result.contacts[0].body_2 + "' touch";
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
    RobotState state(start_);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < goals_.size(); ++i)
    {
      state.setGroup(group_, goals_[i].data());
      order.emplace_back(start_.distance(state, &group_), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::vector<double>> sorted;
    for (const auto& [distance, index] : order)
      sorted.push_back(goals_[index]);
    goals_ = std::move(sorted);
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
                                            " ways found to reach it; in the first " + touching(state));
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
      limitWorkspace();
    if (!path_.positions.empty() || !path_.orientations.empty())
      space_->projectOnto(&path_);
    space_->setProjection(request_.projection);
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
    else if (request_.closely && !request_.feasible && path_.empty())  // of other conditions only states can be asked
      si_->setMotionValidator(std::make_shared<CloseMotion>(si_, *space_, scene_.checker(start_, group_.name)));
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

  void limitWorkspace()
  {
    std::size_t index = 0;
    for (int j : group_.active_joints)
    {
      const JointModel& joint = scene_.model()->joints[j];
      const int lengths = joint.type == JointType::Planar ? 2 : joint.type == JointType::Floating ? 3 : 0;
      for (int k = 0; k < lengths; ++k)
        if (!joint.bounds[k].has_position)
        {
          // Start and goals stay inside whatever the workspace says.
          double low = request_.workspace_min[k], high = request_.workspace_max[k];
          low = std::min(low, start_.joint(joint)[k]);
          high = std::max(high, start_.joint(joint)[k]);
          for (const auto& goal : goals_)
          {
            low = std::min(low, goal[index + k]);
            high = std::max(high, goal[index + k]);
          }
          space_->limit(index + k, low, high);
        }
      index += joint.variable_count;
    }
  }

  std::string parameter(const std::string& key) const
  {
    const auto found = request_.parameters.find(key);
    return found == request_.parameters.end() ? "" : found->second;
  }

  ob::OptimizationObjectivePtr objective()
  {
    const std::string name = parameter("optimization_objective");
    if (name == "MinimaxObjective")
      return std::make_shared<ob::MinimaxObjective>(si_);
    if (name == "StateCostIntegralObjective")
      return std::make_shared<ob::StateCostIntegralObjective>(si_);
    if (name == "MechanicalWorkOptimizationObjective")
      return std::make_shared<ob::MechanicalWorkOptimizationObjective>(si_);
    if (name == "MaximizeMinClearanceObjective")
      return std::make_shared<ob::MaximizeMinClearanceObjective>(si_);
    if (name == "PathLengthOptimizationObjective")
      return std::make_shared<ob::PathLengthOptimizationObjective>(si_);
    if (!name.empty())
      warn("optimization_objective '" + name.substr(0, 60) + "' is not known; the planner's own is used");
    return nullptr;
  }

  ob::PlannerTerminationCondition termination()
  {
    const ob::PlannerTerminationCondition clock([this]() { return stopped(); });
    const std::string text = parameter("termination_condition");
    const std::size_t open = text.find('[');
    const std::string kind = text.substr(0, open);
    if (kind == "Iteration" && open != std::string::npos)
      return ob::plannerOrTerminationCondition(clock, ob::IterationTerminationCondition(std::max(1, std::atoi(text.c_str() + open + 1))));
    if (kind == "CostConvergence")
    {
      int window = 10;
      double epsilon = 0.1;
      if (open != std::string::npos)
        std::sscanf(text.c_str() + open, "[%d,%lf", &window, &epsilon);
      return ob::plannerOrTerminationCondition(clock, ob::CostConvergenceTerminationCondition(problem_, window, epsilon));
    }
    if (kind == "ExactSolution")
      return ob::plannerOrTerminationCondition(clock, ob::exactSolnPlannerTerminationCondition(problem_));
    return clock;
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

  void solve()
  {
    const ob::PlannerTerminationCondition done = termination();
    try
    {
      const ob::PlannerStatus status = request_.attempts > 1 ? solveSeveral(done) : solveOnce(done);
      report(status);
    }
    catch (const ompl::Exception& error)
    {
      fail(PlanStatus::Failed, std::string("planner ") + result_.planner + ": " + error.what());
    }
  }

  ob::PlannerStatus solveOnce(const ob::PlannerTerminationCondition& done)
  {
    result_.attempts = 1;
    const ob::PlannerPtr one = planner();
    one->setup();
    return one->solve(done);
  }

  // Several planners, hybridised; side by side unless a seed asks for the same path each time.
  ob::PlannerStatus solveSeveral(const ob::PlannerTerminationCondition& done)
  {
    const int side_by_side = request_.seed ? 1 : request_.threads > 0 ? request_.threads : 4;
    ob::PlannerStatus status = ob::PlannerStatus::TIMEOUT;
    while (result_.attempts < request_.attempts && !done)
    {
      const int batch = std::min(side_by_side, request_.attempts - result_.attempts);
      if (batch == 1)
      {
        ++result_.attempts;
        const ob::PlannerPtr one = planner();
        one->setup();
        status = one->solve(done);
        continue;
      }
      ompl::tools::ParallelPlan parallel(problem_);
      for (int i = 0; i < batch; ++i)
        parallel.addPlanner(planner());
      status = parallel.solve(done, 1, batch, request_.hybridize);
      result_.attempts += batch;
    }
    if (problem_->hasExactSolution())
      return ob::PlannerStatus::EXACT_SOLUTION;
    return status;
  }

  void report(const ob::PlannerStatus& status)
  {
    if (problem_->hasExactSolution())
    {
      if (cancelled())
      {
        stopResult();
        return;
      }
      takePath();
      return;
    }
    if (stopped() || status == ob::PlannerStatus::TIMEOUT)
      stopResult();
    else if (problem_->hasApproximateSolution())
      fail(PlanStatus::Approximate, "planner " + result_.planner + " came near the goal, but not there");
    else if (status == ob::PlannerStatus::INVALID_GOAL)
      fail(PlanStatus::InvalidGoal, "planner " + result_.planner + " refused the goal");
    else if (status == ob::PlannerStatus::INVALID_START)
      fail(PlanStatus::InvalidStart, "planner " + result_.planner + " refused the start state");
    else
      fail(PlanStatus::Failed, "planner " + result_.planner + " ended with '" + status.asString() + "'");
  }

  void takePath()
  {
    og::PathGeometric path(*problem_->getSolutionPath()->as<og::PathGeometric>());
    if (request_.simplify && since(started_) < request_.time)
    {
      const auto before = Clock::now();
      og::PathSimplifier simplifier(si_, problem_->getGoal(), problem_->getOptimizationObjective());
      og::PathGeometric simpler(path);
      // Simplifying may not make a valid path invalid; check, for it interpolates anew.
      simplifier.simplify(simpler, ob::PlannerTerminationCondition([this]() { return stopped(); }), false);
      if (simpler.check())
        path = simpler;
      result_.simplify_time = since(before);
    }
    if (cancelled())
    {
      stopResult();
      return;
    }
    if (request_.interpolate)
    {
      if (request_.maximum_waypoint_distance > 0)
        path.interpolate(std::max<unsigned int>(static_cast<unsigned int>(0.5 + path.length() / request_.maximum_waypoint_distance),
                                                std::max(2, request_.minimum_waypoints)));
      else
        path.interpolate();
      if (path.getStateCount() < static_cast<std::size_t>(std::max(2, request_.minimum_waypoints)))
        path.interpolate(static_cast<unsigned int>(std::max(2, request_.minimum_waypoints)));
    }
    for (const ob::State* state : path.getStates())
    {
      const double* values = JointSpace::values(state);
      result_.path.emplace_back(values, values + space_->size());
    }
    result_.status = PlanStatus::Solved;
    result_.message.clear();
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
  PlanResult result_;
  std::vector<std::vector<double>> goals_;
  std::shared_ptr<JointSpace> space_;
  ob::SpaceInformationPtr si_;
  std::shared_ptr<JointSpaceValidity> validity_;
  ob::ProblemDefinitionPtr problem_;
};

// Keys of ompl_planning.yaml that are not the planner's own.
const std::set<std::string>& generalKeys()
{
  static const std::set<std::string> keys{"type", "optimization_objective", "termination_condition", "interpolate", "hybridize",
                                          "multi_query_planning_enabled", "load_planner_data", "store_planner_data",
                                          "planner_data_path", "projection_evaluator", "longest_valid_segment_fraction",
                                          "enforce_joint_model_state_space", "enforce_constrained_state_space",
                                          "maximum_waypoint_distance", "minimum_waypoint_count", "simplify_solutions"};
  return keys;
}
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

std::map<std::string, std::map<std::string, std::string>> plannerParameters()
{
  quiet();
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(-1, 1);
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([](const ob::State*) { return true; });
  si->setup();
  std::map<std::string, std::map<std::string, std::string>> out;
  for (const std::string& name : plannerNames())
    makePlanner(name, si)->params().getParams(out[name]);
  return out;
}

std::string plannerProblem(const std::string& name, const std::map<std::string, std::string>& parameters)
{
  const std::string known = plannerName(name);
  if (known.empty())
  {
    for (const char* other : {"STOMP", "CHOMP"})
      if (name.find(other) != std::string::npos)
        return std::string(other) + " is not part of this library; use an OMPL planner such as RRTConnect";
    return "there is no planner '" + name.substr(0, 60) + "' (there is: " + listed(plannerNames()) + ")";
  }
  if (parameters.empty())
    return "";
  static const auto all = plannerParameters();
  for (const auto& [key, value] : parameters)
    if (!all.at(known).count(key) && !generalKeys().count(key))
    {
      std::vector<std::string> keys;
      for (const auto& [own, unused] : all.at(known))
        keys.push_back(own);
      return "planner " + known + " has no parameter '" + key.substr(0, 60) + "' (there is: " + listed(keys) + ")";
    }
  return "";
}
}  // namespace motion
