// What every part of the core shares in its dealings with ODE: conversions, and what becomes of ODE's messages.
#pragma once
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "world.hpp"

namespace ode_sim {

// Thrown out of ODE where it would otherwise end the process; its text is what ODE had to say.
struct OdeFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// ODE's random generator is global; a step holds this lock around what uses it.
extern std::mutex ode_mutex;

// While it lives, what ODE says goes to `said`. Nothing of it ever goes to the terminal.
class Listening {
 public:
  explicit Listening(std::vector<std::string>& said);
  ~Listening();
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

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

// What a joint's feedback is before a step: ODE leaves that of a joint which it does not solve for as it was.
constexpr dJointFeedback kUnsolved{{std::numeric_limits<dReal>::quiet_NaN()}, {}, {}, {}};

// A parameter of an axis of an ODE joint (dParamVel ...).
void set_limot(const Joint& j, int axis, int parameter, double value);

// Puts two bodies, for a moment, where a joint is to have its zero; then back, to the last bit.
class Posed {
 public:
  // X_1J, X_2J: the joint frame in the first body, and in the second (in the world if there is none).
  Posed(dBodyID first, dBodyID second, const Pose& X_1J, const Pose& X_2J) : bodies_{first, second} {
    for (int i = 0; i < 2; ++i) {
      if (!bodies_[i]) continue;
      std::memcpy(p_[i], dBodyGetPosition(bodies_[i]), 3 * sizeof(dReal));
      std::memcpy(q_[i], dBodyGetQuaternion(bodies_[i]), sizeof q_[i]);
      std::memcpy(R_[i], dBodyGetRotation(bodies_[i]), sizeof R_[i]);
    }
    if (second) set_body_pose(second, {});  // second body, if any, at the origin
    set_body_pose(first, X_2J * inverse(X_1J));
  }
  ~Posed() {
    for (int i = 0; i < 2; ++i) {
      if (!bodies_[i]) continue;
      dBodySetPosition(bodies_[i], p_[i][0], p_[i][1], p_[i][2]);
      dBodySetQuaternion(bodies_[i], q_[i]);
      // Setting a quaternion normalises it, which costs the last bit.
      std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(bodies_[i])), q_[i], sizeof q_[i]);
      std::memcpy(const_cast<dReal*>(dBodyGetRotation(bodies_[i])), R_[i], sizeof R_[i]);
    }
  }

 private:
  dBodyID bodies_[2];
  dReal p_[2][3];
  dQuaternion q_[2];
  dMatrix3 R_[2];
};

}  // namespace ode_sim
