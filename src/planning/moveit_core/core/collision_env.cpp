// The checks of a scene under the name of MoveIt's detector.
#include <moveit/collision_detection/collision_env.h>

#include <moveit/planning_scene/planning_scene.h>

#include <algorithm>

#include "motion/planning_scene.hpp"

namespace collision_detection
{
using moveit::core::RobotState;
using planning_scene::PlanningScene;

namespace
{
// The robot without its world.
motion::PlanningScene aloneScene(const motion::PlanningScene& scene, const motion::AllowedCollisionMatrix& acm)
{
  motion::PlanningScene alone(scene);
  alone.clearObjects();
  alone.setOctomap(nullptr, motion::Transform::Identity());
  alone.setAcm(acm);
  return alone;
}

// A scene in which all parts of the robot may touch each other: what is left is the world.
motion::PlanningScene worldScene(const motion::PlanningScene& scene, const RobotState& state,
                                 const motion::AllowedCollisionMatrix& acm, bool padded)
{
  std::vector<std::string> bodies = state.getRobotModel()->getLinkModelNamesWithCollisionGeometry();
  for (const auto& body : state.core().attached())
    bodies.push_back(body.first);
  motion::AllowedCollisionMatrix world_only = acm;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      world_only.setEntry(bodies[i], bodies[j], motion::AllowedCollisionMatrix::Allowed);
  motion::PlanningScene world(scene);
  world.setAcm(world_only);
  if (!padded)
  {
    world.setPadding({});
    world.setScale({});
  }
  return world;
}

BodyType kindOf(const RobotState& state, const std::string& body)
{
  if (state.core().attached().count(body))
    return BodyTypes::ROBOT_ATTACHED;
  return state.getRobotModel()->hasLinkModel(body) ? BodyTypes::ROBOT_LINK : BodyTypes::WORLD_OBJECT;
}

DistanceResultsData dataOf(const RobotState& state, const motion::DistanceResult& found)
{
  DistanceResultsData data;
  data.distance = found.distance;
  data.link_names[0] = found.body_1;
  data.link_names[1] = found.body_2;
  data.nearest_points[0] = found.point_1;
  data.nearest_points[1] = found.point_2;
  data.body_types[0] = kindOf(state, found.body_1);
  data.body_types[1] = kindOf(state, found.body_2);
  if (found.distance > 0.0)
    data.normal = (found.point_2 - found.point_1).normalized();
  return data;
}

// The nearest pair, then the nearest of the others ...
void fill(const DistanceRequest& req, DistanceResult& res, const RobotState& state, motion::PlanningScene scene)
{
  const std::string group = state.getRobotModel()->hasJointModelGroup(req.group_name) ? req.group_name : "";
  motion::AllowedCollisionMatrix acm = scene.acm();
  for (;;)
  {
    const motion::DistanceResult found = scene.distance(state.core(), group, req.distance_threshold);
    if (found.body_1.empty() || found.distance > req.distance_threshold)
      return;
    const DistanceResultsData data = dataOf(state, found);
    if (data.distance < res.minimum_distance.distance)
      res.minimum_distance = data;
    res.collision = res.collision || data.distance <= 0.0;
    if (req.type == DistanceRequestType::GLOBAL)
      return;
    res.distances[std::minmax(found.body_1, found.body_2)].push_back(data);
    if (acm.entry(found.body_1, found.body_2) == motion::AllowedCollisionMatrix::Allowed)
      return;  // it does not get past this pair
    acm.setEntry(found.body_1, found.body_2, motion::AllowedCollisionMatrix::Allowed);
    scene.setAcm(acm);
  }
}
}  // namespace

void CollisionEnv::checkSelfCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state) const
{
  scene_.check(PlanningScene::SELF, padded_, req, res, state, AllowedCollisionMatrix());
}

void CollisionEnv::checkSelfCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                                      const AllowedCollisionMatrix& acm) const
{
  scene_.check(PlanningScene::SELF, padded_, req, res, state, acm);
}

void CollisionEnv::checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state) const
{
  scene_.check(PlanningScene::WORLD, padded_, req, res, state, AllowedCollisionMatrix());
}

void CollisionEnv::checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                                       const AllowedCollisionMatrix& acm) const
{
  scene_.check(PlanningScene::WORLD, padded_, req, res, state, acm);
}

void CollisionEnv::checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state1,
                                       const RobotState& state2) const
{
  checkRobotCollision(req, res, state1, state2, AllowedCollisionMatrix());
}

void CollisionEnv::checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state1,
                                       const RobotState& state2, const AllowedCollisionMatrix& acm) const
{
  double farthest = 0.0;
  for (std::size_t i = 0; i < state1.getVariableCount(); ++i)
    farthest = std::max(farthest, std::abs(state1.getVariablePosition(i) - state2.getVariablePosition(i)));
  const int steps = std::min(100000, static_cast<int>(std::ceil(farthest / 0.01)) + 1);
  RobotState between(state1);
  for (int i = 0; i <= steps && !res.collision; ++i)
  {
    state1.interpolate(state2, static_cast<double>(i) / steps, between);
    checkRobotCollision(req, res, between, acm);
  }
}

