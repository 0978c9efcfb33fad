#include <moveit/collision_detection/world.h>

#include <algorithm>
#include <stdexcept>

#include "frames.hpp"

namespace collision_detection
{
namespace
{
void place(World::Object& object)
{
  object.global_shape_poses_.clear();
  for (const Eigen::Isometry3d& pose : object.shape_poses_)
    object.global_shape_poses_.push_back(object.pose_ * pose);
  object.global_subframe_poses_.clear();
  for (const auto& frame : object.subframe_poses_)
    object.global_subframe_poses_[frame.first] = object.pose_ * frame.second;
}
}  // namespace

World::World() = default;
World::World(const World& other) : objects_(other.objects_) {}

World::~World() = default;

// Others may hold the object as it was: they keep that.
World::Object& World::toWrite(ObjectPtr& object)
{
  object = std::make_shared<Object>(*object);
  return *object;
}

void World::changed(const ObjectPtr& object, Action action)
{
  for (const auto& observer : observers_)
    observer.second(object, action);
}

std::vector<std::string> World::getObjectIds() const
{
  std::vector<std::string> ids;
  for (const auto& object : objects_)
    ids.push_back(object.first);
  return ids;
}

World::ObjectConstPtr World::getObject(const std::string& object_id) const
{
  const auto found = objects_.find(object_id);
  return found == objects_.end() ? nullptr : found->second;
}

// ---------------------------------------------------------------- frames

const Eigen::Isometry3d& World::getTransform(const std::string& name, bool& frame_found) const
{
  frame_found = true;
  const auto object = objects_.find(name);
  if (object != objects_.end())
    return object->second->pose_;
  for (const auto& item : objects_)
    if (name.compare(0, item.first.size() + 1, item.first + "/") == 0)
    {
      const auto frame = item.second->global_subframe_poses_.find(name.substr(item.first.size() + 1));
      if (frame != item.second->global_subframe_poses_.end())
        return frame->second;
    }
  frame_found = false;
  return frames::IDENTITY;
}

bool World::knowsTransform(const std::string& name) const
{
  bool found;
  getTransform(name, found);
  return found;
}

const Eigen::Isometry3d& World::getTransform(const std::string& name) const
{
  bool found;
  const Eigen::Isometry3d& pose = getTransform(name, found);
  if (!found)
    throw std::runtime_error("No transform found for object with name: " + name);
  return pose;
}

const EigenSTL::vector_Isometry3d& World::getGlobalShapeTransforms(const std::string& object_id) const
{
  static const EigenSTL::vector_Isometry3d none;
  const auto found = objects_.find(object_id);
  return found == objects_.end() ? none : found->second->global_shape_poses_;
}

const Eigen::Isometry3d& World::getGlobalShapeTransform(const std::string& object_id, int shape_index) const
{
  const EigenSTL::vector_Isometry3d& poses = getGlobalShapeTransforms(object_id);
  return shape_index >= 0 && shape_index < static_cast<int>(poses.size()) ? poses[shape_index] : frames::IDENTITY;
}

// ---------------------------------------------------------------- changes

void World::addToObject(const std::string& object_id, const Eigen::Isometry3d& pose,
                        const std::vector<shapes::ShapeConstPtr>& shapes, const EigenSTL::vector_Isometry3d& shape_poses)
{
  if (shapes.size() != shape_poses.size() || shapes.empty())
    return;
  int action = ADD_SHAPE;
  ObjectPtr& object = objects_[object_id];
  if (!object)
  {
    object = std::make_shared<Object>(object_id);
    object->pose_ = pose;
    action |= CREATE;
  }
  Object& written = toWrite(object);
  written.shapes_.insert(written.shapes_.end(), shapes.begin(), shapes.end());
  written.shape_poses_.insert(written.shape_poses_.end(), shape_poses.begin(), shape_poses.end());
  place(written);
  changed(object, action);
}

bool World::moveShapeInObject(const std::string& object_id, const shapes::ShapeConstPtr& shape,
                              const Eigen::Isometry3d& shape_pose)
{
  const auto found = objects_.find(object_id);
  if (found == objects_.end())
    return false;
  for (std::size_t i = 0; i < found->second->shapes_.size(); ++i)
    if (found->second->shapes_[i] == shape)
    {
      EigenSTL::vector_Isometry3d poses = found->second->shape_poses_;
      poses[i] = shape_pose;
      return moveShapesInObject(object_id, poses);
    }
  return false;
}

bool World::moveShapesInObject(const std::string& object_id, const EigenSTL::vector_Isometry3d& shape_poses)
{
  const auto found = objects_.find(object_id);
  if (found == objects_.end() || shape_poses.size() != found->second->shapes_.size())
    return false;
  Object& written = toWrite(found->second);
  written.shape_poses_ = shape_poses;
  place(written);
  changed(found->second, MOVE_SHAPE);
  return true;
}

bool World::moveObject(const std::string& object_id, const Eigen::Isometry3d& transform)
{
  const auto found = objects_.find(object_id);
  return found != objects_.end() && setObjectPose(object_id, transform * found->second->pose_);
}

bool World::setObjectPose(const std::string& object_id, const Eigen::Isometry3d& pose)
{
  int action = MOVE_SHAPE;
  ObjectPtr& object = objects_[object_id];
  if (!object)
  {
    object = std::make_shared<Object>(object_id);
    action |= CREATE;
  }
  Object& written = toWrite(object);
  written.pose_ = pose;
  place(written);
  changed(object, action);
  return true;
}

bool World::removeShapeFromObject(const std::string& object_id, const shapes::ShapeConstPtr& shape)
{
  const auto found = objects_.find(object_id);
  if (found == objects_.end())
    return false;
  for (std::size_t i = 0; i < found->second->shapes_.size(); ++i)
  {
    if (found->second->shapes_[i] != shape)
      continue;
    Object& written = toWrite(found->second);
    written.shapes_.erase(written.shapes_.begin() + i);
    written.shape_poses_.erase(written.shape_poses_.begin() + i);
    place(written);
    const ObjectPtr object = found->second;
    if (object->shapes_.empty())
      objects_.erase(found);
    changed(object, object->shapes_.empty() ? DESTROY : REMOVE_SHAPE);
    return true;
  }
  return false;
}

bool World::removeObject(const std::string& object_id)
{
  const auto found = objects_.find(object_id);
  if (found == objects_.end())
    return false;
  const ObjectPtr object = found->second;
  objects_.erase(found);
  changed(object, DESTROY);
  return true;
}

bool World::setSubframesOfObject(const std::string& object_id, const moveit::core::FixedTransformsMap& subframe_poses)
{
  const auto found = objects_.find(object_id);
  if (found == objects_.end())
    return false;
  Object& written = toWrite(found->second);
  written.subframe_poses_ = subframe_poses;
  place(written);
  return true;
}

void World::clearObjects()
{
  for (const std::string& id : getObjectIds())
    removeObject(id);
}

// ---------------------------------------------------------------- observers

World::ObserverHandle World::addObserver(const ObserverCallbackFn& callback)
{
  observers_[next_observer_] = callback;
  return ObserverHandle(next_observer_++);
}

void World::removeObserver(const ObserverHandle observer_handle) { observers_.erase(observer_handle.id_); }

void World::notifyObserverAllObjects(const ObserverHandle observer_handle, Action action) const
{
  const auto observer = observers_.find(observer_handle.id_);
  if (observer != observers_.end())
    for (const auto& object : objects_)
      observer->second(object.second, action);
}
}  // namespace collision_detection
