#pragma once
#include <memory>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/KeyFrame.hh>

namespace gazebo
{
namespace common
{

/// Key frames in the order of time, and a moment among them; s.
class GAZEBO_VISIBLE Animation
{
public:
  Animation(const std::string& name, double length, bool loop) : name_(name), length_(length), loop_(loop) {}
  virtual ~Animation() = default;
  double GetLength() const { return length_; }
  void SetLength(double length) { length_ = length; }
  void SetTime(double time);
  void AddTime(double time) { SetTime(time_ + time); }
  double GetTime() const { return time_; }
  unsigned int GetKeyFrameCount() const { return static_cast<unsigned int>(frames_.size()); }
  KeyFrame* GetKeyFrame(unsigned int index) const { return index < frames_.size() ? frames_[index].get() : nullptr; }

protected:
  KeyFrame* insert(std::unique_ptr<KeyFrame> frame);
  /// The frame at or before a time, and how far it is to the next, 0 to 1.
  std::size_t find(double time, double& part) const;

  std::vector<std::unique_ptr<KeyFrame>> frames_;

private:
  std::string name_;
  double length_, time_ = 0;
  bool loop_;
};

/// Poses on a smooth curve through those of the key frames.
class GAZEBO_VISIBLE PoseAnimation : public Animation
{
public:
  PoseAnimation(const std::string& name, double length, bool loop, double tension = 0.0)
    : Animation(name, length, loop)
    , tension_(tension)
  {
  }
  PoseKeyFrame* CreateKeyFrame(double time);
  void GetInterpolatedKeyFrame(PoseKeyFrame& frame) const { GetInterpolatedKeyFrame(GetTime(), frame); }

protected:
  void GetInterpolatedKeyFrame(double time, PoseKeyFrame& frame) const;

private:
  double tension_;
};

class GAZEBO_VISIBLE NumericAnimation : public Animation
{
public:
  NumericAnimation(const std::string& name, double length, bool loop) : Animation(name, length, loop) {}
  NumericKeyFrame* CreateKeyFrame(double time);
  void GetInterpolatedKeyFrame(NumericKeyFrame& frame) const;
};

}  // namespace common
}  // namespace gazebo
