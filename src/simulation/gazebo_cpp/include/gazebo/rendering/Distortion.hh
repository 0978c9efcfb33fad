#pragma once
#include <ignition/math/Vector2.hh>
#include <sdf/sdf.hh>

#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/util/system.hh>

namespace gazebo
{
namespace rendering
{

/// <distortion>: Brown's model of a lens, with OpenCV's meaning of the coefficients.
class GAZEBO_VISIBLE Distortion
{
public:
  void Load(sdf::ElementPtr sdf);
  void SetCrop(bool crop) { crop_ = crop; }  // no black border: the picture is filled with what is really there
  bool Crop() const { return crop_; }
  double K1() const { return k1_; }
  double K2() const { return k2_; }
  double K3() const { return k3_; }
  double P1() const { return p1_; }
  double P2() const { return p2_; }
  ignition::math::Vector2d Center() const { return center_; }

private:
  double k1_ = 0, k2_ = 0, k3_ = 0, p1_ = 0, p2_ = 0;
  ignition::math::Vector2d center_{ 0.5, 0.5 };
  bool crop_ = true;
};

}  // namespace rendering
}  // namespace gazebo
