#pragma once
#include <functional>
#include <string>
#include <vector>

#include <gazebo/rendering/Camera.hh>

namespace gazebo
{
namespace rendering
{

/// Tells how far away, along its axis, is what it sees; gives pictures in colour, too.
class GAZEBO_VISIBLE DepthCamera : public Camera
{
public:
  typedef void NewDepths(const float*, unsigned int, unsigned int, unsigned int, const std::string&);

  DepthCamera(const std::string& name, ScenePtr scene, bool auto_render = true);
  ~DepthCamera() override;
  void Load(sdf::ElementPtr sdf) override;
  using Camera::Load;
  virtual const float* DepthData() const;  // m, the newest; null before the first one
  event::ConnectionPtr ConnectNewDepthFrame(std::function<NewDepths> subscriber);
  /// With <output>points</output>, in place of depths: x (right), y (down), z (ahead) in m, and a float with the bytes blue, green, red.
  event::ConnectionPtr ConnectNewRGBPointCloud(std::function<NewDepths> subscriber);
  event::ConnectionPtr ConnectNewReflectanceFrame(std::function<NewDepths> subscriber);   // never called
  event::ConnectionPtr ConnectNewNormalsPointCloud(std::function<NewDepths> subscriber);  // never called

  std::vector<std::string> Wanted(bool awaited) const override;
  void Develop(const Picture& picture) override;

private:
  void developPoints(const Picture& picture);

  bool points_ = false;
  std::vector<float> depths_[2], cloud_;
  std::atomic<const float*> newest_depths_{ nullptr };
  bool second_depths_ = false;
  mutable std::atomic<bool> polled_depths_{ false };
  event::EventT<NewDepths> depth_frames_, clouds_, reflectances_, normals_;
};

}  // namespace rendering
}  // namespace gazebo
