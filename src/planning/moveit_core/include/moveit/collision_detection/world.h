// Objects around a robot. Poses of objects are in the planning frame, those of shapes and subframes in the object.
#pragma once

#include <eigen_stl_containers/eigen_stl_vector_container.h>
#include <geometric_shapes/shapes.h>

#include <Eigen/Geometry>
#include <boost/function.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/transforms/transforms.h>

namespace collision_detection
{
MOVEIT_CLASS_FORWARD(World);

class World
{
public:
  World();
  World(const World& other);  // shares the objects until one of the two changes them; observers are not copied
  virtual ~World();

  MOVEIT_STRUCT_FORWARD(Object);
  struct Object
  {
    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
    explicit Object(const std::string& object_id) : id_(object_id) {}
    std::string id_;
    Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
    std::vector<shapes::ShapeConstPtr> shapes_;
    EigenSTL::vector_Isometry3d shape_poses_, global_shape_poses_;
    moveit::core::FixedTransformsMap subframe_poses_, global_subframe_poses_;
  };

  std::vector<std::string> getObjectIds() const;
  ObjectConstPtr getObject(const std::string& object_id) const;  // null if there is none

  using const_iterator = std::map<std::string, ObjectPtr>::const_iterator;
  const_iterator begin() const { return objects_.begin(); }
  const_iterator end() const { return objects_.end(); }
  std::size_t size() const { return objects_.size(); }
  const_iterator find(const std::string& object_id) const { return objects_.find(object_id); }
  bool hasObject(const std::string& object_id) const { return objects_.count(object_id) > 0; }

  // An object or `object/subframe`.
  bool knowsTransform(const std::string& name) const;
  const Eigen::Isometry3d& getTransform(const std::string& name) const;  // throws std::runtime_error
  const Eigen::Isometry3d& getTransform(const std::string& name, bool& frame_found) const;
  const Eigen::Isometry3d& getGlobalShapeTransform(const std::string& object_id, int shape_index) const;
  const EigenSTL::vector_Isometry3d& getGlobalShapeTransforms(const std::string& object_id) const;

  // To an object that is there already the shapes are added; its pose stays.
  void addToObject(const std::string& object_id, const Eigen::Isometry3d& pose,
                   const std::vector<shapes::ShapeConstPtr>& shapes, const EigenSTL::vector_Isometry3d& shape_poses);
  void addToObject(const std::string& object_id, const std::vector<shapes::ShapeConstPtr>& shapes,
                   const EigenSTL::vector_Isometry3d& shape_poses)
  {
    addToObject(object_id, Eigen::Isometry3d::Identity(), shapes, shape_poses);
  }
  void addToObject(const std::string& object_id, const Eigen::Isometry3d& pose, const shapes::ShapeConstPtr& shape,
                   const Eigen::Isometry3d& shape_pose)
  {
    addToObject(object_id, pose, std::vector<shapes::ShapeConstPtr>{ shape }, EigenSTL::vector_Isometry3d{ shape_pose });
  }
  void addToObject(const std::string& object_id, const shapes::ShapeConstPtr& shape, const Eigen::Isometry3d& shape_pose)
  {
    addToObject(object_id, Eigen::Isometry3d::Identity(), shape, shape_pose);
  }

  // False when there is no such object or shape.
  bool moveShapeInObject(const std::string& object_id, const shapes::ShapeConstPtr& shape, const Eigen::Isometry3d& shape_pose);
  bool moveShapesInObject(const std::string& object_id, const EigenSTL::vector_Isometry3d& shape_poses);
  bool moveObject(const std::string& object_id, const Eigen::Isometry3d& transform);  // by
  bool setObjectPose(const std::string& object_id, const Eigen::Isometry3d& pose);    // to
  bool removeShapeFromObject(const std::string& object_id, const shapes::ShapeConstPtr& shape);
  bool removeObject(const std::string& object_id);
  bool setSubframesOfObject(const std::string& object_id, const moveit::core::FixedTransformsMap& subframe_poses);
  void clearObjects();

  enum ActionBits
  {
    UNINITIALIZED = 0,
    CREATE = 1,
    DESTROY = 2,
    MOVE_SHAPE = 4,
    ADD_SHAPE = 8,
    REMOVE_SHAPE = 16,
  };
  class Action
  {
  public:
    Action(int v = UNINITIALIZED) : action_(v) {}
    operator ActionBits() const { return ActionBits(action_); }

  private:
    int action_;
  };
  class ObserverHandle
  {
  public:
    ObserverHandle() {}

  private:
    friend class World;
    explicit ObserverHandle(int id) : id_(id) {}
    int id_ = -1;
  };
  using ObserverCallbackFn = boost::function<void(const ObjectConstPtr&, Action)>;
  ObserverHandle addObserver(const ObserverCallbackFn& callback);
  void removeObserver(const ObserverHandle observer_handle);
  void notifyObserverAllObjects(const ObserverHandle observer_handle, Action action) const;

private:
  Object& toWrite(ObjectPtr& object);
  void changed(const ObjectPtr& object, Action action);

  std::map<std::string, ObjectPtr> objects_;
  std::map<int, ObserverCallbackFn> observers_;
  int next_observer_ = 0;
};
}  // namespace collision_detection
