#include <gazebo_ros_control/gazebo_ros_control_plugin.h>

#include <algorithm>

#include <gazebo_ros_control/default_robot_hw_sim.h>

namespace gazebo_ros_control
{
namespace
{

const char* const kDefaultSim = "gazebo_ros_control/DefaultRobotHWSim";
const double kPoll = 0.1;  // s between two looks for the robot's description

template <class T>
T element(const sdf::ElementPtr& sdf, const std::string& name, const T& otherwise)
{
  return sdf->HasElement(name) ? sdf->Get<T>(name) : otherwise;
}

}  // namespace

GazeboRosControlPlugin::~GazeboRosControlPlugin() { update_connection_.reset(); }

void GazeboRosControlPlugin::Load(gazebo::physics::ModelPtr parent, sdf::ElementPtr sdf)
{
  ROS_INFO_NAMED("gazebo_ros_control", "Loading gazebo_ros_control plugin");
  parent_model_ = parent;
  sdf_ = sdf;
  if (!parent_model_)
  {
    ROS_ERROR_NAMED("gazebo_ros_control", "the plugin has no model");
    return;
  }
  if (!ros::isInitialized())
  {
    ROS_FATAL_NAMED("gazebo_ros_control", "a ROS node for Gazebo has not been initialized, unable to load plugin");
    return;
  }
  readElements();
  ROS_INFO_NAMED("gazebo_ros_control", "Starting gazebo_ros_control plugin in namespace: %s", robot_namespace_.c_str());
  std::string urdf;
  if (findURDF(robot_description_, urdf))
  {
    start(urdf);
    return;
  }
  ROS_WARN_NAMED("gazebo_ros_control",
                 "gazebo_ros_control plugin is waiting for model URDF in parameter [%s] on the ROS param server.",
                 robot_description_.c_str());
  update_connection_ =
      gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo&) { waitForURDF(); });
}

void GazeboRosControlPlugin::readElements()
{
  robot_namespace_ = element<std::string>(sdf_, "robotNamespace", parent_model_->GetName());
  robot_description_ = element<std::string>(sdf_, "robotParam", "robot_description");
  robot_hw_sim_type_str_ = element<std::string>(sdf_, "robotSimType", kDefaultSim);
  const ros::Duration step(parent_model_->GetWorld()->Physics()->GetMaxStepSize());
  control_period_ = ros::Duration(element(sdf_, "controlPeriod", step.toSec()));
  if (control_period_ < step)
    ROS_ERROR_STREAM_NAMED("gazebo_ros_control", "Desired controller update period ("
                                                     << control_period_ << " s) is faster than the gazebo simulation period ("
                                                     << step << " s).");
  else if (control_period_ > step)
    ROS_WARN_STREAM_NAMED("gazebo_ros_control", "Desired controller update period ("
                                                    << control_period_ << " s) is slower than the gazebo simulation period ("
                                                    << step << " s).");
  model_nh_ = ros::NodeHandle(robot_namespace_);
  const std::string topic = element<std::string>(sdf_, "eStopTopic", "");
  if (!topic.empty())
    e_stop_sub_ = model_nh_.subscribe(topic, 1, &GazeboRosControlPlugin::eStopCB, this);
}

// -- the robot's description ---------------------------------------------------------------------------------------------------------

bool GazeboRosControlPlugin::findURDF(const std::string& param_name, std::string& urdf) const
{
  std::string found;
  return model_nh_.getParam(model_nh_.searchParam(param_name, found) ? found : param_name, urdf) && !urdf.empty();
}

void GazeboRosControlPlugin::waitForURDF()
{
  const ros::WallTime now = ros::WallTime::now();
  if (now < next_look_)
    return;
  next_look_ = now + ros::WallDuration(kPoll);
  std::string urdf;
  if (!findURDF(robot_description_, urdf))
    return;
  update_connection_.reset();
  start(urdf);
}

