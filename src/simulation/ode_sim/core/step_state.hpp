// All that belongs to one step: made at its beginning, handed from phase to phase. After the step only its contacts are looked at.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "contact.hpp"
#include "scene.hpp"

namespace ode_sim {

// Accelerations with all joint accelerations zero, see inertia.cpp.
struct Accelerations {
  Vec3 alpha, a;
};

struct LinkStep {
  bool weighed = false;  // part of some load: forces of its contacts are wanted
  int node = -1;         // of the island search, where it has a kinematic body
  Vec3 momentum, spin;   // of a weighed link; angular momentum about StepState::origin
  Vec3 force, torque;    // gravity and wrenches on a weighed link, about the same
  Accelerations own;     // of the link origin
};

struct ClusterStep {
  int node = -1;           // of the island search
  bool iterative = false;  // solved by iterations
  bool moved = false;      // by the projection of joints
  Accelerations still;     // of the CoM, the position drives standing still
  Accelerations driven;    // the same with the position drives moving
};

// What hangs beyond a joint, as it was before the step.
struct Load {
  const std::vector<Link*>* links;  // null: they lead back
  Vec3 anchor;                      // of the joint
  Vec3 momentum, spin;              // spin: angular momentum about the anchor
  Vec3 force, torque;               // gravity and wrenches, about the anchor
};

struct JointStep {
  double speed[2] = {0, 0};            // that ODE's motor rows aim at
  Vec3 carried_force, carried_torque;  // what moving along takes, on ODE's first body
  bool projected = false;              // the links were just put where q and qd say
};

struct ModelStep {
  int contact_count = 0;
  bool touches_others = false;  // that move
  bool jump = false;            // a position drive jumps in this step or did in the last: too fast for any inertia to be felt
};

// Clusters that joints and contacts connect.
struct Island {
  std::vector<Cluster*> clusters;
  std::vector<Link*> kinematic;  // links whose own kinematic bodies its joints hang on
  int rows = 0, contact_rows = 0;
  bool joints = false, awake = false;
  bool driven = false;  // something that no force moves moves it
  bool geared = false;  // with joints that ODE does not know
};

// Bodies that a pass of a solver moves together.
struct Pass {
  std::vector<Cluster*> clusters;
  std::vector<dBodyID> bodies;  // of the clusters, and kinematic ones
  std::vector<const Island*> islands;
  void add(const Island& island);
  void enable(bool on) const;
  void clear() { clusters.clear(), bodies.clear(), islands.clear(); }
};

struct StepState {
  // Of each link, cluster ..., in the order of the scene; their `at` is the place.
  std::vector<LinkStep> links;
  std::vector<ClusterStep> clusters;
  std::vector<JointStep> joints;
  std::vector<ModelStep> models;
  std::vector<std::pair<Joint*, Load>> loads;  // beyond position drives that are watched
  std::vector<Link*> weighed;                  // each link of the loads once
  Vec3 origin;                                 // what they are weighed about: where the first of them was before the step

  std::vector<std::pair<Shape*, Shape*>> pairs;  // whose bounding boxes overlap
  std::vector<Contact> contacts;
  std::vector<dJointFeedback> feedback;  // of the contacts
  std::vector<dContact> ode_contacts;    // as ODE has them, for solvers of our own
  std::vector<dJointID> weld_joints;     // of each weld of the scene; null where it connects nothing

  std::vector<Cluster*> nodes;  // that have a body which forces move
  std::vector<Island> islands;
  std::vector<Cluster*> left_behind;  // that rest on what wakes in this step: they wake after it, having no contacts in it
  std::vector<BodyState> before;      // the bodies of the nodes before the solver
  Pass exact, touching, iterative;
  std::vector<const Island*> trees, piles;  // for solvers of our own

  void forget();                       // the step before
  void number(Scene& scene);           // gives everything its place in the lists above
  void number_clusters(Scene& scene);  // after they were put together anew
  LinkStep& of(const Link& link) { return links[link.at]; }
  const LinkStep& of(const Link& link) const { return links[link.at]; }
  ClusterStep& of(const Cluster& cluster) { return clusters[cluster.at]; }
  const ClusterStep& of(const Cluster& cluster) const { return clusters[cluster.at]; }
  JointStep& of(const Joint& joint) { return joints[joint.at]; }
  ModelStep& of(const Model& model) { return models[model.at]; }
  const ModelStep& of(const Model& model) const { return models[model.at]; }
  dJointID weld_joint(const Scene& scene, const Weld& weld) const {
    const size_t i = static_cast<size_t>(&weld - scene.welds.data());
    return i < weld_joints.size() ? weld_joints[i] : nullptr;
  }
};

}  // namespace ode_sim
