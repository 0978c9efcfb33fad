#pragma once
#include <cstdint>
#include <string>

#include <boost/enable_shared_from_this.hpp>
#include <sdf/sdf.hh>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/common/common.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace physics
{

/// What has a name and a place in the tree of a world. Who has a pointer to something removed may go on to ask it.
class GAZEBO_VISIBLE Base : public boost::enable_shared_from_this<Base>
{
public:
  enum EntityType
  {
    BASE = 0,
    ENTITY = 0x1,
    MODEL = 0x2,
    LINK = 0x4,
    COLLISION = 0x8,
    LIGHT = 0x10,
    VISUAL = 0x20,
    JOINT = 0x40,
    BALL_JOINT = 0x80,
    HINGE2_JOINT = 0x100,
    HINGE_JOINT = 0x200,
    SLIDER_JOINT = 0x400,
    SCREW_JOINT = 0x800,
    UNIVERSAL_JOINT = 0x1000,
    GEARBOX_JOINT = 0x2000,
    FIXED_JOINT = 0x4000,
    ACTOR = 0x8000,
    SHAPE = 0x10000,
    BOX_SHAPE = 0x20000,
    CYLINDER_SHAPE = 0x40000,
    HEIGHTMAP_SHAPE = 0x80000,
    MAP_SHAPE = 0x100000,
    MULTIRAY_SHAPE = 0x200000,
    RAY_SHAPE = 0x400000,
    PLANE_SHAPE = 0x800000,
    SPHERE_SHAPE = 0x1000000,
    MESH_SHAPE = 0x2000000,
    POLYLINE_SHAPE = 0x4000000,
    SENSOR_COLLISION = 0x10000000
  };

  explicit Base(BasePtr parent);
  virtual ~Base();
  virtual void Load(sdf::ElementPtr sdf) { this->sdf = sdf; }
  virtual void Fini() {}
  virtual void Init() {}
  virtual void Reset() {}
  virtual void Reset(EntityType) { Reset(); }
  virtual void Update() {}
  virtual void UpdateParameters(sdf::ElementPtr) {}
  virtual void SetName(const std::string& name) { name_ = name; }
  std::string GetName() const { return name_; }
  uint32_t GetId() const { return id_; }
  void SetSaveable(bool saveable) { saveable_ = saveable; }
  bool GetSaveable() const { return saveable_; }
  int GetParentId() const;
  void SetParent(BasePtr parent) { parent_ = parent.get(); }
  BasePtr GetParent() const;
  void AddChild(BasePtr child);
  virtual void RemoveChild(unsigned int id);
  void RemoveChild(const std::string& name);
  void RemoveChild(BasePtr child);
  void RemoveChildren() { children.clear(); }
  unsigned int GetChildCount() const { return static_cast<unsigned int>(children.size()); }
  BasePtr GetById(unsigned int id) const;
  BasePtr GetByName(const std::string& name);
  BasePtr GetChild(unsigned int index) const { return index < children.size() ? children[index] : BasePtr(); }
  BasePtr GetChild(const std::string& name) { return GetByName(name); }
  void AddType(EntityType type) { type_ |= type; }
  bool HasType(const EntityType& type) const { return (type_ & type) == static_cast<unsigned int>(type); }
  unsigned int GetType() const { return type_; }
  std::string TypeStr() const;
  std::string GetScopedName(bool prependWorldName = false) const;
  std::string StripScopedName(const std::string& name) const;
  std::string StripParentScopedName(const std::string& name) const;
  void Print(const std::string& prefix);
  virtual bool SetSelected(bool selected) { return selected_ = selected; }
  bool IsSelected() const { return selected_; }
  bool operator==(const Base& other) const { return GetName() == other.GetName(); }
  void SetWorld(const WorldPtr& world) { this->world = world; }
  const WorldPtr& GetWorld() const { return world; }
  virtual const sdf::ElementPtr GetSDF() { return sdf; }

protected:
  sdf::ElementPtr sdf;
  Base_V children;
  WorldPtr world;

private:
  Base* parent_ = nullptr;  // who owns this
  std::string name_;
  uint32_t id_;
  unsigned int type_ = BASE;
  bool saveable_ = true, selected_ = false;
};

}  // namespace physics
}  // namespace gazebo
