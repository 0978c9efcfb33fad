// Readable names of C++ types. They are the names of hardware interfaces in messages, services and YAML files.
#pragma once

#include <cstdlib>
#include <cxxabi.h>
#include <string>
#include <typeinfo>

namespace hardware_interface
{
namespace internal
{

/// The readable form of a mangled name; the name itself if it is none.
inline std::string demangleSymbol(const char* name)
{
  int status = 0;
  char* readable = abi::__cxa_demangle(name, nullptr, nullptr, &status);
  const std::string result = status == 0 && readable ? readable : name;
  std::free(readable);
  return result;
}

inline std::string demangleSymbol(const std::string& name) { return demangleSymbol(name.c_str()); }

template <class T>
inline std::string demangledTypeName()
{
  return demangleSymbol(typeid(T).name());
}

/// That of the dynamic type of a polymorphic object.
template <class T>
inline std::string demangledTypeName(const T& object)
{
  return demangleSymbol(typeid(object).name());
}

}  // namespace internal
}  // namespace hardware_interface
