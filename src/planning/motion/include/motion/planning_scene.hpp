// A robot among objects. Copies share all parts until one of them writes.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "motion/collision.hpp"
#include "motion/robot_state.hpp"

namespace motion
{
struct WorldObject
{
  std::string id, type;
  Transform pose = Transform::Identity();  // of the object in the model frame
  std::vector<ShapePtr> shapes;
  std::vector<Transform> shape_poses;  // in the object
  Subframes subframes;                 // in the object
};

using Color = std::array<float, 4>;

class World;             // objects ready for collision checks
class RobotGeometry;     // links ready for collision checks
class CollisionChecker;  // all of it, compiled for one group

class PlanningScene
{
public:
  static const char* const OCTOMAP;  // "<octomap>"

  explicit PlanningScene(RobotModelPtr model);
  PlanningScene(const PlanningScene& other);
  PlanningScene& operator=(const PlanningScene&) = delete;
  ~PlanningScene();

  std::string name = "(noname)";
  const RobotModelPtr& model() const { return model_; }
  const std::string& frame() const { return model_->frame; }
  const RobotState& state() const { return state_; }
  void setState(const RobotState& state);

  // ------------------------------------------------------------ frames
  const std::map<std::string, Transform>& transforms() const { return transforms_; }
  void setTransform(const std::string& frame, const Transform& pose);
  void removeTransform(const std::string& frame) { transforms_.erase(frame); }
  bool framePose(const std::string& name, const RobotState& state, Transform& pose) const;
  std::vector<std::string> frameNames() const;

  // ------------------------------------------------------------ objects
  void addObject(const WorldObject& object);
  void appendShapes(const std::string& id, const std::vector<ShapePtr>& shapes, const std::vector<Transform>& poses);
  void moveObject(const std::string& id, const Transform& pose);
  void moveShapes(const std::string& id, const std::vector<Transform>& poses);
  bool removeObject(const std::string& id);
  // What was said of an object that is no more: its colour, and what it may touch. Links and attached bodies keep theirs.
  void forget(const std::string& id);
  void clearObjects();  // all but the octomap
  std::vector<std::string> objectNames() const;
  const WorldObject& object(const std::string& id) const;
  const WorldObject* findObject(const std::string& id) const;
  void setOctomap(std::shared_ptr<const OcTreeShape> tree, const Transform& pose);

  void attach(AttachedBodyPtr body);
  void attachObject(const std::string& id, const std::string& link, const std::set<std::string>& touch_links);
  bool detachObject(const std::string& id);

  std::map<std::string, Color> colors;

  // ------------------------------------------------------------ collision
  const AllowedCollisionMatrix& acm() const { return *acm_; }
  void setAcm(const AllowedCollisionMatrix& acm);
  // Of links, and of what they carry.
  void setPadding(const std::map<std::string, double>& by_link);
  void setScale(const std::map<std::string, double>& by_link);
  const std::map<std::string, double>& padding() const { return padding_; }
  const std::map<std::string, double>& scale() const { return scale_; }

  CollisionResult check(const RobotState& state, const CollisionRequest& request,
                        const AllowedCollisionMatrix* acm = nullptr) const;
  DistanceResult distance(const RobotState& state, const std::string& group, double max_distance) const;
  // For many checks of states that carry what `state` carries; immutable, for any number of threads.
  std::shared_ptr<const CollisionChecker> checker(const RobotState& state, const std::string& group, bool padded = true,
                                                  const AllowedCollisionMatrix* acm = nullptr) const;

private:
  World& worldToWrite();
  void addToWorld(const WorldObject& object);
  void rebuildRobotGeometry();

  RobotModelPtr model_;
  RobotState state_;
  std::map<std::string, Transform> transforms_;
  std::shared_ptr<World> world_;
  std::shared_ptr<const AllowedCollisionMatrix> acm_;
  std::shared_ptr<const RobotGeometry> robot_;
  std::map<std::string, double> padding_, scale_;
  mutable std::mutex cache_lock_;
  mutable std::vector<std::shared_ptr<const CollisionChecker>> cache_;
};

// A test of many states that carry what `like` carries; reads only, for any number of threads.
class CollisionFree
{
public:
  CollisionFree(const PlanningScene& scene, const RobotState& like, const std::string& group, bool padded = true)
    : checker_(scene.checker(like, group, padded))
  {
  }
  bool operator()(const RobotState& state) const;

private:
  std::shared_ptr<const CollisionChecker> checker_;
};
}  // namespace motion
