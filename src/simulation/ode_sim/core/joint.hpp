// Joints as plain data, and the pure functions of their state.
#pragma once
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "math.hpp"
#include "ode.hpp"

namespace ode_sim {

struct Link;
struct Model;
struct Joint;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kUnlimited = 1e8;  // limits of this size and more (1e9, 1e16) mean none

// A screw's axes are its angle and the way that goes with it. A gearbox holds nothing together: it makes two links turn at a ratio, each about
// its axis of the joint, the child about the first.
enum class JointType { Revolute, Prismatic, Fixed, Universal, Ball, Screw, Gearbox };

// What a position drive is at the moment: Locked moves its links exactly as told, Motor pushes with limited force.
enum class DriveMode { Off, Locked, Motor };

struct Axis {
  Vec3 xyz{0, 0, 1};  // in the joint frame
  double lower = -kInf, upper = kInf, effort = -1, velocity = -1, damping = 0, friction = 0, spring_reference = 0,
         spring_stiffness = 0;
  // State.
  double q = 0, qd = 0, force = 0, applied = 0;  // applied: the force of the last step
  bool commanded = false;                        // a force was added since the last step
  // The part of the force that a controller gives at the speed qd, before its bound; it gives `slope` less per unit of speed.
  // A negative slope is that of a law of the position alone. Where nothing else damps the joint, what was given is taken as at rest,
  // and gets less with all of the speed.
  double law = 0, slope = 0, law_bound = 0;
  double motor_velocity = 0, motor_force = 0;

  double effort_now() const { return commanded ? force : applied; }
  void relax() { qd = force = applied = law = slope = 0, commanded = false; }
  void stepped() { applied = force, force = law = slope = 0, commanded = false; }
  // What the limits of effort and speed leave of a force.
  double admitted(double f) const {
    if (velocity >= 0 && ((qd > velocity && f > 0) || (qd < -velocity && f < 0))) return 0;
    return effort >= 0 ? std::min(std::max(f, -effort), effort) : f;
  }
  double steepness() const { return slope < 0 ? -slope : slope; }
  bool undamped() const { return slope < 0 && friction <= 0 && damping <= 0; }
  double law_at_rest() const { return undamped() ? law : law + steepness() * qd; }
  double lawful() const { return admitted(std::min(std::max(law, -law_bound), law_bound)); }
};

// What is asked of an axis for the next step. Each refuses NaN, and cuts what is beyond the bounds of limits.hpp.
void add_force(Axis& axis, double force);
void add_law(Axis& axis, double force, double slope, double bound);
void set_motor(Axis& axis, double velocity, double most_force);  // until it is changed

struct Feedback {
  Vec3 child_force, child_torque, parent_force, parent_torque;  // world axes, torques about the joint anchor
};

struct Joint {
  int id = 0;
  int index = 0;  // in the model
  int row = 0;    // in joint_positions (first axis)
  int at = 0;     // in StepState::joints
  Model* model = nullptr;
  JointType type = JointType::Revolute;
  Link* parent = nullptr;  // null = the world
  Link* child = nullptr;
  Pose X_PJ, X_CJ;  // joint frame in the parent (or the world) at zero, and in the child
  int axis_count = 1;
  double thread_pitch = 1;    // of a screw, rad/m: the child goes by -angle / thread_pitch along the axis
  double gear_ratio = 1;      // of a gearbox: the child turns at -gear_ratio times the rate of the parent
  Link* reference = nullptr;  // of a gearbox: angles are seen from it; null = from the world
  Quat q_RJ;                  // of a gearbox: the joint frame in the reference, with both angles at zero
  Axis axes[2];
  double stop_erp = 0.2, stop_cfm = 0;
  bool implicit_spring_damper = false;
  bool watched = false;  // force and torque wanted
  Feedback feedback;

  // Position drive.
  DriveMode drive = DriveMode::Off;
  double target = 0, previous_target = 0, rate = 0;  // rate: commanded for the step under way
  double previous_rate = 0;                          // of the step before
  int released = 0;                                  // steps without contact beyond, in Motor mode
  bool catching_up = false;                          // back from Motor mode but off its command: the way back is rate-limited
  std::weak_ptr<Joint> leader;                       // of any model; gone when that is removed
  double multiplier = 1, offset = 0;

  // In ODE.
  OwnedJoint joint;
  dJointFeedback ode_feedback{};
  double sign = 1;                     // -1 when the parent is ODE's first body
  bool sane = true;                    // what is beyond has inertias that bodies of its size can have
  double inverse_inertia[2] = {0, 0};  // about the axis, of the two bodies taken alone
  std::vector<Link*> beyond;           // what links_beyond has found
  double borne[12] = {};               // by each row in the last step, as `solver: gazebo` starts from it
  Vec3 spin_before;                    // of a ball: of the link that it moves, at the beginning of the last step, world axes

  // What one unit of the first axis is: radians about it, and metres along it.
  double turns() const { return type == JointType::Revolute || type == JointType::Screw ? 1 : 0; }
  double slides() const { return type == JointType::Prismatic ? 1 : type == JointType::Screw ? -1 / thread_pitch : 0; }
  bool holds() const { return type != JointType::Gearbox; }
  bool unknown_to_ode() const { return type == JointType::Screw || type == JointType::Gearbox; }
  // Axes on which motors, stops and forces act; a force along a screw acts on the second.
  int driven_axes() const { return type == JointType::Screw ? 1 : holds() ? axis_count : 0; }

  // The child's link is one body with the parent's for the time being.
  bool merged() const { return (type == JointType::Fixed && !watched) || drive == DriveMode::Locked; }
  Pose motion(double q) const;  // child's joint frame in the parent's
  Pose motion() const;          // the same at the present position, for every type but Ball and Gearbox
  Pose frame_W() const;         // of the parent's side
  Pose child_frame_W() const;
  Quat reference_W() const;  // of a gearbox: the frame that its angles are seen from
};

// Of a screw and of a gearbox, for the next step; of a joint of another type they mean nothing. They refuse what no joint can have.
void set_thread_pitch(Joint& joint, double pitch);  // rad/m; the nut stays where it is
void set_gear_ratio(Joint& joint, double ratio);

}  // namespace ode_sim
