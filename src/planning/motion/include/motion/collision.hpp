// Which bodies may touch, what a check is asked and what it answers.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "motion/robot_model.hpp"

namespace motion
{
// MoveIt's allowed collision matrix: explicit entries by pair of names, defaults by name. A pair is allowed if its entry
// says so; without an entry by the defaults of the two (a missing default counts as the other one's).
class AllowedCollisionMatrix
{
public:
  AllowedCollisionMatrix() = default;
  explicit AllowedCollisionMatrix(const RobotModel& model);

  enum Entry : signed char
  {
    None = -1,
    Never = 0,
    Allowed = 1
  };
  Entry entry(const std::string& a, const std::string& b) const;
  void setEntry(const std::string& a, const std::string& b, Entry entry);
  Entry defaultEntry(const std::string& name) const;
  void setDefault(const std::string& name, Entry entry);
  void remove(const std::string& name);
  bool allowed(const std::string& a, const std::string& b) const;
  std::vector<std::string> names() const;  // of all entries, sorted
  const std::map<std::string, Entry>& defaults() const { return defaults_; }
  bool knows(const std::string& name) const;

private:
  std::map<std::string, std::map<std::string, Entry>> entries_;
  std::map<std::string, Entry> defaults_;
};

enum class BodyType
{
  RobotLink,
  WorldObject,
  Attached
};

struct Contact
{
  std::string body_1, body_2;
  BodyType type_1, type_2;
  Vector3 position, normal;  // the normal points from body 1 to body 2
  double depth;
};

struct CollisionRequest
{
  std::string group;  // "" = the whole robot
  std::size_t contacts = 0, contacts_per_pair = 1;
  bool padded = true, self = true, world = true, distance = false;
};

struct CollisionResult
{
  bool collision = false;
  std::vector<Contact> contacts;
  double distance = std::numeric_limits<double>::infinity();
};

struct DistanceResult
{
  double distance = std::numeric_limits<double>::infinity();  // 0 in collision
  std::string body_1, body_2;
  Vector3 point_1 = Vector3::Zero(), point_2 = Vector3::Zero();
};
}  // namespace motion
