// The law of transmissions: what lies between actuators and joints, and what a description has to say of it. Upstream's classes
// (simple_, differential_, four_bar_linkage_transmission.h, the loader) and those of Python (transmissions.py, loader.py) stand on it.
// Without ROS.
//
// a: actuators, j: joints; n: mechanical reduction of an actuator, m: of a joint, o: offset of a joint (rad or m). Speeds and efforts:
//
//   Simple        j' = a' / n,                                       tau_j = n tau_a
//   Differential  j1' = (a1'/n1 + a2'/n2) / (2 m1),                  tau_j1 = m1 (n1 tau_a1 + n2 tau_a2)
//                 j2' = (a1'/n1 - a2'/n2) / (2 m2),                  tau_j2 = m2 (n1 tau_a1 - n2 tau_a2)
//   FourBar       j1' = a1' / (m1 n1),                               tau_j1 = m1 n1 tau_a1
//                 j2' = (a2'/n2 - a1'/(m1 n1)) / m2,                 tau_j2 = m2 (n2 tau_a2 - n1 m1 tau_a1)
//
// Positions go the way of speeds, joints with their offset; absolute encoders that of positions, or crosswise past a differential;
// torque sensors that of efforts. The other direction is the inverse, but for the efforts of four bars, which keep no power:
//   tau_a1 = tau_j1 / (n1 m1), tau_a2 = (tau_j1 + tau_j2 / m2) / n2.
//
// What is NaN stays NaN and what is infinite goes its way: limits are of the joints. Source: ros_control's transmission_interface 0.20,
// value by value. It differs in reductions and offsets that are NaN or infinite: refused, like reductions of 0.
//
// Threads: the eight ways may be called from the control loop: they do not wait, allocate or throw. All else belongs to loading.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface
{

enum class Coupling
{
  Simple,
  Differential,
  FourBar
};

class TransmissionLaw
{
public:
  /// The second one of a simple transmission is 0.
  typedef std::array<double, 2> Values;

  /// \param crosswise absolute encoders sit on the joints of a differential, each on the other one
  /// \throws TransmissionInterfaceException not as many numbers as there are joints, or one that is impossible
  TransmissionLaw(Coupling coupling, const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                  const std::vector<double>& joint_offset, bool crosswise = false)
    : n(actuator_reduction)
    , m(joint_reduction)
    , offset(joint_offset)
    , coupling_(coupling)
    , crosswise_(crosswise)
  {
    if (n.size() != size() || m.size() != size() || offset.size() != size())
      throw TransmissionInterfaceException("reductions and offsets must be " +
                                           std::string(size() == 1 ? "one number" : "two numbers") + " each");
    for (std::size_t i = 0; i < size(); ++i)
    {
      check("actuator", n[i]);
      check("joint", m[i]);
      if (!std::isfinite(offset[i]))
        throw TransmissionInterfaceException("an offset of a joint that is no finite number is impossible");
    }
  }

  std::size_t size() const { return coupling_ == Coupling::Simple ? 1 : 2; }

  Values velocity_to_joint(const Values& a) const
  {
    if (coupling_ == Coupling::Simple)
      return Values{ { a[0] / n[0], 0.0 } };
    if (coupling_ == Coupling::FourBar)
    {
      const double first = a[0] / (m[0] * n[0]);
      return Values{ { first, (a[1] / n[1] - first) / m[1] } };
    }
    const double x = a[0] / n[0], y = a[1] / n[1];
    return Values{ { (x + y) / (2.0 * m[0]), (x - y) / (2.0 * m[1]) } };
  }

  Values velocity_to_actuator(const Values& j) const
  {
    if (coupling_ == Coupling::Simple)
      return Values{ { j[0] * n[0], 0.0 } };
    if (coupling_ == Coupling::FourBar)
      return Values{ { j[0] * m[0] * n[0], (j[0] + j[1] * m[1]) * n[1] } };
    const double x = j[0] * m[0], y = j[1] * m[1];
    return Values{ { (x + y) * n[0], (x - y) * n[1] } };
  }

  Values effort_to_joint(const Values& a) const
  {
    const double x = a[0] * n[0];
    if (coupling_ == Coupling::Simple)
      return Values{ { x, 0.0 } };
    const double y = a[1] * n[1];
    if (coupling_ == Coupling::FourBar)
      return Values{ { m[0] * x, m[1] * (y - x * m[0]) } };
    return Values{ { m[0] * (x + y), m[1] * (x - y) } };
  }

  Values effort_to_actuator(const Values& j) const
  {
    if (coupling_ == Coupling::Simple)
      return Values{ { j[0] / n[0], 0.0 } };
    if (coupling_ == Coupling::FourBar)
      return Values{ { j[0] / (n[0] * m[0]), (j[0] + j[1] / m[1]) / n[1] } };
    const double x = j[0] / m[0], y = j[1] / m[1];
    return Values{ { (x + y) / (2.0 * n[0]), (x - y) / (2.0 * n[1]) } };
  }

  Values position_to_joint(const Values& a) const
  {
    Values j = velocity_to_joint(a);
    for (std::size_t i = 0; i < size(); ++i)
      j[i] += offset[i];
    return j;
  }

  Values position_to_actuator(const Values& j) const
  {
    Values from_zero = j;
    for (std::size_t i = 0; i < size(); ++i)
      from_zero[i] -= offset[i];
    return velocity_to_actuator(from_zero);
  }

  Values absolute_to_joint(const Values& a) const { return crosswise_ ? Values{ { a[1], a[0] } } : position_to_joint(a); }

  const std::vector<double> n, m, offset;

private:
  static void check(const std::string& of, double reduction)
  {
    if (reduction == 0.0 || !std::isfinite(reduction))
      throw TransmissionInterfaceException("a mechanical reduction of " +
                                           std::string(reduction == 0.0 ? "0" : "no finite number") + " (" + of +
                                           ") is impossible");
  }

  Coupling coupling_;
  bool crosswise_;
};

/// The text of an element that may be missing.
struct Text
{
  bool there;
  std::string text;
};

/// An <actuator> or a <joint>, as it is written.
struct Part
{
  std::string name, role;
  Text reduction, offset;
  bool ignores_transmission;  ///< <ignoreTransmissionAbsoluteEncoder/>
};

/// A transmission, and which of the description's actuators and joints are its first and its second ones.
struct Plan
{
  TransmissionLaw law;
  std::vector<std::size_t> actuators, joints;
};

namespace internal
{

/// As far as it is a number, as std::stod; with a point, whatever the locale. \return false: it does not begin with one
inline bool number_of(const std::string& text, double& number)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return static_cast<bool>(stream >> number);
}

inline double number_of(const std::string& where, const char* tag, const Text& written, double otherwise)
{
  if (written.there && !number_of(written.text, otherwise))
    throw TransmissionInterfaceException(where + ": <" + tag + ">" + written.text + "</" + tag + "> is no number");
  return otherwise;
}

/// The index of the part with each role. \param kind actuator or joint
inline std::vector<std::size_t> ordered(const std::string& where, const std::string& kind, const std::vector<Part>& parts)
{
  if (parts.size() == 1)
    return { 0 };
  if (parts[0].role == kind + "1" && parts[1].role == kind + "2")
    return { 0, 1 };
  if (parts[0].role == kind + "2" && parts[1].role == kind + "1")
    return { 1, 0 };
  std::string has;
  for (const Part& part : parts)
    has += (has.empty() ? "" : ", ") + (part.role.empty() ? "none" : part.role);
  throw TransmissionInterfaceException(where + ": " + kind + "s need the <role>s " + kind + "1, " + kind +
                                       "2, each once; they have " + has);
}

inline void check_count(const std::string& where, const char* kind, std::size_t has, std::size_t needed)
{
  if (has != needed)
    throw TransmissionInterfaceException(where + " needs " + std::to_string(needed) + " " + kind + (needed > 1 ? "s" : "") +
                                         ", it has " + std::to_string(has));
}

}  // namespace internal

