// What there is in a world, as plain data: models of links, shapes and joints.
//
//   Scene --- Model --- Link  --- Shape (one ODE geom, placed by us from the link pose)
//                   \--- Joint (see joint.hpp)
//
// Links that are rigidly joined at the moment form a Cluster, see cluster.hpp.
#pragma once
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cluster.hpp"
#include "height_grid.hpp"
#include "joint.hpp"
#include "limits.hpp"
#include "math.hpp"
#include "ode.hpp"

namespace ode_sim {

class World;
struct Model;
struct Link;

struct Surface {
  Model* model = nullptr;  // that it is part of
  double mu = 1, mu2 = 1, slip1 = 0, slip2 = 0, kp = 1e12, kd = 1, max_vel = 0.01, min_depth = 0;
  double restitution = 0, bounce_threshold = 1e5;
  // Torsional friction: of the patch on which it rests (radius, m), or of the curvature there (radius, m; very large: flat) and the depth.
  double torsional_mu = 1, torsional_slip = 0, patch_radius = 0, surface_radius = 1e15;
  bool use_patch_radius = true;
  Vec3 fdir1;  // in the collision frame, zero = none
  unsigned collide_bitmask = 0xFFFF;
  bool collide_without_contact = false;
};

// Triangles with the tree that ODE searches; shared by the shapes that have them.
struct MeshData {
  MeshData(std::vector<double> vertices, std::vector<dTriIndex> indices);
  MeshData(const MeshData&) = delete;
  MeshData& operator=(const MeshData&) = delete;
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
  Vec3 middle;       // of a sphere round all corners
  double reach = 0;  // m, its radius
  OwnedMesh data;
};

struct Shape {
  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  void release();  // the geoms; the shape collides no more

  int id = 0;  // unique in the world, ascending in order of creation
  Link* link = nullptr;
  // What the geoms point into comes before them, and so ends after them.
  std::shared_ptr<MeshData> mesh, faceted_mesh;
  HeightGrid grid;
  OwnedField field;
  OwnedGeom geom;
  OwnedGeom faceted;          // a cylinder's stand-in against shapes that ODE cannot collide with it
  bool infinite = false;      // a plane: fixed in the world
  bool wheel = false;         // a cylinder, or a mesh as round as one, that turns on a hinge about its own axis
  Vec3 axle{0, 0, 1}, tread;  // of a wheel: its axis and the middle of its tread, in the shape's frame
  void look_for_tread(const Vec3& axis, const Vec3& on_axis);  // of the hinge, in the link's frame
  bool out_of_reach = false;                                   // beyond where ODE can collide
  Pose X_LC;
  Vec3 plane_normal{0, 0, 1};  // world axes
  Surface surface;
  int max_contacts = 10;
  bool watched = false;
};

// The surface of a link that runs round it, as a track's does, for the next step. World axes.
struct Belt {
  double speed = 0;  // m/s, of driving forwards
  Vec3 left;         // unit; forwards is at right angles to it and to the ground
  bool told = false;
  // The motion that the vehicle is meant to make, of its point `at`: friction that is not the same in both directions takes its first
  // one along it.
  Vec3 v, w, at;

  // n: normal of a contact, into the link.
  Vec3 forwards(const Vec3& n) const {
    const Vec3 f = cross(left, n);
    return norm(f) > 1e-6 ? f * (1 / norm(f)) : Vec3{};
  }
  Vec3 surface_velocity(const Vec3& n) const { return forwards(n) * -speed; }
  Vec3 meant(const Vec3& p, const Vec3& n) const {
    const Vec3 motion = v + cross(w, p - at);
    return norm(motion - n * dot(n, motion)) > 1e-6 ? motion : forwards(n);
  }
};

struct Link {
  int id = 0;
  int row = 0;  // in link_poses
  int at = 0;   // in StepState::links
  Model* model = nullptr;
  OwnedBody body;
  double mass = 1;
  Vec3 com;      // in the link frame
  Sym3 inertia;  // about the CoM, link axes
  bool gravity = true, kinematic = false, self_collide = false;
  double linear_decay = 0, angular_decay = 0;
  std::vector<std::shared_ptr<Shape>> shapes;
  Joint* parent_joint = nullptr;  // the first joint whose child it is
  std::vector<Joint*> joints;     // all that it has a part in, in order of creation
  double size = 0.05;             // m, reach of its shapes from its origin

  Pose X_WL;
  Vec3 v, w;           // of the link origin, world axes
  Vec3 force, torque;  // about the CoM, world axes, for the next step
  Belt belt;
  Vec3 applied_force, applied_torque;  // those of the last step

  // Place in the cluster, see assembly.cpp.
  int cluster = -1;
  Joint* up = nullptr;  // merged joint towards the root
  Link* up_link = nullptr;
  bool moving = false;   // a position drive lies between it and the root
  bool led = false;      // of a static model, moved from outside for the next step: what it touches is pushed at its velocity
  Pose X_was;            // of one that is led: where it was in the last step
  bool carrier = false;  // its own body moves kinematically, because an ODE joint hangs on it
  Pose X_RL;             // in the root link's frame (in the world for anchored clusters)
  int visit = 0;         // number of the search that came by last, see links_beyond

  Vec3 com_W() const { return X_WL * com; }
  Vec3 velocity_at(const Vec3& p) const { return v + cross(w, p - X_WL.p); }
};

struct Model {
  int id = 0;
  int at = 0;  // in StepState::models
  std::string name;
  World* world = nullptr;  // null when it was removed
  bool is_static = false, self_collide = false, may_sleep = false;
  double mass = 0;        // kg, of all links
  bool finished = false;  // built, and part of the shared arrays
  std::vector<std::shared_ptr<Link>> links;
  std::vector<std::shared_ptr<Joint>> joints, gone;  // gone: those that let go, for whom still holds them
  std::set<std::pair<int, int>> jointed;             // ids of links that a joint connects: they never collide

  // What follows from it for the time being, see assembly.cpp.
  bool dirty = true;     // to be put together anew
  bool changed = false;  // in a way that what touches it feels
  bool has_drives = false;
  bool loop = false;  // a closed loop runs over carried bodies
  std::vector<Cluster> clusters;
  std::vector<Branch> tree;
  std::vector<int> tree_heads;

  std::set<std::pair<int, int>> exempt;  // shape pairs that already touched when the position drives were engaged
  bool take_exempt = false;
  double led_seconds = 0;  // since its links were where they were in the last step; 0: they are not led
  double emerging = 0;     // s, for which it still counts as what was put deep into something static and comes out of it
  int visits = 0;          // searches that went over its links
};

// Two links of any models held together while the world runs, or a link held where it is in the world.
struct Weld {
  int id = 0;                    // never given twice
  std::shared_ptr<Link> parent;  // null = the world
  std::shared_ptr<Link> child;
  Pose X_PC;
  dJointFeedback feedback{};  // of the last step in which it was solved for
};

inline Cluster& cluster_of(const Link& link) { return link.model->clusters[link.cluster]; }
// The body that a joint on this link holds; none for the world and what hangs rigidly from it.
dBodyID body_of(const Link* link);
// Pose of the link in its body's frame; in the world when it has none.
Pose X_BL(const Link& link);
// Links beyond a joint: those reached from its child without crossing it. `loop` tells whether they lead back. In memory of the joint, until
// it is asked again.
const std::vector<Link*>& links_beyond(Joint& joint, bool* loop = nullptr);
// The mass of all, and whether the links beyond each joint could be real bodies of their size: radius of gyration against reach.
void judge_masses(Model& model);

}  // namespace ode_sim
