// A service that sets the gains of several PIDs.
#pragma once

#include <string>
#include <vector>

#include <control_toolbox/SetPidGains.h>
#include <control_toolbox/pid.h>
#include <ros/node_handle.h>

namespace control_toolbox
{

/// The service set_gains (control_toolbox/SetPidGains) sets the gains of all PIDs that were added.
class PidGainsSetter
{
public:
  ~PidGainsSetter() { server_.shutdown(); }

  /// \param pid lives as long as this
  PidGainsSetter& add(Pid* pid)
  {
    pids_.push_back(pid);
    return *this;
  }

  void advertise(const ros::NodeHandle& n)
  {
    node_ = n;
    server_ = node_.advertiseService("set_gains", &PidGainsSetter::setGains, this);
  }
  void advertise(const std::string& ns) { advertise(ros::NodeHandle(ns)); }

  bool setGains(SetPidGains::Request& req, SetPidGains::Response& /*resp*/)
  {
    for (Pid* pid : pids_)
      pid->setGains(req.p, req.i, req.d, req.i_clamp, -req.i_clamp, req.antiwindup);
    node_.setParam("p", req.p);
    node_.setParam("i", req.i);
    node_.setParam("d", req.d);
    node_.setParam("i_clamp", req.i_clamp);
    node_.setParam("antiwindup", static_cast<bool>(req.antiwindup));
    return true;
  }

private:
  ros::NodeHandle node_;
  ros::ServiceServer server_;
  std::vector<Pid*> pids_;
};

}  // namespace control_toolbox
