// Collision checks compiled: which parts of the robot, which pairs, which objects, looked up once and not per check.
#pragma once

#include <map>

#include "collision_shape.hpp"
#include "motion/cost_sources.hpp"
#include "motion/planning_scene.hpp"

namespace motion
{
// The shapes of the links, bare and as padded for checks against the world.
class RobotGeometry
{
public:
  struct Part
  {
    int link;
    Transform origin;
    CollisionShapePtr bare, padded;
  };
  std::vector<Part> parts;
  std::vector<double> padding, scale;  // of each link, in the model's order: what it carries has them as well
};

class World
{
public:
  struct Part
  {
    CollisionShapePtr shape;
    Transform pose;
    Aabb box;
  };
  struct Object
  {
    WorldObject object;
    std::vector<Part> parts;
  };
  std::map<std::string, std::shared_ptr<const Object>> objects;
};

class CollisionChecker
{
public:
  struct Inputs
  {
    RobotModelPtr model;
    std::shared_ptr<const World> world;
    std::shared_ptr<const AllowedCollisionMatrix> acm;
    std::shared_ptr<const RobotGeometry> robot;
    std::shared_ptr<const AttachedBodies> attached;
    std::string group;
    bool padded;

    bool operator==(const Inputs& o) const
    {
      return world == o.world && acm == o.acm && robot == o.robot && attached == o.attached && group == o.group &&
             padded == o.padded;
    }
  };

  explicit CollisionChecker(Inputs inputs);
  const Inputs& inputs() const { return inputs_; }

  // The state must carry what the checker was made for.
  bool collides(const RobotState& state) const;
  CollisionResult check(const RobotState& state, const CollisionRequest& request) const;
  // At most `most` of each pair of shapes.
  std::vector<CostSource> costs(const RobotState& state, const CollisionRequest& request, std::size_t most) const;
  DistanceResult distance(const RobotState& state, double max_distance, bool self = true, bool world = true) const;
  std::size_t selfPairs() const { return self_pairs_.size(); }

private:
  struct Body
  {
    BodyType type;
    std::string id;
    int link;  // -1: world
    const AttachedBody* attached = nullptr;
  };
  struct Part
  {
    int body;
    int link;
    Transform origin;
    CollisionShapePtr bare, padded;
    bool meets_world;
  };
  struct WorldPart
  {
    int body;
    const World::Part* part;
  };
  friend class PathWalk;
  struct Scratch
  {
    std::vector<Transform> poses;
    std::vector<Aabb> bare, padded;
  };
  struct Search;

  void addRobot();
  void addAttached();
  void addSelfPairs();
  void addWorld();
  bool moves(const Body& body) const;
  bool mayTouch(const Body& a, const Body& b) const;
  void place(const RobotState& state, Scratch& scratch) const;
  bool test(const CollisionShape& a, const Transform& pose_a, int body_a, const CollisionShape& b, const Transform& pose_b,
            int body_b, Search& search) const;
  bool searchWorld(const Scratch& scratch, Search& search) const;
  bool searchSelf(const Scratch& scratch, Search& search) const;

  Inputs inputs_;
  const JointModelGroup* group_ = nullptr;
  std::vector<Body> bodies_;  // robot and attached first, then the world's
  std::vector<Part> parts_;
  std::vector<std::pair<int, int>> self_pairs_;
  std::vector<WorldPart> world_parts_;
  std::vector<char> world_allowed_;  // [robot body * world bodies + world body]
  std::size_t robot_bodies_ = 0, world_bodies_ = 0;
  AabbTree tree_;
};
}  // namespace motion
