// move_group_capabilities: the process beside move_group in which compiled capabilities live; move_group starts and ends it.
//
//   move_group_capabilities --move-group NAME --report FD --default PIPELINE [--pipeline NAME]... [--execute] [--debug] CLASS...
//
// What has become of each class is written to the file descriptor, a line each: "+CLASS<tab>TITLE" or "-CLASS<tab>WHY".
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <unistd.h>

#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

#include <moveit/move_group/move_group_capability.h>
#include <moveit/moveit_cpp/moveit_cpp.h>

#include "shared_scene.hpp"

namespace
{
struct Arguments
{
  std::string move_group, default_pipeline;
  std::vector<std::string> pipelines, classes;
  int report = -1;
  bool execute = false, debug = false;
};

Arguments parse(int argc, char** argv)
{
  Arguments arguments;
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    const auto value = [&]() { return std::string(i + 1 < argc ? argv[++i] : ""); };
    if (word == "--move-group")
      arguments.move_group = value();
    else if (word == "--report")
      arguments.report = std::stoi(value());
    else if (word == "--default")
      arguments.default_pipeline = value();
    else if (word == "--pipeline")
      arguments.pipelines.push_back(value());
    else if (word == "--execute")
      arguments.execute = true;
    else if (word == "--debug")
      arguments.debug = true;
    else
      arguments.classes.push_back(word);
  }
  return arguments;
}

class Report
{
public:
  explicit Report(int descriptor) : descriptor_(descriptor) {}
  ~Report() { ::close(descriptor_); }
  void line(char sign, const std::string& name, std::string text) const
  {
    for (char& letter : text)
      if (letter == '\n' || letter == '\t')
        letter = ' ';
    const std::string all = sign + name + "\t" + text + "\n";
    if (::write(descriptor_, all.data(), all.size()) < 0)
      ROS_ERROR("move_group does not listen: %s", all.c_str());
  }

private:
  int descriptor_;
};

moveit_cpp::MoveItCppPtr makeMoveItCpp(const Arguments& arguments)
{
  const ros::NodeHandle node("~");
  moveit_cpp::MoveItCpp::Options options(node);
  auto& scene = options.planning_scene_monitor_options;
  scene.monitored_planning_scene_topic = node.resolveName("unused_planning_scene");  // closed again at once
  scene.publish_planning_scene_topic = "";
  scene.attached_collision_object_topic = "";
  options.planning_pipeline_options.pipeline_names = arguments.pipelines;
  if (arguments.pipelines != std::vector<std::string>{ "" })  // Melodic's layout: directly below the node's name
    options.planning_pipeline_options.parent_namespace = node.getNamespace() + "/planning_pipelines";
  return std::make_shared<moveit_cpp::MoveItCpp>(options, node);
}

// What is set in move_group's servers of dynamic_reconfigure holds here as well. In a thread of its own: this process's servers answer
// in the one in which capabilities work.
class Follower
{
public:
  Follower(const std::string& move_group, const std::vector<std::string>& servers)
  {
    node_.setCallbackQueue(&queue_);
    for (const std::string& server : servers)
      settings_.push_back(node_.subscribe<dynamic_reconfigure::Config>(
          move_group + "/" + server + "/parameter_updates", 1,
          [set = ros::names::resolve("~" + server + "/set_parameters")](const dynamic_reconfigure::ConfigConstPtr& config) {
            dynamic_reconfigure::Reconfigure call;
            call.request.config = *config;
            if (!ros::service::call(set, call) && ros::ok())
              ROS_WARN("%s does not take what is set in move_group", set.c_str());
          }));
    spinner_.start();
  }

private:
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> settings_;
  ros::AsyncSpinner spinner_{ 1, &queue_ };  // last: it ends before what it uses
};

using Loader = pluginlib::ClassLoader<move_group::MoveGroupCapability>;

std::vector<move_group::MoveGroupCapabilityPtr> load(Loader& loader, const Arguments& arguments,
                                                     const move_group::MoveGroupContextPtr& context, const Report& report)
{
  std::vector<move_group::MoveGroupCapabilityPtr> capabilities;
  for (const std::string& name : arguments.classes)
    try
    {
      move_group::MoveGroupCapabilityPtr capability = loader.createUniqueInstance(name);
      capability->setContext(context);
      capability->initialize();
      capabilities.push_back(capability);
      report.line('+', name, capability->getName());
    }
    catch (const std::exception& error)
    {
      report.line('-', name, error.what());
    }
  return capabilities;
}

int run(const Arguments& arguments)
{
  ros::AsyncSpinner spinner(1);
  spinner.start();
  Loader loader("moveit_ros_move_group", "move_group::MoveGroupCapability");
  move_group::MoveGroupContextPtr context;
  std::unique_ptr<move_group::SharedScene> shared;
  std::unique_ptr<Follower> follower;
  std::vector<move_group::MoveGroupCapabilityPtr> capabilities;
  {
    const Report report(arguments.report);
    try
    {
      context = std::make_shared<move_group::MoveGroupContext>(makeMoveItCpp(arguments), arguments.default_pipeline,
                                                               arguments.execute, arguments.debug);
    }
    catch (const std::exception& error)
    {
      for (const std::string& name : arguments.classes)
        report.line('-', name, error.what());
      return 1;
    }
    shared.reset(new move_group::SharedScene(context->planning_scene_monitor_));
    if (arguments.execute)
      follower.reset(new Follower(arguments.move_group, { "trajectory_execution", "plan_execution" }));
    capabilities = load(loader, arguments, context, report);
  }
  ros::waitForShutdown();
  spinner.stop();
  context->planning_scene_monitor_->clearUpdateCallbacks();
  capabilities.clear();
  return 0;
}
}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "move_group_capabilities");
  const Arguments arguments = parse(argc, argv);
  if (arguments.report < 0)
  {
    ROS_FATAL("move_group_capabilities is started by move_group, for compiled classes in its parameter ~capabilities");
    return 1;
  }
  move_group::detail::setMoveGroupName(arguments.move_group);
  return run(arguments);
}
