// Which bodies may touch: entries by pair of names, defaults by name.
#pragma once

#include <moveit_msgs/AllowedCollisionMatrix.h>

#include <boost/function.hpp>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <moveit/collision_detection/collision_common.h>
#include <moveit/macros/class_forward.h>
#include <srdfdom/model.h>

namespace motion
{
class AllowedCollisionMatrix;
}

namespace collision_detection
{
namespace AllowedCollision
{
enum Type
{
  NEVER,
  ALWAYS,
  CONDITIONAL  // a function decides
};
}
// Is this contact allowed?
using DecideContactFn = boost::function<bool(Contact&)>;

MOVEIT_CLASS_FORWARD(AllowedCollisionMatrix);

class AllowedCollisionMatrix
{
public:
  AllowedCollisionMatrix();
  AllowedCollisionMatrix(const std::vector<std::string>& names, bool allowed = false);
  AllowedCollisionMatrix(const srdf::Model& srdf);
  AllowedCollisionMatrix(const moveit_msgs::AllowedCollisionMatrix& msg);
  explicit AllowedCollisionMatrix(const motion::AllowedCollisionMatrix& core);
  ~AllowedCollisionMatrix();
  AllowedCollisionMatrix(const AllowedCollisionMatrix& other);
  AllowedCollisionMatrix& operator=(const AllowedCollisionMatrix& other);

  // False when there is no such entry.
  bool getEntry(const std::string& name1, const std::string& name2, AllowedCollision::Type& allowed_collision_type) const;
  bool getEntry(const std::string& name1, const std::string& name2, DecideContactFn& fn) const;
  bool hasEntry(const std::string& name) const;
  bool hasEntry(const std::string& name1, const std::string& name2) const;
  void removeEntry(const std::string& name1, const std::string& name2);
  void removeEntry(const std::string& name);
  void setEntry(const std::string& name1, const std::string& name2, bool allowed);
  void setEntry(const std::string& name1, const std::string& name2, const DecideContactFn& fn);
  void setEntry(const std::string& name, bool allowed);  // with all that are known
  void setEntry(const std::string& name, const std::vector<std::string>& other_names, bool allowed);
  void setEntry(const std::vector<std::string>& names1, const std::vector<std::string>& names2, bool allowed);
  void setEntry(bool allowed);  // all that are known
  void getAllEntryNames(std::vector<std::string>& names) const;
  void getMessage(moveit_msgs::AllowedCollisionMatrix& msg) const;
  void clear();
  std::size_t getSize() const;

  void setDefaultEntry(const std::string& name, bool allowed);
  void setDefaultEntry(const std::string& name, const DecideContactFn& fn);
  bool getDefaultEntry(const std::string& name, AllowedCollision::Type& allowed_collision) const;
  bool getDefaultEntry(const std::string& name, DecideContactFn& fn) const;

  // Entry or default; false when there is neither.
  bool getAllowedCollision(const std::string& name1, const std::string& name2, DecideContactFn& fn) const;
  bool getAllowedCollision(const std::string& name1, const std::string& name2, AllowedCollision::Type& allowed_collision) const;

  void print(std::ostream& out) const;

  const motion::AllowedCollisionMatrix& core() const { return *core_; }
  // Another number after each change.
  std::uint64_t version() const { return version_; }
  bool hasConditions() const { return !conditions_.empty() || !default_conditions_.empty(); }

private:
  using Pair = std::pair<std::string, std::string>;
  void changed();
  static Pair ordered(const std::string& a, const std::string& b);

  std::unique_ptr<motion::AllowedCollisionMatrix> core_;  // conditional entries count as "never" there
  std::map<Pair, DecideContactFn> conditions_;
  std::map<std::string, DecideContactFn> default_conditions_;
  std::uint64_t version_;
};
}  // namespace collision_detection
