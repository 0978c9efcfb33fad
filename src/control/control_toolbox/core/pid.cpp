#include <control_toolbox/pid.h>

#include <cmath>
#include <cstdlib>

#include <tinyxml.h>

namespace control_toolbox
{
namespace
{

const char* const default_namespace = "pid";

double attribute(const TiXmlElement& element, const char* name)
{
  const char* text = element.Attribute(name);
  return text ? std::atof(text) : 0.0;
}

PidGains numbers(const Pid::Gains& gains)
{
  return { gains.p_gain_, gains.i_gain_, gains.d_gain_, gains.i_max_, gains.i_min_, gains.antiwindup_ };
}

}  // namespace

Pid::Pid(double p, double i, double d, double i_max, double i_min, bool antiwindup)
{
  setGains(p, i, d, i_max, i_min, antiwindup);
}

Pid::Pid(const Pid& source) : gains_(source.gains_) {}

Pid::~Pid() = default;

Pid& Pid::operator=(const Pid& source)
{
  if (this != &source)
  {
    gains_ = source.gains_;
    reset();
  }
  return *this;
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup)
{
  setGains(p, i, d, i_max, i_min, antiwindup);
  reset();
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, const ros::NodeHandle& node)
{
  initPid(p, i, d, i_max, i_min, false, node);
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup, const ros::NodeHandle& /*node*/)
{
  initPid(p, i, d, i_max, i_min, antiwindup);
  ros::NodeHandle nh(default_namespace);
  initDynamicReconfig(nh);
}

bool Pid::initParam(const std::string& prefix, const bool quiet) { return init(ros::NodeHandle(prefix), quiet); }

bool Pid::init(const ros::NodeHandle& n, const bool quiet)
{
  ros::NodeHandle nh(n);
  Gains gains;
  if (!nh.getParam("p", gains.p_gain_))
  {
    if (!quiet)
      ROS_ERROR("No p gain specified for pid.  Namespace: %s", nh.getNamespace().c_str());
    return false;
  }
  nh.param("i", gains.i_gain_, 0.0);
  nh.param("d", gains.d_gain_, 0.0);
  const double both = std::abs(nh.param("i_clamp", 0.0));
  gains.i_max_ = std::abs(nh.param("i_clamp_max", both));
  gains.i_min_ = -std::abs(nh.param("i_clamp_min", both));
  nh.param("antiwindup", gains.antiwindup_, false);
  if (nh.param("publish_state", false))
    publisher_.reset(new realtime_tools::RealtimePublisher<control_msgs::PidState>(nh, "state", 1));
  setGains(gains);
  reset();
  initDynamicReconfig(nh);
  return true;
}

bool Pid::initXml(TiXmlElement* config)
{
  const double both = std::abs(attribute(*config, "iClamp"));
  setGains(attribute(*config, "p"), attribute(*config, "i"), attribute(*config, "d"), both, -both,
           attribute(*config, "antiwindup") != 0.0);
  reset();
  ros::NodeHandle nh(default_namespace);
  initDynamicReconfig(nh);
  return true;
}

void Pid::initDynamicReconfig(ros::NodeHandle& node)
{
  server_.reset(new Server(server_mutex_, node));
  updateDynamicReconfig();  // the gains that hold, before the callback brings those that the server found
  server_->setCallback([this](ParametersConfig& config, uint32_t level) { dynamicReconfigCallback(config, level); });
}

void Pid::reset() { law_.reset(); }

void Pid::reset(double d_error, double i_error) { law_.reset(d_error, i_error); }

void Pid::getGains(double& p, double& i, double& d, double& i_max, double& i_min)
{
  bool antiwindup;
  getGains(p, i, d, i_max, i_min, antiwindup);
}

void Pid::getGains(double& p, double& i, double& d, double& i_max, double& i_min, bool& antiwindup)
{
  const Gains gains = getGains();
  p = gains.p_gain_;
  i = gains.i_gain_;
  d = gains.d_gain_;
  i_max = gains.i_max_;
  i_min = gains.i_min_;
  antiwindup = gains.antiwindup_;
}

Pid::Gains Pid::getGains() { return *gains_.readFromRT(); }

void Pid::setGains(double p, double i, double d, double i_max, double i_min, bool antiwindup)
{
  setGains(Gains(p, i, d, i_max, i_min, antiwindup));
}

void Pid::setGains(const Gains& gains)
{
  gains_.writeFromNonRT(gains);
  updateDynamicReconfig(gains);
}

void Pid::updateDynamicReconfig()
{
  if (server_)
    updateDynamicReconfig(getGains());
}

void Pid::updateDynamicReconfig(Gains gains)
{
  if (!server_)
    return;
  ParametersConfig config;
  config.p = gains.p_gain_;
  config.i = gains.i_gain_;
  config.d = gains.d_gain_;
  config.i_clamp_max = gains.i_max_;
  config.i_clamp_min = gains.i_min_;
  config.antiwindup = gains.antiwindup_;
  updateDynamicReconfig(config);
}

void Pid::updateDynamicReconfig(ParametersConfig config)
{
  if (!server_)
    return;
  const boost::recursive_mutex::scoped_lock lock(server_mutex_);
  server_->updateConfig(config);
}

void Pid::dynamicReconfigCallback(ParametersConfig& config, uint32_t /*level*/)
{
  // Not by setGains: the server that calls tells its clients itself.
  gains_.writeFromNonRT(Gains(config.p, config.i, config.d, config.i_clamp_max, config.i_clamp_min, config.antiwindup));
}

double Pid::computeCommand(double error, ros::Duration dt)
{
  const Gains gains = *gains_.readFromRT();
  return finish(gains, dt, law_.step(numbers(gains), error, dt.toSec()));
}

double Pid::computeCommand(double error, double error_dot, ros::Duration dt)
{
  const Gains gains = *gains_.readFromRT();
  return finish(gains, dt, law_.step(numbers(gains), error, error_dot, dt.toSec()));
}

double Pid::finish(const Gains& gains, ros::Duration dt, bool counted)
{
  if (!counted)
    return 0.0;
  if (publisher_ && publisher_->trylock())
    publish(gains, dt);
  return law_.command();
}

void Pid::publish(const Gains& gains, ros::Duration dt)
{
  control_msgs::PidState& state = publisher_->msg_;
  state.header.stamp = ros::Time::now();
  state.timestep = dt;
  state.error = state.p_error = law_.p_error();
  state.i_error = law_.i_error();
  state.error_dot = state.d_error = law_.d_error();
  state.p_term = gains.p_gain_ * law_.p_error();
  state.i_term = law_.i_term();
  state.d_term = gains.d_gain_ * law_.d_error();
  state.i_max = gains.i_max_;
  state.i_min = gains.i_min_;
  state.output = law_.command();
  publisher_->unlockAndPublish();
}

double Pid::updatePid(double error, ros::Duration dt) { return -computeCommand(error, dt); }

double Pid::updatePid(double error, double error_dot, ros::Duration dt) { return -computeCommand(error, error_dot, dt); }

void Pid::setCurrentCmd(double cmd) { law_.set_command(cmd); }

double Pid::getCurrentCmd() { return law_.command(); }

void Pid::getCurrentPIDErrors(double* pe, double* ie, double* de)
{
  *pe = law_.p_error();
  *ie = law_.i_error();
  *de = law_.d_error();
}

void Pid::printValues()
{
  const Gains gains = getGains();
  ROS_INFO("PID: p %g, i %g, d %g, i_max %g, i_min %g, antiwindup %d; errors p %g, i %g, d %g; command %g", gains.p_gain_,
           gains.i_gain_, gains.d_gain_, gains.i_max_, gains.i_min_, gains.antiwindup_, law_.p_error(), law_.i_error(),
           law_.d_error(), law_.command());
}

}  // namespace control_toolbox