void CollisionEnv::checkCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state) const
{
  checkCollision(req, res, state, AllowedCollisionMatrix());
}

void CollisionEnv::checkCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                                  const AllowedCollisionMatrix& acm) const
{
  scene_.check(PlanningScene::SELF | PlanningScene::WORLD, padded_, req, res, state, acm);
}

double CollisionEnv::distanceSelf(const RobotState& state) const { return distanceSelf(state, AllowedCollisionMatrix()); }

double CollisionEnv::distanceSelf(const RobotState& state, const AllowedCollisionMatrix& acm) const
{
  return aloneScene(scene_.core(), acm.core()).distance(state.core(), "", std::numeric_limits<double>::infinity()).distance;
}

double CollisionEnv::distanceRobot(const RobotState& state, bool /*verbose*/) const
{
  return distanceRobot(state, AllowedCollisionMatrix());
}

double CollisionEnv::distanceRobot(const RobotState& state, const AllowedCollisionMatrix& acm, bool /*verbose*/) const
{
  return worldScene(scene_.core(), state, acm.core(), padded_)
      .distance(state.core(), "", std::numeric_limits<double>::infinity())
      .distance;
}

void CollisionEnv::distanceSelf(const DistanceRequest& req, DistanceResult& res, const RobotState& state) const
{
  const AllowedCollisionMatrix none;
  fill(req, res, state, aloneScene(scene_.core(), (req.acm ? *req.acm : none).core()));
}

void CollisionEnv::distanceRobot(const DistanceRequest& req, DistanceResult& res, const RobotState& state) const
{
  const AllowedCollisionMatrix none;
  fill(req, res, state, worldScene(scene_.core(), state, (req.acm ? *req.acm : none).core(), padded_));
}

const WorldPtr& CollisionEnv::getWorld() { return scene_.world_; }

const moveit::core::RobotModelConstPtr& CollisionEnv::getRobotModel() const { return scene_.robot_model_; }

// ---------------------------------------------------------------- padding and scale

void CollisionEnv::setPadding(double padding)
{
  std::map<std::string, double> all;
  for (const std::string& name : scene_.robot_model_->getLinkModelNamesWithCollisionGeometry())
    all[name] = padding;
  scene_.core_->setPadding(all);
}

void CollisionEnv::setScale(double scale)
{
  std::map<std::string, double> all;
  for (const std::string& name : scene_.robot_model_->getLinkModelNamesWithCollisionGeometry())
    all[name] = scale;
  scene_.core_->setScale(all);
}

void CollisionEnv::setLinkPadding(const std::string& link_name, double padding)
{
  setLinkPadding(std::map<std::string, double>{ { link_name, padding } });
}

void CollisionEnv::setLinkPadding(const std::map<std::string, double>& padding)
{
  std::map<std::string, double> all = scene_.core_->padding();
  for (const auto& item : padding)
    all[item.first] = item.second;
  scene_.core_->setPadding(all);
}

void CollisionEnv::setLinkScale(const std::string& link_name, double scale)
{
  setLinkScale(std::map<std::string, double>{ { link_name, scale } });
}

void CollisionEnv::setLinkScale(const std::map<std::string, double>& scale)
{
  std::map<std::string, double> all = scene_.core_->scale();
  for (const auto& item : scale)
    all[item.first] = item.second;
  scene_.core_->setScale(all);
}

double CollisionEnv::getLinkPadding(const std::string& link_name) const
{
  const auto found = getLinkPadding().find(link_name);
  return found == getLinkPadding().end() ? 0.0 : found->second;
}

double CollisionEnv::getLinkScale(const std::string& link_name) const
{
  const auto found = getLinkScale().find(link_name);
  return found == getLinkScale().end() ? 1.0 : found->second;
}

const std::map<std::string, double>& CollisionEnv::getLinkPadding() const { return scene_.core_->padding(); }

const std::map<std::string, double>& CollisionEnv::getLinkScale() const { return scene_.core_->scale(); }

void CollisionEnv::setPadding(const std::vector<moveit_msgs::LinkPadding>& padding)
{
  for (const auto& item : padding)
    setLinkPadding(item.link_name, item.padding);
}

void CollisionEnv::setScale(const std::vector<moveit_msgs::LinkScale>& scale)
{
  for (const auto& item : scale)
    setLinkScale(item.link_name, item.scale);
}

void CollisionEnv::getPadding(std::vector<moveit_msgs::LinkPadding>& padding) const
{
  padding.clear();
  for (const auto& item : getLinkPadding())
  {
    padding.emplace_back();
    padding.back().link_name = item.first;
    padding.back().padding = item.second;
  }
}

void CollisionEnv::getScale(std::vector<moveit_msgs::LinkScale>& scale) const
{
  scale.clear();
  for (const auto& item : getLinkScale())
  {
    scale.emplace_back();
    scale.back().link_name = item.first;
    scale.back().scale = item.second;
  }
}
}  // namespace collision_detection