/// \throws TransmissionInterfaceException one line that says what is wrong
inline Plan plan_transmission(Coupling coupling, const std::string& name, const std::string& type,
                              const std::vector<Part>& actuators, const std::vector<Part>& joints)
{
  const std::string where = "transmission '" + name + "'";
  const std::size_t size = coupling == Coupling::Simple ? 1 : 2;
  internal::check_count(where + " (" + type + ")", "actuator", actuators.size(), size);
  internal::check_count(where + " (" + type + ")", "joint", joints.size(), size);
  const std::vector<std::size_t> first = internal::ordered(where, "actuator", actuators);
  const std::vector<std::size_t> second = internal::ordered(where, "joint", joints);
  std::vector<double> n, m, offset;
  for (std::size_t i : first)
  {
    const std::string of = where + ": actuator '" + actuators[i].name + "'";
    if (!actuators[i].reduction.there)
      throw TransmissionInterfaceException(of + " needs <mechanicalReduction>");
    n.push_back(internal::number_of(of, "mechanicalReduction", actuators[i].reduction, 0.0));
  }
  bool crosswise = coupling == Coupling::Differential;
  for (std::size_t i : second)
  {
    const std::string of = where + ": joint '" + joints[i].name + "'";
    m.push_back(size == 1 ? 1.0 : internal::number_of(of, "mechanicalReduction", joints[i].reduction, 1.0));
    offset.push_back(internal::number_of(of, "offset", joints[i].offset, 0.0));
    crosswise = crosswise && joints[i].ignores_transmission;
  }
  try
  {
    return Plan{ TransmissionLaw(coupling, n, m, offset, crosswise), first, second };
  }
  catch (const TransmissionInterfaceException& error)
  {
    throw TransmissionInterfaceException(where + ": " + error.what());
  }
}

