// The physics core: models of links and joints stepped by ODE, independent of Python.
//
//   World --- Model --- Link  --- Shape (one ODE geom, placed by us from the link pose)
//                  \--- Joint
//
// Links that are rigidly joined at the moment - by fixed joints, or by position-commanded ("servo") joints - form a
// Cluster: one ODE body with composite mass, or no body when it hangs from the world. Every link owns one dBody, created
// with it; a cluster uses that of its root link, so that the order of bodies, and with it every sum, never depends on the past.
//
// What hangs by ODE joints (or ties) on a link that servo joints move is "carried". Where the world holds the cluster, that
// link has a kinematic body. Where it floats, the joints hang on the cluster's body itself: their forces act on all of it. The
// body of a carried cluster then holds its velocity without what the servo joints give it (Cluster::carry), in which frame
// the joints close; after the step it is moved along with the link.
#pragma once
#include <ode/ode.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "broad_phase.hpp"
#include "limits.hpp"
#include "math.hpp"

namespace ode_sim {

namespace gazebo_like {
struct Body;
struct Row;
}  // namespace gazebo_like

class World;
struct Model;
struct Link;
struct Joint;

void initialise_ode();  // for the calling thread

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kMostExactRows = 1500;  // 250 joints; the direct solver's time grows with the third power, its memory with the second
constexpr double kUnlimited = 1e8;  // limits of this size and more (1e9, 1e16) mean none

struct Surface {
  double mu = 1, mu2 = 1, slip1 = 0, slip2 = 0, kp = 1e12, kd = 1, max_vel = 0.01, min_depth = 0;
  double restitution = 0, bounce_threshold = 1e5;
  Vec3 fdir1;  // in the collision frame, zero = none
  unsigned collide_bitmask = 0xFFFF;
  bool collide_without_contact = false;
};

// Triangles with the tree that ODE searches; shared by the shapes that have them.
struct MeshData {
  MeshData(std::vector<double> vertices, std::vector<dTriIndex> indices);
  ~MeshData();
  MeshData(const MeshData&) = delete;
  MeshData& operator=(const MeshData&) = delete;
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
  dTriMeshDataID data;
};

struct Shape {
  Shape() = default;
  ~Shape() { release(); }
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  void release();  // the geoms; the shape collides no more

  int id = 0;  // unique in the world, ascending in order of creation
  Link* link = nullptr;
  dGeomID geom = nullptr;
  dGeomID faceted = nullptr;  // a cylinder's stand-in against shapes that ODE cannot collide with it
  std::shared_ptr<MeshData> mesh, faceted_mesh;
  dHeightfieldDataID field = nullptr;
  std::vector<double> heights;
  bool infinite = false;  // a plane: fixed in the world
  bool wheel = false;     // a cylinder, or a mesh as round as one, that turns on a hinge about its own axis
  Vec3 axle{0, 0, 1}, tread;  // of a wheel: its axis and the middle of its tread, in the shape's frame
  void look_for_tread(const Vec3& axis, const Vec3& on_axis);  // of the hinge, in the link's frame
  bool out_of_reach = false;  // beyond where ODE can collide
  Pose X_LC;
  Vec3 plane_normal{0, 0, 1};  // world axes
  Surface surface;
  int max_contacts = 10;
  bool watched = false;
};

struct Link {
  int id = 0;
  int row = 0;  // in link_poses
  Model* model = nullptr;
  dBodyID body = nullptr;
  double mass = 1;
  Vec3 com;       // in the link frame
  Sym3 inertia;   // about the CoM, link axes
  bool gravity = true, kinematic = false, self_collide = false;
  double linear_decay = 0, angular_decay = 0;
  std::vector<std::shared_ptr<Shape>> shapes;

  Pose X_WL;
  Vec3 v, w;            // of the link origin, world axes
  Vec3 force, torque;   // about the CoM, world axes, for the next step
  Vec3 applied_force, applied_torque;  // those of the last step

