// The phases of a step, and what else works on a Scene, by the file that has them. world.hpp is what Python sees.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene.hpp"
#include "step_state.hpp"

namespace ode_sim {

// step.cpp
void step_once(Scene& scene, StepState& state);
void abandon_step(Scene& scene, StepState& state);  // after an OdeFailure

// assembly.cpp: clusters of links, and their bodies
void assemble(Scene& scene, Model& model);
void compose(Cluster& cluster);  // poses of the members in the root frame from the joint positions, and the composite mass
void place_cluster(Cluster& cluster);  // its body to where its root link is, moving as the root link moves
void spread_poses(Cluster& cluster);
void spread_twists(Cluster& cluster, bool drives = true);

// carried.cpp: what hangs on links that position drives move
void refresh(Scene& scene);     // brings all clusters up to date, and wakes what feels the change
void reassemble(Scene& scene);  // the same, and wakes nobody
void plan_carried(Scene& scene);
void hold_true_velocities(Scene& scene);
void spread_carried(Scene& scene);
void keep_relations(Scene& scene);
void carry_along(Scene& scene);

// inertia.cpp: forces that come from motion
void apply_inertial_forces(const Scene& scene, StepState& state, Model& model);
void follow_drives(Scene& scene, StepState& state);

// drives.cpp: position drives
void set_rates(Scene& scene, StepState& state, Model& model);
bool promote(Scene& scene, StepState& state);
void demote(Scene& scene);
double motor_load(const Scene& scene, Joint& joint);  // N m or N that the motor of a drive may give
void integrate_drives(const Scene& scene);

// forces.cpp: what acts on links and joints
void apply_forces(Scene& scene, StepState& state);

// joints.cpp: ODE's joints
void install(Scene& scene, Joint& joint);
void read_joint(Joint& joint);
void read_feedback(Joint& joint, JointStep& step);
void set_limot(const Joint& joint, int axis, int parameter, double value);
void make_weld_joints(Scene& scene, StepState& state);
bool welded(const Scene& scene, const Link& a, const Link& b);

// projection.cpp: trees of ODE joints put where their angles say
void plan_tree(Model& model);
void project_joints(const Scene& scene, StepState& state, Model& model);

// collisions.cpp: who touches, and where
void collide(Scene& scene, StepState& state);
bool touching(Scene& scene, const Shape& a, const Shape& b);  // whether they may push each other or not

// waking.cpp: what sleeps
void wake(Scene& scene, Model& model);           // and all that rests on it
void disturb(Scene& scene, const Model& model);  // wakes all that touches it, and what rests on that
std::vector<Cluster*> resting_on(Scene& scene, const std::vector<Cluster*>& others);
void rouse_all(const std::vector<Cluster*>& clusters);
void look_for_changes(Scene& scene);  // of settings and of models since this was called last: what they hold wakes

// contacts.cpp: joints of contacts. friction.cpp: friction, and what contacts bore
void make_contact_joints(Scene& scene, StepState& state);
std::vector<ContactRecord> contact_records(const StepState& state);
void set_friction(const Scene& scene, const StepState& state, Contact& contact, const Vec3& n, dContact& d);
double borne_by_contact(const Scene& scene, const StepState& state, const Contact& contact);
void remember_loads(Scene& scene, const StepState& state);
void forget_loads(Scene& scene, const Model& model);

// islands.cpp, solve.cpp, gazebo_step.cpp, own_step.cpp: what moves together, what is at rest, and the solvers
void find_islands(Scene& scene, StepState& state);
void rest(const Scene& scene, Island& island, std::vector<Cluster*>& woken);
void solve(Scene& scene, StepState& state);
void solver_pass(Scene& scene, bool direct, int iterations);
void run_like_gazebo(Scene& scene, StepState& state, const Pass& pass);
uint64_t order_seed(const Scene& scene);
void run_pile(Scene& scene, StepState& state, const Island& island);
bool run_trees(Scene& scene, StepState& state,
               const Island& island);  // false: nothing was done, too much is left to iterations
void guard_numbers(Scene& scene, StepState& state);

// loads.cpp: forces of joints that ODE does not have
void weigh(const Scene& scene, StepState& state, Model& model);
void read_loads(const Scene& scene, StepState& state);

// results.cpp: from the bodies to the links, from the links to whoever looks
void pull(Scene& scene, bool drives = true);
void place_shapes(Scene& scene, Link& link);
void take_led_velocities(Scene& scene);  // commands.cpp: of links that were led since the last step
void forget_led(Scene& scene);
// Shapes and shared arrays from the links; first the readings of joints, but for those of which they are known.
void publish(Scene& scene, const std::function<bool(const Joint&)>& known);
void read_back(Scene& scene);

// snapshot.cpp
std::string save(Scene& scene);
void restore(Scene& scene, const std::string& data, const std::vector<int>& weld_ids);

}  // namespace ode_sim
