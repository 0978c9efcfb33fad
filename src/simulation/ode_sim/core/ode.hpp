// What the core shares in its dealings with ODE: who owns what, conversions, and what becomes of ODE's messages.
#pragma once
#include <ode/ode.h>

#include <cstring>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "math.hpp"

namespace ode_sim {

// One thing of ODE's, destroyed with its owner.
template <class Id, void (*destroy)(Id)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Id id) : id_(id) {}
  Owned(Owned&& other) noexcept : id_(other.id_) { other.id_ = nullptr; }
  Owned& operator=(Owned&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { reset(); }
  void reset(Id id = nullptr) {
    if (id_) destroy(id_);
    id_ = id;
  }
  operator Id() const { return id_; }

 private:
  Id id_ = nullptr;
};

using OwnedWorld = Owned<dWorldID, dWorldDestroy>;
using OwnedBody = Owned<dBodyID, dBodyDestroy>;
using OwnedJoint = Owned<dJointID, dJointDestroy>;
using OwnedJointGroup = Owned<dJointGroupID, dJointGroupDestroy>;
using OwnedGeom = Owned<dGeomID, dGeomDestroy>;
using OwnedField = Owned<dHeightfieldDataID, dGeomHeightfieldDataDestroy>;
using OwnedMesh = Owned<dTriMeshDataID, dGeomTriMeshDataDestroy>;

// Thrown out of ODE where it would otherwise end the process; its text is what ODE had to say.
struct OdeFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// ODE's random generator is global; a step holds this lock around what uses it.
extern std::mutex ode_mutex;

// To live around every call of ODE: readies ODE for the thread, and its handlers, which somebody else in the process may have replaced.
// What ODE says meanwhile goes to `said`, else to whichever scope is around this one; none of it ever goes to the terminal.
class OdeScope {
 public:
  OdeScope();
  explicit OdeScope(std::vector<std::string>& said);
  ~OdeScope();
  OdeScope(const OdeScope&) = delete;
  OdeScope& operator=(const OdeScope&) = delete;

 private:
  std::vector<std::string>* before_;
};

inline Vec3 vec(const dReal* a) { return {a[0], a[1], a[2]}; }
inline Quat quat(const dReal* a) { return {a[1], a[2], a[3], a[0]}; }
inline void set_body_pose(dBodyID body, const Pose& X) {
  dBodySetPosition(body, X.p.x, X.p.y, X.p.z);
  const dQuaternion q = {X.q.w, X.q.x, X.q.y, X.q.z};
  dBodySetQuaternion(body, q);
}
inline void set_body_twist(dBodyID body, const Vec3& v, const Vec3& w) {
  dBodySetLinearVel(body, v.x, v.y, v.z);
  dBodySetAngularVel(body, w.x, w.y, w.z);
}
inline Pose body_pose(dBodyID body) { return {vec(dBodyGetPosition(body)), quat(dBodyGetQuaternion(body))}; }
inline Vec3 body_velocity(dBodyID body) { return vec(dBodyGetLinearVel(body)); }
inline Vec3 body_spin(dBodyID body) { return vec(dBodyGetAngularVel(body)); }

// What a joint's feedback is before a step: ODE leaves that of a joint which it does not solve for as it was.
constexpr dJointFeedback kUnsolved{{std::numeric_limits<dReal>::quiet_NaN()}, {}, {}, {}};

// All of a body that a step changes, to the last bit.
struct BodyState {
  dBodyID body;
  Vec3 p, v, w, f, t;
  Quat q;
  double R[12];
};
BodyState state_of(dBodyID body);
std::vector<BodyState> states_of(const std::vector<dBodyID>& bodies);
void recall(const BodyState& state);
void recall(const std::vector<BodyState>& states);

// Puts two bodies, for a moment, where a joint is to have its zero; then back, to the last bit.
class Posed {
 public:
  // X_1J, X_2J: the joint frame in the first body, and in the second (in the world if there is none).
  Posed(dBodyID first, dBodyID second, const Pose& X_1J, const Pose& X_2J);
  ~Posed();
  Posed(const Posed&) = delete;
  Posed& operator=(const Posed&) = delete;

 private:
  dBodyID bodies_[2];
  dReal p_[2][3];
  dQuaternion q_[2];
  dMatrix3 R_[2];
};

}  // namespace ode_sim