  // Place in the cluster.
  int cluster = -1;
  Joint* up = nullptr;   // merged joint towards the root
  Link* up_link = nullptr;
  bool moving = false;   // a servo joint lies between it and the root
  bool weighed = false;  // part of some load: forces of its contacts are wanted
  bool carrier = false;  // its own body moves kinematically, because an ODE joint hangs on it
  Vec3 alpha, a;         // of the link origin, with all joint accelerations zero (see World::accelerations)
  Pose X_RL;             // in the root link's frame (in the world for anchored clusters)
  Joint* parent_joint = nullptr;  // the first joint whose child it is
  std::vector<Joint*> joints;     // all that it has a part in, in order of creation
  int visit = 0;                  // of the search that came by last
  int node = -1;                  // of the island search, where it has a kinematic body
  double size = 0.05;  // m, reach of its shapes from its origin

  Vec3 com_W() const { return X_WL * com; }
  Vec3 velocity_at(const Vec3& p) const { return v + cross(w, p - X_WL.p); }
};

enum class JointType { Revolute, Prismatic, Fixed, Universal, Ball };
enum class ServoMode { Off, Locked, Motor };

struct Axis {
  Vec3 xyz{0, 0, 1};  // in the joint frame
  double lower = -kInf, upper = kInf, effort = -1, velocity = -1, damping = 0, friction = 0, spring_reference = 0,
         spring_stiffness = 0;
  // State.
  double q = 0, qd = 0, force = 0, applied = 0;  // applied: the force of the last step
  bool commanded = false;                        // a force was added since the last step
  // The part of the force that a controller gives at the speed qd, before its bound; it gives `slope` less per unit of speed.
  double law = 0, slope = 0, law_bound = 0;
  double motor_velocity = 0, motor_force = 0;
  double drive = 0;  // speed that ODE's motor row aims at in the step under way

  double effort_now() const { return commanded ? force : applied; }
  void relax() { qd = force = applied = law = slope = 0, commanded = false; }
  void stepped() { applied = force, force = law = slope = 0, commanded = false; }
  // What the limits of effort and speed leave of a force.
  double admitted(double f) const {
    if (velocity >= 0 && ((qd > velocity && f > 0) || (qd < -velocity && f < 0))) return 0;
    return effort >= 0 ? std::min(std::max(f, -effort), effort) : f;
  }
  double lawful() const { return admitted(std::min(std::max(law, -law_bound), law_bound)); }
};

struct Feedback {
  Vec3 child_force, child_torque, parent_force, parent_torque;  // world axes, torques about the joint anchor
};

// What hangs beyond a joint, as it was before the step.
struct Load {
  std::vector<Link*> links;  // empty: not wanted, or the links lead back
  Vec3 anchor;               // of the joint
  Vec3 momentum, spin;       // spin: angular momentum about the anchor
  Vec3 force, torque;        // gravity and wrenches, about the anchor
};

struct Joint {
  int id = 0;
  int index = 0;  // in the model
  int row = 0;  // in joint_positions (first axis)
  Model* model = nullptr;
  JointType type = JointType::Revolute;
  Link* parent = nullptr;  // null = the world
  Link* child = nullptr;
  Pose X_PJ, X_CJ;  // joint frame in the parent (or the world) at zero, and in the child
  int axis_count = 1;
  Axis axes[2];
  double stop_erp = 0.2, stop_cfm = 0;
  bool implicit_spring_damper = false;
  bool watched = false;  // force and torque wanted

  ServoMode servo = ServoMode::Off;
  double target = 0, previous_target = 0, rate = 0;  // rate: commanded for the step under way
  double previous_rate = 0;                           // of the step before
  int released = 0;  // steps without contact beyond, in Motor mode
  double load = 0;   // N m or N held against gravity, in Motor mode
  std::weak_ptr<Joint> leader;  // of any model; gone when that is removed
  double multiplier = 1, offset = 0;

  dJointID joint = nullptr;
  dJointFeedback ode_feedback{};
  Feedback feedback;
  Load load_beyond;  // of a servo joint that is watched
  Vec3 carried_force, carried_torque;  // of the step under way: what moving along takes, on ODE's first body
  double sign = 1;  // -1 when the parent is ODE's first body
  bool sane = true;
  bool projected = false;  // the links were just put where q and qd say
  double inverse_inertia[2] = {0, 0};  // about the axis, of the two bodies taken alone
  double borne[12] = {};  // by each row in the last step, as `solver: gazebo` starts from it
  bool catching_up = false;  // back from Motor mode but off its command: the way back is rate-limited