std::string GazeboRosControlPlugin::getURDF(std::string param_name) const
{
  std::string urdf;
  while (!findURDF(param_name, urdf) && ros::ok())
  {
    ROS_INFO_ONCE_NAMED("gazebo_ros_control",
                        "gazebo_ros_control plugin is waiting for model URDF in parameter [%s] on the ROS param "
                        "server.",
                        param_name.c_str());
    ros::WallDuration(kPoll).sleep();
  }
  return urdf;
}

bool GazeboRosControlPlugin::parseTransmissionsFromURDF(const std::string& urdf_string)
{
  transmission_interface::TransmissionParser::parse(urdf_string, transmissions_);
  return true;  // also of a robot without any
}

boost::shared_ptr<RobotHWSim> GazeboRosControlPlugin::makeRobot()
{
  if (robot_hw_sim_type_str_ == kDefaultSim)  // pluginlib is told of Python's
    return boost::shared_ptr<RobotHWSim>(new DefaultRobotHWSim);
  robot_hw_sim_loader_.reset(new pluginlib::ClassLoader<RobotHWSim>("gazebo_ros_control", "gazebo_ros_control::RobotHWSim"));
  return robot_hw_sim_loader_->createInstance(robot_hw_sim_type_str_);
}

void GazeboRosControlPlugin::start(const std::string& urdf)
{
  try
  {
    parseTransmissionsFromURDF(urdf);
    robot_hw_sim_ = makeRobot();
    const urdf::Model* const model = urdf_model_.initString(urdf) ? &urdf_model_ : nullptr;
    if (!robot_hw_sim_->initSim(robot_namespace_, model_nh_, parent_model_, model, transmissions_))
    {
      ROS_FATAL_NAMED("gazebo_ros_control", "Could not initialize robot simulation interface");
      robot_hw_sim_.reset();
      return;
    }
    controller_manager_.reset(new controller_manager::ControllerManager(robot_hw_sim_.get(), model_nh_));
  }
  catch (const pluginlib::PluginlibException& error)
  {
    ROS_FATAL_NAMED("gazebo_ros_control", "model '%s': <robotSimType>%s</robotSimType> cannot be made: %s",
                    parent_model_->GetName().c_str(), robot_hw_sim_type_str_.c_str(), error.what());
    return;
  }
  update_connection_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo&) { Update(); });
  ROS_INFO_NAMED("gazebo_ros_control", "Loaded gazebo_ros_control.");
}

// -- every step ----------------------------------------------------------------------------------------------------------------------

void GazeboRosControlPlugin::Update()
{
  const gazebo::common::Time simulated = parent_model_->GetWorld()->SimTime();
  const ros::Time now(simulated.sec, simulated.nsec);
  const ros::Duration step(parent_model_->GetWorld()->Physics()->GetMaxStepSize());
  robot_hw_sim_->eStopActive(e_stop_active_);
  const ros::Duration since =
      last_update_sim_time_ros_.isZero() ? std::max(control_period_, step) : now - last_update_sim_time_ros_;
  if (since >= control_period_)
  {
    last_update_sim_time_ros_ = now;
    robot_hw_sim_->readSim(now, since);
    const bool restart = last_e_stop_active_ && !e_stop_active_;
    last_e_stop_active_ = e_stop_active_;
    controller_manager_->update(now, since, restart);
  }
  robot_hw_sim_->writeSim(now, last_write_sim_time_ros_.isZero() ? step : now - last_write_sim_time_ros_);
  last_write_sim_time_ros_ = now;
}

void GazeboRosControlPlugin::Reset()
{
  last_update_sim_time_ros_ = ros::Time();
  last_write_sim_time_ros_ = ros::Time();
}

void GazeboRosControlPlugin::eStopCB(const std_msgs::BoolConstPtr& e_stop_active) { e_stop_active_ = e_stop_active->data; }

}  // namespace gazebo_ros_control
