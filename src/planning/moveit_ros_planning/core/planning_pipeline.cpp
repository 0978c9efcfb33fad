#include <moveit/planning_pipeline/planning_pipeline.h>

#include <dlfcn.h>
#include <moveit_msgs/DisplayTrajectory.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <sstream>

#include <moveit/collision_detection/collision_tools.h>
#include <moveit/robot_state/conversions.h>

namespace planning_pipeline
{
namespace
{
using planning_interface::MotionPlanRequest;
using planning_interface::MotionPlanResponse;
using planning_interface::PlannerManager;
using planning_request_adapter::PlanningRequestAdapter;
using planning_scene::PlanningSceneConstPtr;

// Who is told of a plan that is being made.
class Active
{
public:
  explicit Active(std::atomic<bool>& flag) : flag_(flag) { flag_ = true; }
  ~Active() { flag_ = false; }

private:
  std::atomic<bool>& flag_;
};

std::string joined(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string listed(const std::vector<std::size_t>& indices)
{
  std::ostringstream text;
  for (const std::size_t index : indices)
    text << index << " ";
  return text.str();
}

std::string oneLine(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, 300);
}

// What a library lacks would end the process when it is first called: all of it is looked up now.
template <typename Base>
pluginlib::UniquePtr<Base> load(pluginlib::ClassLoader<Base>& loader, const std::string& name)
{
  if (!loader.isClassAvailable(name))
    throw std::runtime_error("no package here exports it.");
  const std::string path = loader.getClassLibraryPath(name);
  if (!path.empty() && !dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL))
    throw pluginlib::LibraryLoadException(dlerror());
  return loader.createUniqueInstance(name);
}

// Two constraints on two links are often one that was forgotten.
bool stacked(const MotionPlanRequest& req)
{
  const auto several = [](const moveit_msgs::Constraints& one) {
    return one.position_constraints.size() > 1 || one.orientation_constraints.size() > 1;
  };
  return several(req.path_constraints) || std::any_of(req.goal_constraints.begin(), req.goal_constraints.end(), several);
}
}  // namespace

const std::string PlanningPipeline::DISPLAY_PATH_TOPIC = "display_planned_path";
const std::string PlanningPipeline::MOTION_PLAN_REQUEST_TOPIC = "motion_plan_request";
const std::string PlanningPipeline::MOTION_CONTACTS_TOPIC = "display_contacts";

PlanningPipeline::PlanningPipeline(const moveit::core::RobotModelConstPtr& model, const ros::NodeHandle& pipeline_nh,
                                   const std::string& planning_plugin_param_name, const std::string& adapter_plugins_param_name)
  : pipeline_nh_(pipeline_nh)
  , robot_model_(model)
{
  pipeline_nh_.getParam(planning_plugin_param_name, planner_plugin_name_);
  std::string adapters;
  pipeline_nh_.getParam(adapter_plugins_param_name, adapters);
  std::istringstream words(adapters);
  for (std::string word; words >> word;)
    adapter_plugin_names_.push_back(word);
  configure();
}

PlanningPipeline::PlanningPipeline(const moveit::core::RobotModelConstPtr& model, const ros::NodeHandle& pipeline_nh,
                                   const std::string& planning_plugin_name,
                                   const std::vector<std::string>& adapter_plugin_names)
  : pipeline_nh_(pipeline_nh)
  , planner_plugin_name_(planning_plugin_name)
  , adapter_plugin_names_(adapter_plugin_names)
  , robot_model_(model)
{
  configure();
}

void PlanningPipeline::configure()
{
  loadPlanner();
  if (!adapter_plugin_names_.empty())
    loadAdapters();
  displayComputedMotionPlans(true);
  checkSolutionPaths(true);
}