  bool merged() const { return (type == JointType::Fixed && !watched) || servo == ServoMode::Locked; }
  Pose motion(double q) const;  // child's joint frame in the parent's
  Pose frame_W() const { return parent ? parent->X_WL * X_PJ : X_PJ; }
};

struct Cluster {
  Link* root = nullptr;    // null: anchored in the world
  std::vector<Link*> members;  // breadth first from the root
  bool moving = false;     // some servo joint inside
  bool has_joints = false;
  double mass = 0;
  Vec3 com;                // in the root frame
  Sym3 inertia;            // about the CoM, root axes
  bool uniform_gravity = true;
  double gravity_mass = 0;
  Vec3 gravity_com;
  // Sleeping.
  bool asleep = false;
  int idle_steps = 0;
  double idle_time = 0;
  int node = -1;  // of the island search
  bool iterative = false;  // solved by iterations in this step
  bool moved = false;
  bool carriers = false;  // some member has a kinematic body
  // Carried: `at`, a member, hangs on `by`; pose and velocity of it in the frame of `by`, as ODE's joints have left them.
  Link *by = nullptr, *at = nullptr;
  Pose X_by_at;
  Vec3 v_by_at, w_by_at;
  Vec3 carry_v, carry_w;   // true velocity (of the CoM) less that of the body
  Vec3 alpha, a;           // of the CoM with all joint accelerations zero, the servo joints standing still
  Vec3 alpha_all, a_all;   // the same with the servo joints moving
};

// One joint of the tree in which joint positions are projected, and the cluster that follows from it.
struct Branch {
  Joint* joint;
  int cluster;
  int head;      // first cluster of a tree that floats free, -1 when the world holds it
  bool outward;  // the child's cluster follows the parent's
};

struct Model {
  int id = 0;
  std::string name;
  World* world = nullptr;
  bool is_static = false, self_collide = false, may_sleep = false;
  double mass = 0;  // kg, of all links
  int contact_count = 0;  // of this step
  bool touches_others = false;  // that move, in this step
  bool dirty = true;
  bool finished = false;  // built, and part of the shared arrays
  bool has_servo = false;
  bool jump = false;  // a servo joint jumps in this step or did in the last: too fast for any inertia to be felt
  bool loop = false;  // a closed loop runs over carried bodies
  std::vector<std::shared_ptr<Link>> links;
  std::vector<std::shared_ptr<Joint>> joints;
  std::vector<Cluster> clusters;
  std::vector<Branch> tree;
  std::vector<int> tree_heads;
  std::set<std::pair<int, int>> jointed;  // ids of links that a joint connects: they never collide
  std::set<std::pair<int, int>> exempt;  // shape pairs that already touched when the servo joints were engaged
  bool take_exempt = false;
};

// Two links of any models held together while the world runs, or a link held where it is in the world.
struct Tie {
  int id = 0;
  std::shared_ptr<Link> parent;  // null = the world
  std::shared_ptr<Link> child;
  Pose X_PC;
  dJointID joint = nullptr;  // of the step under way
  dJointFeedback feedback{};
};

struct Contact {
  Shape *a = nullptr, *b = nullptr;
  Vec3 pos, normal;  // the normal points into a
  double depth = 0;
  int count = 1;     // contacts of this pair
  int merged = 1;    // how many it stands for, side by side
  dJointID joint = nullptr;
  bool swapped = false;
  int feedback = -1;
  bool told = false;  // who asks for forces is told this one
  int row = -1;       // in gazebo_contacts_
  double fastest = 0;  // m/s, of pushing apart
};

// What a contact of the last step bore, from which the next one's greatest friction follows.
struct Borne {
  int a = 0, b = 0;  // shapes
  Vec3 pos;
  double normal = 0;  // N
};

#pragma pack(push, 1)
struct ContactRecord {
  int32_t collision1, collision2;
  double position[3], normal[3], depth, force[3], torque[3];
};
#pragma pack(pop)

class World {
 public:
  World();
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Settings, read at every step.
  double dt = 0.001;
  Vec3 gravity{0, 0, -9.8};
  double erp = 0.2, cfm = 0, sor = 1.3, contact_max_vel = 100, surface_layer = 0.001;
  int iters = 50, max_contacts = 20;
  bool like_gazebo = false;  // `solver: gazebo`: one iterative solver, contacts and joints as Gazebo Classic has them
  uint64_t seed = 0;
  uint64_t iterations = 0;
  int64_t time_ns = 0;
  double contact_softness = 0.02, friction_softness = 1e-5;
  int direct_rows = 160;  // islands with joints up to this many constraint rows use the direct solver
  int heap_rows = 60;     // the same, for islands of contacts alone

