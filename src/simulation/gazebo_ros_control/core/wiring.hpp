// The way of a command from the numbers of ros_control's handles to ODE, and of the joint's state back: one call a step for all joints
// of a robot. It is the only way of plain commands; those of a PID come from joint_sim.py.
//
//   controller -> *command -> CommandLimiter (joint_limits_interface/limit_law.h) -> drive, motor or force of ode_sim's joint
//
// Threads: all of it belongs to the thread that steps the world; read() and write() wait for nothing.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <joint_limits_interface/limit_law.h>

#include "actuation.hpp"

namespace gazebo_ros_control
{

class Wiring
{
public:
  /// Where the numbers of a joint are; null for what is not there. They must last as long as this, and so must the joint.
  struct Places
  {
    double* position = nullptr;
    double* velocity = nullptr;
    double* effort = nullptr;
  };
  struct Command
  {
    double* command = nullptr;
    double* slope = nullptr;  // of the law behind an effort: how much less it gives per unit of speed
    std::shared_ptr<joint_limits_interface::CommandLimiter> limiter;
    double effort_limit = std::numeric_limits<double>::infinity();
  };
  /// A command that was no usable number; the last one took its place.
  struct Refused
  {
    int command;
    double wanted;
  };

  /// \return its number \throws std::invalid_argument there is no place for its position or velocity
  int add_joint(ode_sim::Joint& joint, const Places& places);
  /// \return its number; it rests until it is engaged \throws std::out_of_range, std::invalid_argument no such joint; no place or limiter
  int add_command(int joint, const Command& command);
  /// The joint is commanded by this from now on; -1: by none.
  void engage(int joint, int command);
  /// Whether the effort of a joint is what its drive or motor bears. The joint must be watched.
  void report_load(int joint, bool on) { joints_.at(joint).by_load = on; }
  /// Emergency stop: while it lasts positions stay where they are, motors stand, efforts are 0.
  void stop(bool active);

  /// Positions, velocities and loads of the joints into their places.
  void read();
  /// \param dt s since the last time \throws std::runtime_error a model is no longer in the world
  std::vector<Refused> write(double dt);

private:
  struct Wired
  {
    ode_sim::Joint* joint = nullptr;
    Places places;
    bool by_load = false;
    int engaged = -1;
    double stopped_at = 0.0;
  };

  void give(const Wired& wired, const Command& command, double wanted);

  std::vector<Wired> joints_;
  std::vector<Command> commands_;
  bool stopped_ = false;
};

}  // namespace gazebo_ros_control
