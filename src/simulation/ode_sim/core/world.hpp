// The physics core as its users see it, independent of Python: models of links and joints, stepped by ODE.
//
// What there is lies in a Scene, plain data (scene.hpp); what belongs to one step in a StepState (step_state.hpp); the step is a list of
// phases (step.cpp), each of them functions over these two (phases.hpp). A World owns one of each, and numbers what comes into it.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene.hpp"
#include "step_state.hpp"

namespace ode_sim {

// Told of each step, in the thread that steps, without Python's lock.
struct StepObserver {
  virtual ~StepObserver() = default;
  virtual void before(int64_t time_ns) = 0;  // time_ns: of the state that the step produces
  virtual void after(int64_t time_ns) = 0;   // also of a step that was given up
};

class World {
 public:
  StepObserver* observer = nullptr;

  World();
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  Settings& settings() { return scene_.settings; }
  Scene& scene() { return scene_; }

  // Building. A model is part of the world as soon as it is added, of the shared arrays when it is finished.
  std::shared_ptr<Model> add_model(const std::string& name, bool is_static, bool self_collide, bool may_sleep);
  void remove_model(Model& model);  // also one that was never finished
  std::shared_ptr<Link> add_link(Model& model, const Pose& X_WL, double mass, const Vec3& com, const Sym3& inertia);
  std::shared_ptr<Joint> add_joint(Model& model, JointType type, Link* parent, Link& child, const Pose& X_CJ);
  std::shared_ptr<Shape> add_shape(Link& link, const Pose& X_LC, OwnedGeom geom, std::shared_ptr<Shape> shape);
  void finish(Model& model);

  void step(int n);

  // Between steps, see commands.cpp.
  void set_model_pose(Model& model, const Pose& X_WM_old, const Pose& X_WM_new);
  void set_link_pose(Link& link, const Pose& X_WL);
  // All links of a static model, as the limbs of one that walks. With `seconds` since the last step they push in the next one, at the
  // velocity at which they have come by then.
  void lead_links(Model& model, const std::vector<Pose>& X_WL, double seconds);
  void set_link_twist(Link& link, const Vec3& v, const Vec3& w);
  bool set_joint_position(Joint& joint, int axis, double q);
  void set_drive(Joint& joint, double target);
  void drive_off(Joint& joint);
  void set_inertial(Link& link, double mass, const Vec3& com, const Sym3& inertia);
  void follow(Joint& joint, const std::shared_ptr<Joint>& leader, double multiplier, double offset);
  void add_model_twist(Model& model, const Vec3& v, const Vec3& w, const Vec3& at);
  void zero_velocities(Model& model);
  void refresh();                    // brings clusters up to date
  void disturb(const Model& model);  // before its shapes change: what touches it wakes

  // Joints that come and go while the world runs, see connections.cpp.
  std::shared_ptr<Joint> connect(JointType type, Link* parent, Link& child, const Pose& X_CJ);
  void disconnect(Joint& joint);  // also one of a description; for good

  int weld(std::shared_ptr<Link> parent, std::shared_ptr<Link> child);
  void unweld(int id);
  void unweld_strained();  // whose links have been put elsewhere
  Weld* find_weld(int id);
  std::vector<int> welds() const;

  std::string save();
  void restore(const std::string& data, const std::vector<int>& weld_ids);
  std::vector<ContactRecord> contacts() const;

 private:
  Scene scene_;
  StepState state_;
  int next_weld_ = 1, next_model_ = 0, next_link_ = 0, next_joint_ = 0, next_shape_ = 0;

  bool owns(const Model* model) const { return model && model->world == this; }
  std::shared_ptr<Joint> make_joint(Model& model, JointType type, Link* parent, Link& child, const Pose& X_CJ);
  void renumber(const Model* fresh = nullptr);
  void forget_contacts(const Model& model);
};

// `origins`, `directions`: n x 3, world frame; directions are normalised here. `ranges`: metres, infinity = no hit within
// `max_range`; `hits`: shape ids, -1 = none. Returns how many rays hit.
int cast_rays(const Scene& scene, const double* origins, const double* directions, int n, double max_range,
              const std::vector<int>& ignore, double* ranges, int32_t* hits);

}  // namespace ode_sim