  std::shared_ptr<Model> add_model(const std::string& name, bool is_static, bool self_collide, bool may_sleep);
  void remove_model(Model& model);
  std::shared_ptr<Link> add_link(Model& model, const Pose& X_WL, double mass, const Vec3& com, const Sym3& inertia);
  std::shared_ptr<Joint> add_joint(Model& model, JointType type, Link* parent, Link& child, const Pose& X_CJ);
  std::shared_ptr<Shape> add_shape(Link& link, const Pose& X_LC, dGeomID geom, std::shared_ptr<Shape> shape);
  void finish(Model& model);

  void step(int n);

  void set_model_pose(Model& model, const Pose& X_WM_old, const Pose& X_WM_new);
  void set_link_pose(Link& link, const Pose& X_WL);
  void set_link_twist(Link& link, const Vec3& v, const Vec3& w);
  bool set_joint_position(Joint& joint, int axis, double q);
  void set_servo(Joint& joint, double target);
  void servo_off(Joint& joint);
  void set_inertial(Link& link, double mass, const Vec3& com, const Sym3& inertia);
  void follow(Joint& joint, const std::shared_ptr<Joint>& leader, double multiplier, double offset);
  int attach(std::shared_ptr<Link> parent, std::shared_ptr<Link> child);
  void detach(int tie);
  void detach_all();
  Tie* find_tie(int id);
  std::vector<int> ties() const;  // their numbers, which are never given twice
  void refresh();  // bring clusters up to date
  void add_model_twist(Model& model, const Vec3& v, const Vec3& w, const Vec3& at);
  void zero_velocities(Model& model);
  std::string save();
  void restore(const std::string& data, const std::vector<int>& ties);

  int cast_rays(const double* origins, const double* directions, int n, double max_range, const std::vector<int>& ignore,
                double* ranges, int32_t* hits);

  // Made anew when models come and go: who still looks at the old ones may go on doing so.
  using Array = std::shared_ptr<std::vector<double>>;
  Array link_poses, joint_positions, joint_velocities;
  std::vector<ContactRecord> contact_records();
  const std::vector<std::shared_ptr<Model>>& models() const { return models_; }
  std::vector<std::string> take_messages();
  Shape* find_shape(int id) const;
  struct Counters {
    uint64_t direct = 0, quick = 0, fallbacks = 0, promotions = 0, contacts = 0;
  } counters;

 private:
  dWorldID world_;
  BroadPhase broad_phase_;
  dJointGroupID contact_group_;
  std::vector<std::shared_ptr<Model>> models_;
  std::map<int, Shape*> shapes_;
  std::vector<Tie> ties_;
  int next_tie_ = 1;
  int next_model_ = 0, next_link_ = 0, next_joint_ = 0, next_shape_ = 0;
  std::vector<Contact> contacts_;
  std::vector<dJointFeedback> feedback_;
  std::vector<Borne> borne_;  // in the order of the contacts
  std::vector<dContact> gazebo_contacts_;
  std::vector<std::pair<Shape*, Shape*>> pairs_;
  std::map<std::string, int> message_counts_;
  std::vector<std::string> messages_;
  int visit_ = 0;
  std::vector<Cluster*> carried_;  // from the carrying to the carried
  bool replan_ = false;