void PlanningPipeline::loadPlanner()
{
  planner_plugin_loader_ =
      std::make_unique<pluginlib::ClassLoader<PlannerManager>>("moveit_core", "planning_interface::PlannerManager");
  const std::vector<std::string> classes = planner_plugin_loader_->getDeclaredClasses();
  if (planner_plugin_name_.empty() && !classes.empty())
  {
    planner_plugin_name_ = classes[0];
    ROS_INFO("No parameter %s: there is '%s'; using '%s' for now", pipeline_nh_.resolveName("planning_plugin").c_str(),
             joined(classes).c_str(), planner_plugin_name_.c_str());
  }
  try
  {
    planning_interface::PlannerManagerPtr planner = load(*planner_plugin_loader_, planner_plugin_name_);
    if (!planner->initialize(robot_model_, pipeline_nh_.getNamespace()))
      throw std::runtime_error("Unable to initialize planning plugin");
    planner_instance_ = planner;
    ROS_INFO("Using planning interface '%s'", planner_instance_->getDescription().c_str());
  }
  catch (const std::exception& error)
  {
    ROS_ERROR("Exception while loading planner '%s': %s Available plugins: %s", planner_plugin_name_.c_str(),
              oneLine(error.what()).c_str(), joined(classes).c_str());
  }
}

void PlanningPipeline::loadAdapters()
{
  adapter_plugin_loader_ = std::make_unique<pluginlib::ClassLoader<PlanningRequestAdapter>>(
      "moveit_core", "planning_request_adapter::PlanningRequestAdapter");
  adapter_chain_ = std::make_unique<planning_request_adapter::PlanningRequestAdapterChain>();
  for (const std::string& name : adapter_plugin_names_)
    try
    {
      const planning_request_adapter::PlanningRequestAdapterPtr adapter = load(*adapter_plugin_loader_, name);
      adapter->initialize(pipeline_nh_);
      adapter_chain_->addAdapter(adapter);
      ROS_INFO("Using planning request adapter '%s'", adapter->getDescription().c_str());
    }
    catch (const std::exception& error)
    {
      ROS_ERROR("Exception while loading planning adapter plugin '%s': %s It is left out.", name.c_str(),
                oneLine(error.what()).c_str());
    }
}

void PlanningPipeline::displayComputedMotionPlans(bool flag)
{
  if (display_computed_motion_plans_ && !flag)
    display_path_publisher_.shutdown();
  else if (!display_computed_motion_plans_ && flag)
    display_path_publisher_ = private_nh_.advertise<moveit_msgs::DisplayTrajectory>(DISPLAY_PATH_TOPIC, 10, true);
  display_computed_motion_plans_ = flag;
}

void PlanningPipeline::publishReceivedRequests(bool flag)
{
  if (publish_received_requests_ && !flag)
    received_request_publisher_.shutdown();
  else if (!publish_received_requests_ && flag)
    received_request_publisher_ = private_nh_.advertise<MotionPlanRequest>(MOTION_PLAN_REQUEST_TOPIC, 10, true);
  publish_received_requests_ = flag;
}

void PlanningPipeline::checkSolutionPaths(bool flag)
{
  if (check_solution_paths_ && !flag)
    contacts_publisher_.shutdown();
  else if (!check_solution_paths_ && flag)
    contacts_publisher_ = private_nh_.advertise<visualization_msgs::MarkerArray>(MOTION_CONTACTS_TOPIC, 100, true);
  check_solution_paths_ = flag;
}

bool PlanningPipeline::generatePlan(const PlanningSceneConstPtr& planning_scene, const MotionPlanRequest& req,
                                    MotionPlanResponse& res) const
{
  std::vector<std::size_t> unused;
  return generatePlan(planning_scene, req, res, unused);
}

bool PlanningPipeline::generatePlan(const PlanningSceneConstPtr& planning_scene, const MotionPlanRequest& req,
                                    MotionPlanResponse& res, std::vector<std::size_t>& adapter_added_state_index) const
{
  const Active active(active_);
  adapter_added_state_index.clear();
  if (publish_received_requests_)
    received_request_publisher_.publish(req);
  if (!planner_instance_)
  {
    ROS_ERROR("No planning plugin loaded. Cannot plan.");
    res.error_code_.val = moveit_msgs::MoveItErrorCodes::FAILURE;
    return false;
  }
  const bool solved = plan(planning_scene, req, res, adapter_added_state_index);
  if (!solved)
  {
    if (stacked(req))
      ROS_WARN(
          "More than one constraint is set. If your move_group does not have multiple end effectors/arms, this is unusual. "
          "Are you using a move_group_interface and forgetting to call clearPoseTargets() or equivalent?");
    return false;
  }
  const bool valid = !res.trajectory_ || !check_solution_paths_ || check(*planning_scene, req, res, adapter_added_state_index);
  if (display_computed_motion_plans_ && res.trajectory_ && !res.trajectory_->empty())
    display(*res.trajectory_);
  return valid;
}

