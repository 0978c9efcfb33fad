// Not run: gazebo_ros_control's classes as the sources of others derive from them.
#include <gazebo_ros_control/default_robot_hw_sim.h>
#include <gazebo_ros_control/gazebo_ros_control_plugin.h>
#include <gazebo_ros_control/robot_hw_sim.h>

#if GAZEBO_MAJOR_VERSION != 11
#error "the version is missing"
#endif

class Bare : public gazebo_ros_control::RobotHWSim
{
public:
  bool initSim(const std::string&, ros::NodeHandle, gazebo::physics::ModelPtr, const urdf::Model* const,
               std::vector<transmission_interface::TransmissionInfo>) override
  {
    return true;
  }
  void readSim(ros::Time, ros::Duration) override {}
  void writeSim(ros::Time, ros::Duration) override {}
  void eStopActive(const bool) override {}
};
PLUGINLIB_EXPORT_CLASS(Bare, gazebo_ros_control::RobotHWSim)

class Derived : public gazebo_ros_control::DefaultRobotHWSim
{
public:
  void readSim(ros::Time time, ros::Duration period) override
  {
    gazebo_ros_control::DefaultRobotHWSim::readSim(time, period);
    angles::normalize_angle(joint_position_.at(0));
    for (unsigned int i = 0; i < n_dof_; ++i)
    {
      joint_effort_command_[i] = joint_velocity_command_[i] = joint_position_command_[i] = last_joint_position_command_[i] =
          0.0;
      joint_position_[i] = sim_joints_[i]->Position(0) + joint_velocity_[i] + joint_effort_[i] + joint_lower_limits_[i] +
                           joint_upper_limits_[i] + joint_effort_limits_[i];
      if (joint_control_methods_[i] == POSITION_PID || joint_control_methods_[i] == VELOCITY_PID || joint_names_[i].empty())
        pid_controllers_[i].computeCommand(joint_types_[i], period);
    }
    ej_sat_interface_.enforceLimits(period);
    ej_limits_interface_.enforceLimits(period);
    pj_sat_interface_.enforceLimits(period);
    pj_limits_interface_.enforceLimits(period);
    vj_sat_interface_.enforceLimits(period);
    vj_limits_interface_.enforceLimits(period);
    e_stop_active_ = last_e_stop_active_ || physics_type_ == "ode";
    registerInterface(&js_interface_);
    registerInterface(&ej_interface_);
    registerInterface(&pj_interface_);
    registerInterface(&vj_interface_);
    int type;
    double lower, upper, effort;
    registerJointLimits("joint", ej_interface_.getHandle("joint"), EFFORT, ros::NodeHandle(), nullptr, &type, &lower, &upper,
                        &effort);
  }
};
PLUGINLIB_EXPORT_CLASS(Derived, gazebo_ros_control::RobotHWSim)

class Plugin : public gazebo_ros_control::GazeboRosControlPlugin
{
public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    gazebo_ros_control::GazeboRosControlPlugin::Load(model, sdf);
    robot_namespace_ = model_nh_.getNamespace() + parent_model_->GetName() + sdf_->GetName();
    robot_hw_sim_type_str_ = robot_description_ = getURDF("robot_description");
    if (parseTransmissionsFromURDF(robot_description_) && !transmissions_.empty() && robot_hw_sim_)
      controller_manager_.reset(new controller_manager::ControllerManager(robot_hw_sim_.get(), model_nh_));
    robot_hw_sim_loader_.reset();
    last_update_sim_time_ros_ = last_write_sim_time_ros_ = ros::Time() + control_period_;
    e_stop_active_ = last_e_stop_active_;
    e_stop_sub_ = model_nh_.subscribe("stop", 1, &Plugin::stop, this);
    update_connection_ = gazebo::event::Events::ConnectWorldUpdateBegin(boost::bind(&Plugin::Update, this));
  }
  void Reset() override { gazebo_ros_control::GazeboRosControlPlugin::Reset(); }
  void stop(const std_msgs::BoolConstPtr& message) { eStopCB(message); }
};
GZ_REGISTER_MODEL_PLUGIN(Plugin)
