#include "ode.hpp"

#include <cstdarg>
#include <cstdio>

namespace ode_sim {

std::mutex ode_mutex;

namespace {

thread_local std::vector<std::string>* listener = nullptr;

std::string line_of(const char* text, va_list args) {
  char line[256];
  std::vsnprintf(line, sizeof line, text, args);
  return line;
}

void on_message(int, const char* text, va_list args) {
  if (listener) listener->push_back(line_of(text, args));
}

void on_failure(int, const char* text, va_list args) {
  const std::string line = line_of(text, args);
  if (listener) listener->push_back(line);
  throw OdeFailure("ODE: " + line);
}

void ready() {
  static std::once_flag once;
  std::call_once(once, [] { dInitODE2(0); });
  thread_local bool allocated = false;
  if (!allocated) {
    dAllocateODEDataForThread(dAllocateMaskAll);
    allocated = true;
  }
  dSetMessageHandler(&on_message);
  dSetErrorHandler(&on_failure);
  dSetDebugHandler(&on_failure);
}

}  // namespace

OdeScope::OdeScope() : before_(listener) { ready(); }

OdeScope::OdeScope(std::vector<std::string>& said) : before_(listener) {
  ready();
  listener = &said;
}

OdeScope::~OdeScope() { listener = before_; }

BodyState state_of(dBodyID b) {
  BodyState s;
  s.body = b;
  s.p = vec(dBodyGetPosition(b));
  s.q = quat(dBodyGetQuaternion(b));
  s.v = body_velocity(b);
  s.w = body_spin(b);
  s.f = vec(dBodyGetForce(b));
  s.t = vec(dBodyGetTorque(b));
  std::memcpy(s.R, dBodyGetRotation(b), sizeof s.R);
  return s;
}

std::vector<BodyState> states_of(const std::vector<dBodyID>& bodies) {
  std::vector<BodyState> out;
  out.reserve(bodies.size());
  for (dBodyID b : bodies) out.push_back(state_of(b));
  return out;
}

void recall(const BodyState& s) {
  set_body_pose(s.body, {s.p, s.q});
  set_body_twist(s.body, s.v, s.w);
  dBodySetForce(s.body, s.f.x, s.f.y, s.f.z);
  dBodySetTorque(s.body, s.t.x, s.t.y, s.t.z);
  const dReal q[4] = {s.q.w, s.q.x, s.q.y, s.q.z};
  std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(s.body)), q, sizeof q);
  std::memcpy(const_cast<dReal*>(dBodyGetRotation(s.body)), s.R, sizeof s.R);
}

void recall(const std::vector<BodyState>& states) {
  for (auto& s : states) recall(s);
}

Posed::Posed(dBodyID first, dBodyID second, const Pose& X_1J, const Pose& X_2J) : bodies_{first, second} {
  for (int i = 0; i < 2; ++i) {
    if (!bodies_[i]) continue;
    std::memcpy(p_[i], dBodyGetPosition(bodies_[i]), 3 * sizeof(dReal));
    std::memcpy(q_[i], dBodyGetQuaternion(bodies_[i]), sizeof q_[i]);
    std::memcpy(R_[i], dBodyGetRotation(bodies_[i]), sizeof R_[i]);
  }
  if (second) set_body_pose(second, {});  // second body, if any, at the origin
  set_body_pose(first, X_2J * inverse(X_1J));
}

Posed::~Posed() {
  for (int i = 0; i < 2; ++i) {
    if (!bodies_[i]) continue;
    dBodySetPosition(bodies_[i], p_[i][0], p_[i][1], p_[i][2]);
    dBodySetQuaternion(bodies_[i], q_[i]);
    // Setting a quaternion normalises it, which costs the last bit.
    std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(bodies_[i])), q_[i], sizeof q_[i]);
    std::memcpy(const_cast<dReal*>(dBodyGetRotation(bodies_[i])), R_[i], sizeof R_[i]);
  }
}

}  // namespace ode_sim
