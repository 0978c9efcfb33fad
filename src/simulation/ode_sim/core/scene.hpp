// All that lasts from step to step, as plain data. The phases of a step are functions of a Scene and a StepState.
#pragma once
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "broad_phase.hpp"
#include "contact.hpp"
#include "mesh_piece.hpp"
#include "model.hpp"
#include "separation.hpp"

namespace ode_sim {

constexpr int kMostExactRows =
    1500;  // 250 joints; the direct solver's time grows with the third power, its memory with the second

// Read at every step.
struct Settings {
  double dt = 0.001;
  Vec3 gravity{0, 0, -9.8};
  double erp = 0.2, cfm = 0, sor = 1.3, contact_max_vel = 100, surface_layer = 0.001;
  int iters = 50, max_contacts = 20;
  bool like_gazebo = false;  // `solver: gazebo`: one iterative solver, contacts and joints as Gazebo Classic has them
  uint64_t seed = 0;
  double contact_softness = 0.02, friction_softness = 1e-5;
  int direct_rows = 160;  // islands with joints up to this many constraint rows use the direct solver
  int heap_rows = 60;     // the same, for islands of contacts alone
};

struct Counters {
  uint64_t direct = 0, trees = 0, piles = 0, quick = 0, fallbacks = 0, promotions = 0, contacts = 0;
};

// What the user is to be told, each line once.
class Messages {
 public:
  void report(const std::string& text, const std::string& who) {
    const std::string line = (who.empty() ? "" : who + ": ") + text;
    if (counts_[line]++ == 0) unread_.push_back(line);
  }
  bool any() const { return !unread_.empty(); }
  std::vector<std::string> take() { return std::exchange(unread_, {}); }

 private:
  std::map<std::string, int> counts_;
  std::vector<std::string> unread_;
};

struct Scene {
  Settings settings;
  Settings settled;  // those that sleepers have fallen asleep under
  uint64_t iterations = 0;
  int64_t time_ns = 0;
  int64_t next_time_ns() const { return time_ns + std::llround(settings.dt * 1e9); }  // of the state that the next step makes
  Counters counters;
  Messages messages;

  OwnedWorld ode;
  OwnedJointGroup step_joints;  // contacts and welds of the step under way
  std::vector<std::shared_ptr<Model>> models;
  std::map<int, Shape*> shapes;  // by id
  std::vector<Weld> welds;
  std::shared_ptr<Model>
      bonds;  // without links: of the joints that came while the world ran, see connections.cpp; null: none ever did
  BroadPhase broad_phase;
  MeshPieces mesh_pieces;
  Separations separations;
  std::vector<Borne> borne;  // in the last step, in the order of its contacts

  std::vector<Cluster*> carried;  // from the carrying to the carried
  bool replan = false;            // who carries whom is to be found out anew

  // Shared with Python. Made anew when models come and go: who still looks at the old ones may go on doing so.
  using Array = std::shared_ptr<std::vector<double>>;
  Array link_poses = std::make_shared<std::vector<double>>(), joint_positions = std::make_shared<std::vector<double>>(),
        joint_velocities = std::make_shared<std::vector<double>>();

  Shape* find_shape(int id) const {
    const auto it = shapes.find(id);
    return it == shapes.end() ? nullptr : it->second;
  }
};

}  // namespace ode_sim
