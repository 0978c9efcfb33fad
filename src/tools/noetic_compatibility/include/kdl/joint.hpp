// Noetic's KDL (1.4) calls the type of a joint that does not move "None", and sources compare with that. Debian's, from 1.5, calls
// it "Fixed".
#ifndef NOETIC_COMPATIBILITY_KDL_JOINT_HPP
#define NOETIC_COMPATIBILITY_KDL_JOINT_HPP
#include <string>

// Before the class's own getTypeName(), which gets another name, comes this one. It is never a symbol, as the library has one of its
// name that answers differently.
#define getTypeName                                      \
  __attribute__((always_inline)) getTypeName() const     \
  {                                                      \
    const std::string name = typeNameInDebian();         \
    return name == "Fixed" ? std::string("None") : name; \
  }                                                      \
  const std::string typeNameInDebian
#include_next <kdl/joint.hpp>
#undef getTypeName
#endif