  void step_once();
  void abandon_step();
  bool owns(const Model* model) const { return model && model->world == this; }
  template <class F> void walk(F& f);
  void renumber(const Model* fresh = nullptr);
  void recluster(Model& model);
  void place_cluster(Cluster& cluster);
  void compose(Cluster& cluster);
  void install(Joint& joint);
  void place_shapes(Link& link);
  void spread_poses(Cluster& cluster);
  void spread_twists(Cluster& cluster, bool servos = true);
  void plan_carried();
  Model* try_plan_carried();
  Cluster& cluster_of(const Link& link) const { return link.model->clusters[link.cluster]; }
  void update_carry(Cluster& cluster);
  void hold_true_velocities();
  void rebase_carried();
  void spread_carried();
  void keep_relations();
  void carry_along();
  void inertial_force(Cluster& cluster, const Vec3& a, const Vec3& alpha);
  void follow_servos();
  void accelerations(Model& model, bool servos);
  void member_accelerations(Cluster& cluster, bool servos);
  void apply_inertial_forces(Model& model);
  void set_rates(Model& model);
  void collide();
  void merge_tread(const Shape& wheel, size_t first);
  void lay_flat(const Shape& wheel, const Vec3& axis, Contact& contact) const;
  bool allowed(const Shape& a, const Shape& b) const;
  bool promote();
  void demote();
  void wake(Model& model);
  bool promote_path(Link* link);
  void motor_load(Joint& joint);
  void feed_forward(Joint& joint);
  void apply_forces();
  void apply_axis_force(Joint& joint, int axis, double force);
  void set_stops(Joint& joint, int axis);
  void update_axis(Joint& joint, int axis);
  void make_contact_joints();
  const Borne* borne_before(const Contact& contact) const;
  void remember_loads();
  void forget_loads(const Model& model);
  void make_tie_joints();
  bool tied(const Link& a, const Link& b) const;
  void solve();
  void run(bool direct, int iterations_wanted);
  using Numbers = std::unordered_map<dBodyID, int>;
  struct RowOwner {
    dJointFeedback* feedback;
    Joint* joint;
    size_t from, to;
  };
  void integrate_servos();
  void pull(bool servos = true);
  void publish();
  void read_back();
  void plan_tree(Model& model);
  void project_joints(Model& model);
  void read_joint(Joint& joint);
  void read_feedback(Joint& joint);
  void momentum(const Load& load, Vec3& linear, Vec3& spin) const;
  void weigh(Model& model);
  void read_load(Joint& joint);
  void guard_nan();
  void report(const std::string& text, const std::string& who);
  double axis_inverse_inertia(const Joint& joint, int axis) const;
  double borne_by_contact(const Contact& contact) const;
  void set_stiffness(Contact& contact, dContact& d) const;
  Vec3 set_friction(const Contact& contact, const Vec3& n, dContact& d) const;
  void set_surface_speed(const Contact& contact, const Vec3& n, const Vec3& t1, dBodyID first, dBodyID second, dContact& d);
  dBodyID body_of(const Link* link) const;
  Pose X_BL(const Link& link) const;
  std::vector<Link*> subtree(Joint& joint, bool* loop = nullptr);
  void judge_masses(Model& model);
  std::string island_names(const std::vector<Cluster*>& clusters) const;

  struct BodyState {
    dBodyID body;
    Vec3 p, v, w, f, t;
    Quat q;
    double R[12];
  };
  std::vector<BodyState> before_;
  static BodyState state_of(dBodyID body);
  static std::vector<BodyState> states_of(const std::vector<dBodyID>& bodies);
  static void recall_bodies(const std::vector<BodyState>& in);
  struct Island {
    std::vector<Cluster*> clusters;
    std::vector<Link*> kinematic;  // links whose own kinematic bodies its joints hang on
    int rows = 0, contact_rows = 0;
    bool joints = false, awake = false;
    bool driven = false;  // something that no force moves moves it
  };
  struct Pass {
    std::vector<Cluster*> clusters;
    std::vector<dBodyID> bodies;  // of the clusters, and kinematic ones
    void add(const Island& island);
    void enable(bool on) const;
    void clear() { clusters.clear(), bodies.clear(); }
  };
  Pass passes_[3];  // of the step under way
  void find_islands();
  void rest(Island& island);
  void drop_absurd_forces();
  void run_direct(const Pass& pass, std::vector<std::string>& said);
  void run_iterative(const Pass& pass, int times, std::vector<std::string>& said);
  void run_one_by_one(const std::vector<const Island*>& islands, std::vector<std::string>& said);
  void run_like_gazebo(const Pass& pass);
  void gather_rows(const Numbers& number, std::vector<gazebo_like::Body>& bodies, std::vector<gazebo_like::Row>& rows,
                   std::vector<RowOwner>& owners);
  std::vector<Island> islands_;
  std::vector<Cluster*> nodes_;
};

}  // namespace ode_sim
