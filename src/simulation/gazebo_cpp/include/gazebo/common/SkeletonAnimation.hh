#pragma once
#include <string>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace common
{

/// An animation of an actor's skeleton, by which plugins see that it is there and how long it lasts. The simulator plays it.
class GAZEBO_VISIBLE SkeletonAnimation
{
public:
  explicit SkeletonAnimation(const std::string& name, double length = 0) : name_(name), length_(length) {}
  void SetName(const std::string& name) { name_ = name; }
  std::string GetName() const { return name_; }
  double GetLength() const { return length_; }  // s

private:
  std::string name_;
  double length_;
};

}  // namespace common
}  // namespace gazebo
