#include "ode_access.hpp"

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

// Also called where somebody else in the process may have set handlers of their own.
void set_handlers() {
  dSetMessageHandler(&on_message);
  dSetErrorHandler(&on_failure);
  dSetDebugHandler(&on_failure);
}

}  // namespace

Listening::Listening(std::vector<std::string>& said) : before_(listener) {
  listener = &said;
  set_handlers();
}

Listening::~Listening() { listener = before_; }

void initialise_ode() {
  static std::once_flag once;
  std::call_once(once, [] { dInitODE2(0); });
  thread_local bool ready = false;
  if (!ready) {
    dAllocateODEDataForThread(dAllocateMaskAll);
    ready = true;
  }
  set_handlers();
}

void set_limot(const Joint& j, int axis, int parameter, double value) {
  switch (j.type) {
    case JointType::Revolute: dJointSetHingeParam(j.joint, parameter, value); break;
    case JointType::Prismatic: dJointSetSliderParam(j.joint, parameter, value); break;
    case JointType::Universal:
      // ODE's first axis is that of its first body: the child's, unless only the parent has a body.
      if ((axis == 0) == (j.sign > 0)) parameter += dParamGroup2;
      dJointSetUniversalParam(j.joint, parameter, value);
      break;
    default: break;
  }
}

}  // namespace ode_sim
