#pragma once
#include <string>
#include <vector>

#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/common/Event.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/Base.hh>
#include <gazebo/physics/Inertial.hh>

namespace gazebo
{
namespace physics
{

/// The geometry of a collision, as it was described. Rays, boxes, balls and cylinders can be changed.
class GAZEBO_VISIBLE Shape : public Base
{
public:
  Shape(CollisionPtr parent, EntityType type);
  virtual double ComputeVolume() const;  // m^3: of the box round it, where its own is not known
  ignition::math::Vector3d Scale() const { return ignition::math::Vector3d::One; }
  virtual void SetScale(const ignition::math::Vector3d&) {}
  virtual void FillMsg(msgs::Geometry& message);
  virtual void ProcessMsg(const msgs::Geometry&) {}

protected:
  Collision* owner() const { return owner_; }
  CollisionPtr collisionParent;  // of those that a plugin makes

private:
  Collision* owner_;  // which has it
};

class GAZEBO_VISIBLE BoxShape : public Shape
{
public:
  BoxShape(CollisionPtr parent, const ignition::math::Vector3d& size) : Shape(parent, BOX_SHAPE), size_(size) {}
  ignition::math::Vector3d Size() const { return size_; }
  void SetSize(const ignition::math::Vector3d& size);
  double ComputeVolume() const override { return size_.X() * size_.Y() * size_.Z(); }
  void FillMsg(msgs::Geometry& message) override;

private:
  ignition::math::Vector3d size_;
};

class GAZEBO_VISIBLE SphereShape : public Shape
{
public:
  SphereShape(CollisionPtr parent, double radius) : Shape(parent, SPHERE_SHAPE), radius_(radius) {}
  double GetRadius() const { return radius_; }
  void SetRadius(const double& radius);
  double ComputeVolume() const override { return 4.0 / 3.0 * 3.14159265358979323846 * radius_ * radius_ * radius_; }
  void FillMsg(msgs::Geometry& message) override;

private:
  double radius_;
};

class GAZEBO_VISIBLE CylinderShape : public Shape
{
public:
  CylinderShape(CollisionPtr parent, double radius, double length)
    : Shape(parent, CYLINDER_SHAPE)
    , radius_(radius)
    , length_(length)
  {
  }
  double GetRadius() const { return radius_; }
  double GetLength() const { return length_; }
  void SetRadius(double radius) { SetSize(radius, length_); }
  void SetLength(double length) { SetSize(radius_, length); }
  void SetSize(double radius, double length);
  double ComputeVolume() const override { return 3.14159265358979323846 * radius_ * radius_ * length_; }
  void FillMsg(msgs::Geometry& message) override;

private:
  double radius_, length_;
};

class GAZEBO_VISIBLE PlaneShape : public Shape
{
public:
  PlaneShape(CollisionPtr parent, const ignition::math::Vector3d& normal, const ignition::math::Vector2d& size)
    : Shape(parent, PLANE_SHAPE)
    , normal_(normal)
    , size_(size)
  {
  }
  ignition::math::Vector3d Normal() const { return normal_; }
  ignition::math::Vector2d Size() const { return size_; }
  double ComputeVolume() const override { return 0; }
  void FillMsg(msgs::Geometry& message) override;

private:
  ignition::math::Vector3d normal_;
  ignition::math::Vector2d size_;
};

class GAZEBO_VISIBLE MeshShape : public Shape
{
public:
  MeshShape(CollisionPtr parent, const std::string& uri, const ignition::math::Vector3d& scale)
    : Shape(parent, MESH_SHAPE)
    , uri_(uri)
    , scale_(scale)
  {
  }
  std::string GetMeshURI() const { return uri_; }
  ignition::math::Vector3d Size() const { return scale_; }
  void FillMsg(msgs::Geometry& message) override;

private:
  std::string uri_;
  ignition::math::Vector3d scale_;
};

class GAZEBO_VISIBLE PolylineShape : public Shape
{
public:
  PolylineShape(CollisionPtr parent, double height, const std::vector<ignition::math::Vector2d>& corners)
    : Shape(parent, POLYLINE_SHAPE)
    , height_(height)
    , corners_(corners)
  {
  }
  double GetHeight() const { return height_; }
  std::vector<std::vector<ignition::math::Vector2d>> Vertices() const { return { corners_ }; }
  void FillMsg(msgs::Geometry& message) override;

private:
  double height_;
  std::vector<ignition::math::Vector2d> corners_;
};

/// Heights over a grid that has `sampling` steps for each of the picture's. Columns go from -x to +x, rows from +y to -y.
class GAZEBO_VISIBLE HeightmapShape : public Shape
{
public:
  HeightmapShape(CollisionPtr parent, const std::string& uri, const ignition::math::Vector3d& size,
                 const ignition::math::Vector3d& position, int sampling)
    : Shape(parent, HEIGHTMAP_SHAPE)
    , uri_(uri)
    , size_(size)
    , position_(position)
    , sampling_(sampling)
  {
  }
  std::string GetURI() const { return uri_; }
  ignition::math::Vector3d Size() const { return size_; }
  ignition::math::Vector3d Pos() const { return position_; }
  int GetSubSampling() const { return sampling_; }
  ignition::math::Vector2i VertexCount() const;
  float GetHeight(int column, int row) const;  // m; 0 beyond the grid
  float GetMaxHeight() const;
  float GetMinHeight() const;
  double ComputeVolume() const override { return 0; }
  void FillMsg(msgs::Geometry& message) override;

private:
  const ode_sim::HeightGrid* grid() const;  // null when the model has gone
  std::string uri_;
  ignition::math::Vector3d size_, position_;
  int sampling_;
};

/// A ray. Points in the world, or in the frame of the collision that it was made for. Without a hit, a search leaves 1000 m and "".
class GAZEBO_VISIBLE RayShape : public Shape
{
public:
  explicit RayShape(CollisionPtr parent) : Shape(parent, RAY_SHAPE) { collisionParent = parent; }
  virtual void SetPoints(const ignition::math::Vector3d& start, const ignition::math::Vector3d& end);
  ignition::math::Vector3d Start() const { return globalStartPos; }  // in the world, as of the last Update() or SetPoints()
  ignition::math::Vector3d End() const { return globalEndPos; }
  virtual void RelativePoints(ignition::math::Vector3d& start, ignition::math::Vector3d& end)
  {
    start = relativeStartPos, end = relativeEndPos;
  }
  virtual void GlobalPoints(ignition::math::Vector3d& start, ignition::math::Vector3d& end);
  void Update() override;
  virtual void GetIntersection(double& distance, std::string& entity);  // m to the next collision
  double GetLength() const { return contactLen; }
  virtual void SetLength(double length) { contactLen = length; }
  float GetRetro() const { return static_cast<float>(contactRetro); }
  void SetRetro(float retro) { contactRetro = retro; }
  int GetFiducial() const { return contactFiducial; }
  void SetFiducial(int fiducial) { contactFiducial = fiducial; }
  std::string CollisionName() const { return hit_; }

protected:
  void SetCollisionName(const std::string& name) { hit_ = name; }
  ignition::math::Vector3d relativeStartPos, relativeEndPos, globalStartPos, globalEndPos;
  double contactLen = 1000, contactRetro = 0;
  int contactFiducial = -1;

private:
  std::string hit_;
};

}  // namespace physics
}  // namespace gazebo