bool PlanningPipeline::plan(const PlanningSceneConstPtr& scene, const MotionPlanRequest& req, MotionPlanResponse& res,
                            std::vector<std::size_t>& added) const
{
  try
  {
    bool solved = false;
    if (adapter_chain_)
      solved = adapter_chain_->adaptAndPlan(planner_instance_, scene, req, res, added);
    else if (const auto context = planner_instance_->getPlanningContext(scene, req, res.error_code_))
      solved = context->solve(res);
    if (!added.empty())
      ROS_INFO("Planning adapters have added states at index positions: [ %s]", listed(added).c_str());
    return solved;
  }
  catch (const std::exception& error)
  {
    ROS_ERROR("Exception caught: '%s'", oneLine(error.what()).c_str());
    res.error_code_.val = moveit_msgs::MoveItErrorCodes::FAILURE;
    return false;
  }
}

bool PlanningPipeline::check(const planning_scene::PlanningScene& scene, const MotionPlanRequest& req, MotionPlanResponse& res,
                             const std::vector<std::size_t>& added) const
{
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(1);
  markers.markers[0].action = visualization_msgs::Marker::DELETEALL;
  std::vector<std::size_t> invalid;
  bool good = scene.isPathValid(*res.trajectory_, req.path_constraints, req.group_name, false, &invalid);
  // States that adapters have added, and a start where the robot happens to be, may be invalid.
  good = good || (invalid.size() == 1 && invalid[0] == 0) ||
         std::all_of(invalid.begin(), invalid.end(),
                     [&](std::size_t index) { return std::find(added.begin(), added.end(), index) != added.end(); });
  if (!good)
  {
    res.error_code_.val = moveit_msgs::MoveItErrorCodes::INVALID_MOTION_PLAN;
    ROS_ERROR(
        "Computed path is not valid. Invalid states at index locations: [ %s] out of %zu. Explanations follow in command "
        "line. Contacts are published on %s",
        listed(invalid).c_str(), res.trajectory_->getWayPointCount(), private_nh_.resolveName(MOTION_CONTACTS_TOPIC).c_str());
    for (const std::size_t index : invalid)
    {
      const moveit::core::RobotState& state = res.trajectory_->getWayPoint(index);
      scene.isStateValid(state, req.path_constraints, req.group_name, true);
      collision_detection::CollisionRequest request;
      collision_detection::CollisionResult result;
      request.contacts = true;
      request.max_contacts = 10;
      request.max_contacts_per_pair = 3;
      scene.checkCollision(request, result, state);
      visualization_msgs::MarkerArray more;
      collision_detection::getCollisionMarkersFromContacts(more, scene.getPlanningFrame(), result.contacts);
      markers.markers.insert(markers.markers.end(), more.markers.begin(), more.markers.end());
    }
    ROS_ERROR("Completed listing of explanations for invalid states.");
  }
  contacts_publisher_.publish(markers);
  return good;
}

void PlanningPipeline::display(const robot_trajectory::RobotTrajectory& trajectory) const
{
  moveit_msgs::DisplayTrajectory message;
  message.model_id = robot_model_->getName();
  message.trajectory.resize(1);
  trajectory.getRobotTrajectoryMsg(message.trajectory[0]);
  moveit::core::robotStateToRobotStateMsg(trajectory.getFirstWayPoint(), message.trajectory_start);
  display_path_publisher_.publish(message);
}

void PlanningPipeline::terminate() const
{
  if (planner_instance_)
    planner_instance_->terminate();
}
}  // namespace planning_pipeline
