// Joints that are read into, and commanded from, numbers that somebody else keeps: one call a step for all joints of a robot.
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "joint.hpp"

namespace ode_sim {

// How far a command may go in one cycle. The rules are those of ros_control's joint_limits_interface; its handles in Python say more.
struct CommandLimits {
  enum Rule { PositionSaturation, PositionSoft, VelocitySaturation, VelocitySoft, EffortSaturation, EffortSoft };
  Rule rule = PositionSaturation;
  bool has_position = false;
  double low = -kInf, high = kInf;  // rad or m
  double velocity = kInf, acceleration = kInf, effort = kInf;
  double soft_low = 0, soft_high = 0, k_position = 0, k_velocity = 0;
};

// Least and greatest command. previous: the one before.
std::pair<double, double> corridor(const CommandLimits& limits, double position, double velocity, double previous, double dt);

// A command within the corridor. `held` takes the place of one that is no usable number.
double kept_within(double command, double low, double high, double held);

class Wiring {
 public:
  // Where the numbers of a joint are; null for what is not there. They must last as long as this.
  struct Places {
    double *position = nullptr, *velocity = nullptr, *effort = nullptr;
  };
  struct Command {
    double *command = nullptr, *slope = nullptr;  // slope: of the law behind an effort, see Axis::law
    CommandLimits limits;
    double effort_limit = kInf;
  };
  // A command that was no usable number, and what was commanded instead.
  struct Refused {
    int command;
    double wanted, held;
  };

  int add_joint(std::shared_ptr<Joint> joint, const Places& places);
  int add_command(int joint, const Command& command);  // its number; it rests until it is set to work
  void set_working(int command, bool on) { commands_.at(command).working = on; }
  // Whether the effort of a joint is what its drive or motor bears. The joint must be watched.
  void report_load(int joint, bool on) { joints_.at(joint).by_load = on; }
  // The command before, from which the next one starts; NaN: the measured position.
  double previous(int command) const { return commands_.at(command).previous; }
  void set_previous(int command, double value) { commands_.at(command).previous = value; }

  void read();
  std::vector<Refused> write(double dt);  // dt: s since the last time

 private:
  struct Wired {
    std::shared_ptr<Joint> joint;
    Places places;
    bool by_load = false;
  };
  struct Working : Command {
    int joint = 0;
    bool working = false;
    double previous = 0;
  };
  std::vector<Wired> joints_;
  std::vector<Working> commands_;

  void give(const Working& c, double wanted);
};

}  // namespace ode_sim