/// What a <hardwareInterface> asks for: "position", "velocity" or "effort" commands, "state" alone, or "", which is unknown.
struct Asked
{
  std::string kind;
  bool both_ways;
};

inline Asked asked_for(const std::string& written)
{
  if (written == "hardware_interface/JointStateInterface")
    return Asked{ "state", false };
  const char* const kinds[][2] = { { "position", "Position" }, { "velocity", "Velocity" }, { "effort", "Effort" } };
  for (const auto& kind : kinds)
    for (bool both : { false, true })
      if (written == std::string("hardware_interface/") + (both ? "BiDirectional" : "") + kind[1] + "JointInterface")
        return Asked{ kind[0], both };
  return Asked{ "", false };
}

/// \param interfaces of each joint, as written \return those that are known
/// \throws TransmissionInterfaceException the joints differ, or none is known
inline std::vector<std::string> known_interfaces(const std::string& name,
                                                 const std::vector<std::vector<std::string>>& interfaces)
{
  const std::vector<std::string>& wanted = interfaces.at(0);
  for (const std::vector<std::string>& other : interfaces)
    if (other.size() != wanted.size() || !std::is_permutation(wanted.begin(), wanted.end(), other.begin()))
      throw TransmissionInterfaceException("transmission '" + name + "': all joints must list the same hardware interfaces");
  std::vector<std::string> known;
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(known),
               [](const std::string& one) { return !asked_for(one).kind.empty(); });
  if (known.empty())
    throw TransmissionInterfaceException(
        "transmission '" + name + "' has no hardware interface that can be used; known are hardware_interface/" +
        "EffortJointInterface, ...VelocityJointInterface, ...PositionJointInterface, ...JointStateInterface");
  return known;
}

}  // namespace transmission_interface
