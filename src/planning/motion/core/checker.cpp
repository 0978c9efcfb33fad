#include "checker.hpp"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "triangles.hpp"

namespace motion
{
struct CollisionChecker::Search
{
  const CollisionRequest* request = nullptr;  // null: only yes or no
  CollisionResult* result = nullptr;
  std::map<std::pair<int, int>, std::size_t> found;
  std::vector<CostSource>* costs = nullptr;  // where only these are asked for
  std::size_t most_costs = 0;
};

namespace
{
void addCosts(const CollisionShape& a, const Transform& pose_a, const CollisionShape& b, const Transform& pose_b,
              std::size_t most, std::vector<CostSource>& costs)
{
  fcl::CollisionResultd result;
  fcl::collide(a.geometry.get(), pose_a, b.geometry.get(), pose_b, fcl::CollisionRequestd(1, true, most, true), result);
  std::vector<fcl::CostSourced> found;
  result.getCostSources(found);
  for (const fcl::CostSourced& source : found)
    costs.push_back({source.aabb_min, source.aabb_max, source.cost_density});
}
}  // namespace

CollisionChecker::CollisionChecker(Inputs inputs) : inputs_(std::move(inputs))
{
  if (!inputs_.group.empty())
    group_ = &inputs_.model->group(inputs_.group);
  addRobot();
  addAttached();
  robot_bodies_ = bodies_.size();
  addSelfPairs();
  addWorld();
}

void CollisionChecker::addRobot()
{
  std::vector<int> body_of(inputs_.model->links.size(), -1);
  for (const RobotGeometry::Part& part : inputs_.robot->parts)
  {
    int& body = body_of[part.link];
    if (body < 0)
    {
      body = static_cast<int>(bodies_.size());
      bodies_.push_back({BodyType::RobotLink, inputs_.model->links[part.link].name, part.link, nullptr});
    }
    parts_.push_back({body, part.link, part.origin, part.bare, inputs_.padded ? part.padded : part.bare, moves(bodies_[body])});
  }
}

void CollisionChecker::addAttached()
{
  if (!inputs_.attached)
    return;
  for (const auto& [id, attached] : *inputs_.attached)
  {
    const int link = inputs_.model->link(attached->link).index;
    const int body = static_cast<int>(bodies_.size());
    bodies_.push_back({BodyType::Attached, id, link, attached.get()});
    // As in MoveIt, what a link carries has that link's padding and scale.
    const double padding = inputs_.padded ? inputs_.robot->padding[link] : 0.0;
    const double scale = inputs_.padded ? inputs_.robot->scale[link] : 1.0;
    for (std::size_t i = 0; i < attached->shapes.size(); ++i)
    {
      const CollisionShapePtr bare = collisionShape(attached->shapes[i], 1.0, 0.0);
      parts_.push_back({body, link, attached->pose * attached->shape_poses[i], bare,
                        padding == 0.0 && scale == 1.0 ? bare : collisionShape(attached->shapes[i], scale, padding),
                        moves(bodies_[body])});
    }
  }
}

bool CollisionChecker::moves(const Body& body) const { return body.link >= 0 && (!group_ || group_->link_updated[body.link]); }

bool CollisionChecker::mayTouch(const Body& a, const Body& b) const
{
  if (inputs_.acm && inputs_.acm->allowed(a.id, b.id))
    return true;
  if (a.attached && b.attached)
    return a.link == b.link;
  if (a.attached && b.type == BodyType::RobotLink)
    return a.attached->touch_links.count(b.id) > 0;
  if (b.attached && a.type == BodyType::RobotLink)
    return b.attached->touch_links.count(a.id) > 0;
  return false;
}

void CollisionChecker::addSelfPairs()
{
  const std::size_t n = bodies_.size();
  std::vector<char> wanted(n * n, 0);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      wanted[a * n + b] = (moves(bodies_[a]) || moves(bodies_[b])) && !mayTouch(bodies_[a], bodies_[b]);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (std::size_t j = i + 1; j < parts_.size(); ++j)
    {
      const std::size_t a = parts_[i].body, b = parts_[j].body;
      if (a != b && wanted[std::min(a, b) * n + std::max(a, b)])
        self_pairs_.emplace_back(static_cast<int>(i), static_cast<int>(j));
    }
}

void CollisionChecker::addWorld()
{
  world_bodies_ = inputs_.world->objects.size();
  world_allowed_.assign(robot_bodies_ * world_bodies_, 0);
  std::vector<Aabb> boxes;
  std::size_t index = 0;
  for (const auto& [id, object] : inputs_.world->objects)
  {
    const int body = static_cast<int>(bodies_.size());
    bodies_.push_back({BodyType::WorldObject, id, -1, nullptr});
    const bool known = inputs_.acm && (inputs_.acm->knows(id) || !inputs_.acm->defaults().empty());
    if (known)
      for (std::size_t r = 0; r < robot_bodies_; ++r)
        world_allowed_[r * world_bodies_ + index] = mayTouch(bodies_[r], bodies_[body]);
    for (const World::Part& part : object->parts)
    {
      world_parts_.push_back({body, &part});
      boxes.push_back(part.box);
    }
    ++index;
  }
  tree_.build(boxes);
}

// ---------------------------------------------------------------- checks

void CollisionChecker::place(const RobotState& state, Scratch& scratch) const
{
  const auto& links = state.linkPoses();
  scratch.poses.resize(parts_.size());
  scratch.bare.resize(parts_.size());
  scratch.padded.resize(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i)
  {
    scratch.poses[i] = links[parts_[i].link] * parts_[i].origin;
    scratch.bare[i] = boundsOf(*parts_[i].bare, scratch.poses[i]);
    scratch.padded[i] = parts_[i].padded == parts_[i].bare ? scratch.bare[i] : boundsOf(*parts_[i].padded, scratch.poses[i]);
  }
}

// True ends the search.
bool CollisionChecker::test(const CollisionShape& a, const Transform& pose_a, int body_a, const CollisionShape& b,
                            const Transform& pose_b, int body_b, Search& search) const
{
  if (search.costs)
  {
    addCosts(a, pose_a, b, pose_b, search.most_costs, *search.costs);
    return false;
  }
  const Touch known = knownTouch(a, pose_a, b, pose_b);
  if (known == Touch::No)
    return false;
  if (known == Touch::Yes && !search.request)
    return search.result->collision = true;
  std::size_t want = 0;
  std::size_t* have = nullptr;
  if (search.request && search.request->contacts > search.result->contacts.size())
  {
    have = &search.found[{std::min(body_a, body_b), std::max(body_a, body_b)}];
    if (*have < search.request->contacts_per_pair)
      want = std::min(search.request->contacts_per_pair - *have, search.request->contacts - search.result->contacts.size());
    else
      return false;
  }
  fcl::CollisionRequestd request(std::max<std::size_t>(want, 1), want > 0);
  fcl::CollisionResultd result;
  if (fcl::collide(a.geometry.get(), pose_a, b.geometry.get(), pose_b, request, result) == 0)
    return false;
  search.result->collision = true;
  for (std::size_t i = 0; i < want && i < result.numContacts(); ++i)
  {
    const fcl::Contactd& c = result.getContact(i);
    const bool swapped = c.o1 == b.geometry.get() && c.o2 != b.geometry.get();
    const Body &one = bodies_[body_a], &two = bodies_[body_b];
    search.result->contacts.push_back(
        {one.id, two.id, one.type, two.type, c.pos, swapped ? Vector3(-c.normal) : c.normal, c.penetration_depth});
    ++*have;
  }
  return !search.request || search.result->contacts.size() >= search.request->contacts;
}

bool CollisionChecker::searchWorld(const Scratch& scratch, Search& search) const
{
  if (world_parts_.empty())
    return false;
  for (std::size_t i = 0; i < parts_.size(); ++i)
  {
    if (!parts_[i].meets_world)
      continue;
    const char* allowed = &world_allowed_[parts_[i].body * world_bodies_];
    const bool done = tree_.query(scratch.padded[i], [&](int k) {
      const WorldPart& other = world_parts_[k];
      return !allowed[other.body - robot_bodies_] && test(*parts_[i].padded, scratch.poses[i], parts_[i].body,
                                                          *other.part->shape, other.part->pose, other.body, search);
    });
    if (done)
      return true;
  }
  return false;
}

bool CollisionChecker::searchSelf(const Scratch& scratch, Search& search) const
{
  for (const auto& [i, j] : self_pairs_)
    if (scratch.bare[i].overlaps(scratch.bare[j]) &&
        test(*parts_[i].bare, scratch.poses[i], parts_[i].body, *parts_[j].bare, scratch.poses[j], parts_[j].body, search))
      return true;
  return false;
}

bool CollisionChecker::collides(const RobotState& state) const
{
  static thread_local Scratch scratch;
  place(state, scratch);
  CollisionResult result;
  Search search;
  search.result = &result;
  return searchWorld(scratch, search) || searchSelf(scratch, search);  // mesh against mesh is dearer
}

CollisionResult CollisionChecker::check(const RobotState& state, const CollisionRequest& request) const
{
  Scratch scratch;
  place(state, scratch);
  CollisionResult result;
  Search search;
  search.request = request.contacts ? &request : nullptr;
  search.result = &result;
  const bool done = request.world && searchWorld(scratch, search);
  if (!done && request.self)
    searchSelf(scratch, search);
  if (request.distance)
    result.distance = distance(state, std::numeric_limits<double>::infinity(), request.self, request.world).distance;
  return result;
}

std::vector<CostSource> CollisionChecker::costs(const RobotState& state, const CollisionRequest& request,
                                                std::size_t most) const
{
  Scratch scratch;
  place(state, scratch);
  std::vector<CostSource> found;
  Search search;
  search.costs = &found;
  search.most_costs = most;
  if (request.world)
    searchWorld(scratch, search);
  if (request.self)
    searchSelf(scratch, search);
  return found;
}

DistanceResult CollisionChecker::distance(const RobotState& state, double max_distance, bool self, bool world) const
{
  struct Candidate
  {
    double bound;
    int i, j;
    bool world;
  };
  Scratch scratch;
  place(state, scratch);
  std::vector<Candidate> candidates;
  for (std::size_t pair = 0; self && pair < self_pairs_.size(); ++pair)
  {
    const auto& [i, j] = self_pairs_[pair];
    candidates.push_back({scratch.bare[i].distance(scratch.bare[j]), i, j, false});
  }
  for (std::size_t i = 0; world && i < parts_.size(); ++i)
    for (std::size_t k = 0; parts_[i].meets_world && k < world_parts_.size(); ++k)
      if (!world_allowed_[parts_[i].body * world_bodies_ + world_parts_[k].body - robot_bodies_])
        candidates.push_back(
            {scratch.padded[i].distance(world_parts_[k].part->box), static_cast<int>(i), static_cast<int>(k), true});
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
  DistanceResult best;
  best.distance = max_distance;
  for (const Candidate& c : candidates)
  {
    if (c.bound >= best.distance || best.distance <= 0)
      break;
    const CollisionShape& a = c.world ? *parts_[c.i].padded : *parts_[c.i].bare;
    const CollisionShape& b = c.world ? *world_parts_[c.j].part->shape : *parts_[c.j].bare;
    const Transform& pose_b = c.world ? world_parts_[c.j].part->pose : scratch.poses[c.j];
    fcl::CollisionRequestd touch(1, false);
    fcl::CollisionResultd touching;
    fcl::DistanceResultd result;
    double found = 0;
    if (fcl::collide(a.geometry.get(), scratch.poses[c.i], b.geometry.get(), pose_b, touch, touching) == 0)
      found = std::max(0.0, fcl::distance(a.geometry.get(), scratch.poses[c.i], b.geometry.get(), pose_b,
                                          fcl::DistanceRequestd(true), result));
    if (found < best.distance)
    {
      best.distance = found;
      best.body_1 = bodies_[parts_[c.i].body].id;
      best.body_2 = bodies_[c.world ? world_parts_[c.j].body : parts_[c.j].body].id;
      best.point_1 = result.nearest_points[0];
      best.point_2 = result.nearest_points[1];
    }
  }
  return best;
}
}  // namespace motion
