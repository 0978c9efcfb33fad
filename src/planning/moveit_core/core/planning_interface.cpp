// Planners, their contexts and answers, and the adapters around them.
#include <moveit/planning_interface/planning_interface.h>
#include <moveit/planning_request_adapter/planning_request_adapter.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "log_names.hpp"

namespace planning_interface
{
namespace
{
// All contexts of the process: terminate() is to reach those that solve.
struct Contexts
{
  std::mutex lock;
  std::set<PlanningContext*> all;
};

Contexts& contexts()
{
  static Contexts* const made = new Contexts;  // contexts of plug-ins may go after the statics
  return *made;
}
}  // namespace

PlanningContext::PlanningContext(const std::string& name, const std::string& group) : name_(name), group_(group)
{
  std::lock_guard<std::mutex> lock(contexts().lock);
  contexts().all.insert(this);
}

PlanningContext::~PlanningContext()
{
  std::lock_guard<std::mutex> lock(contexts().lock);
  contexts().all.erase(this);
}

void PlanningContext::setMotionPlanRequest(const MotionPlanRequest& request)
{
  request_ = request;
  if (!(request_.allowed_planning_time > 0.0))
  {
    ROS_INFO_NAMED(log_names::PLANNING_INTERFACE,
                   "The timeout for planning must be positive (%lf specified). Assuming one second instead.",
                   request_.allowed_planning_time);
    request_.allowed_planning_time = 1.0;
  }
  if (request_.num_planning_attempts < 0)
    ROS_ERROR_NAMED(log_names::PLANNING_INTERFACE,
                    "The number of desired planning attempts should be positive. Assuming one attempt.");
  request_.num_planning_attempts = std::max(1, request_.num_planning_attempts);
}

void PlannerManager::terminate() const
{
  std::lock_guard<std::mutex> lock(contexts().lock);
  for (PlanningContext* context : contexts().all)
    context->terminate();
}

void MotionPlanResponse::getMessage(moveit_msgs::MotionPlanResponse& msg) const
{
  msg.error_code = error_code_;
  msg.planning_time = planning_time_;
  if (!trajectory_ || trajectory_->empty())
    return;
  moveit::core::robotStateToRobotStateMsg(trajectory_->getFirstWayPoint(), msg.trajectory_start);
  trajectory_->getRobotTrajectoryMsg(msg.trajectory);
  msg.group_name = trajectory_->getGroupName();
}

void MotionPlanDetailedResponse::getMessage(moveit_msgs::MotionPlanDetailedResponse& msg) const
{
  msg.error_code = error_code_;
  msg.trajectory.clear();
  msg.description.clear();
  msg.processing_time.clear();
  bool first = true;
  for (std::size_t i = 0; i < trajectory_.size(); ++i)
  {
    if (!trajectory_[i] || trajectory_[i]->empty())
      continue;
    if (first)
    {
      moveit::core::robotStateToRobotStateMsg(trajectory_[i]->getFirstWayPoint(), msg.trajectory_start);
      msg.group_name = trajectory_[i]->getGroupName();
      first = false;
    }
    msg.trajectory.emplace_back();
    trajectory_[i]->getRobotTrajectoryMsg(msg.trajectory.back());
    msg.description.push_back(i < description_.size() ? description_[i] : "");
    msg.processing_time.push_back(i < processing_time_.size() ? processing_time_[i] : 0.0);
  }
}
}  // namespace planning_interface

namespace planning_request_adapter
{
using planning_interface::MotionPlanRequest;
using planning_interface::MotionPlanResponse;
using planning_interface::PlannerManagerPtr;
using planning_scene::PlanningSceneConstPtr;

namespace
{
bool callPlanner(const PlannerManagerPtr& planner, const PlanningSceneConstPtr& scene, const MotionPlanRequest& req,
                 MotionPlanResponse& res)
{
  const planning_interface::PlanningContextPtr context = planner->getPlanningContext(scene, req, res.error_code_);
  return context && context->solve(res);
}

// An adapter that throws is left out, the planning goes on.
bool callAdapter(const PlanningRequestAdapter& adapter, const PlanningRequestAdapter::PlannerFn& planner,
                 const PlanningSceneConstPtr& scene, const MotionPlanRequest& req, MotionPlanResponse& res,
                 std::vector<std::size_t>& added_path_index)
{
  try
  {
    return adapter.adaptAndPlan(planner, scene, req, res, added_path_index);
  }
  catch (const std::exception& error)
  {
    ROS_ERROR_NAMED(log_names::PLANNING_REQUEST_ADAPTER, "Exception caught executing adapter '%s': %s Running planner instead.",
                    adapter.getDescription().c_str(), error.what());
    added_path_index.clear();
    return planner(scene, req, res);
  }
}
}  // namespace

bool PlanningRequestAdapter::adaptAndPlan(const PlannerManagerPtr& planner, const PlanningSceneConstPtr& planning_scene,
                                          const MotionPlanRequest& req, MotionPlanResponse& res) const
{
  std::vector<std::size_t> unused;
  return adaptAndPlan(planner, planning_scene, req, res, unused);
}

bool PlanningRequestAdapter::adaptAndPlan(const PlannerManagerPtr& planner, const PlanningSceneConstPtr& planning_scene,
                                          const MotionPlanRequest& req, MotionPlanResponse& res,
                                          std::vector<std::size_t>& added_path_index) const
{
  const PlannerFn inside = [&planner](const PlanningSceneConstPtr& scene, const MotionPlanRequest& request,
                                      MotionPlanResponse& response) { return callPlanner(planner, scene, request, response); };
  return adaptAndPlan(inside, planning_scene, req, res, added_path_index);
}

bool PlanningRequestAdapterChain::adaptAndPlan(const PlannerManagerPtr& planner, const PlanningSceneConstPtr& planning_scene,
                                               const MotionPlanRequest& req, MotionPlanResponse& res) const
{
  std::vector<std::size_t> unused;
  return adaptAndPlan(planner, planning_scene, req, res, unused);
}

bool PlanningRequestAdapterChain::adaptAndPlan(const PlannerManagerPtr& planner, const PlanningSceneConstPtr& planning_scene,
                                               const MotionPlanRequest& req, MotionPlanResponse& res,
                                               std::vector<std::size_t>& added_path_index) const
{
  added_path_index.clear();
  std::vector<std::vector<std::size_t>> added(adapters_.size());  // by each, in the path that it was handed
  PlanningRequestAdapter::PlannerFn inside = [&planner](const PlanningSceneConstPtr& scene, const MotionPlanRequest& request,
                                                        MotionPlanResponse& response) {
    return callPlanner(planner, scene, request, response);
  };
  for (std::size_t i = adapters_.size(); i-- > 0;)
  {
    const PlanningRequestAdapter::PlannerFn next = inside;
    const PlanningRequestAdapter& adapter = *adapters_[i];
    std::vector<std::size_t>& own = added[i];
    inside = [next, &adapter, &own](const PlanningSceneConstPtr& scene, const MotionPlanRequest& request,
                                    MotionPlanResponse& response) {
      return callAdapter(adapter, next, scene, request, response, own);
    };
  }
  const bool solved = inside(planning_scene, req, res);
  // What an outer adapter adds moves what the inner ones have added.
  for (std::size_t i = adapters_.size(); i-- > 0;)
  {
    for (const std::size_t index : added[i])
      for (std::size_t& known : added_path_index)
        if (index <= known)
          ++known;
    added_path_index.insert(added_path_index.end(), added[i].begin(), added[i].end());
  }
  std::sort(added_path_index.begin(), added_path_index.end());
  return solved;
}
}  // namespace planning_request_adapter
