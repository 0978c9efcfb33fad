#include "joint_space.hpp"

#include "path_walk.hpp"

#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cstring>

namespace ob = ompl::base;

namespace motion
{
namespace
{
// The words of a list between commas or blanks.
std::vector<std::string> listed(const std::string& text)
{
  std::vector<std::string> names;
  std::string name;
  for (char c : text + ",")
    if (c != ',' && c != ' ')
      name += c;
    else if (!name.empty())
    {
      names.push_back(name);
      name.clear();
    }
  return names;
}
}  // namespace

std::unique_ptr<RobotState> StatePool::take()
{
  {
    std::lock_guard<std::mutex> guard(lock_);
    if (!free_.empty())
    {
      auto state = std::move(free_.back());
      free_.pop_back();
      return state;
    }
  }
  return std::make_unique<RobotState>(like_);
}

void StatePool::give(std::unique_ptr<RobotState> state)
{
  std::lock_guard<std::mutex> guard(lock_);
  free_.push_back(std::move(state));
}

// ---------------------------------------------------------------- JointSpace

JointSpace::JointSpace(const RobotModelPtr& model, const JointModelGroup& group, StatePool& pool)
  : model_(model)
  , group_(group)
  , pool_(pool)
{
  setName(group.name);
  for (int j : group.active_joints)
  {
    const JointModel& joint = model->joints[j];
    joints_.push_back(&joint);
    first_.push_back(static_cast<int>(lower_.size()));
    for (int k = 0; k < joint.variable_count; ++k)
    {
      const VariableBounds& b = joint.bounds[k];
      const bool angle = joint.continuous || (joint.type == JointType::Planar && k == 2);
      endless_.push_back(angle);
      // Without bounds OMPL cannot sample: a cube of 10 m, as upstream's default workspace.
      lower_.push_back(b.has_position ? b.min_position : angle ? -M_PI : joint.type == JointType::Revolute ? -2 * M_PI : -5.0);
      upper_.push_back(b.has_position ? b.max_position : angle ? M_PI : joint.type == JointType::Revolute ? 2 * M_PI : 5.0);
    }
  }
}

void JointSpace::limit(std::size_t index, double lower, double upper)
{
  lower_[index] = std::max(lower_[index], lower);
  upper_[index] = std::min(upper_[index], upper);
  if (lower_[index] > upper_[index])
    throw InvalidInput("nothing is left of the range of '" + group_.variable_names[index] +
                       "': the path constraints or the workspace exclude all of it");
}

// As upstream, what such a setting says wrongly is left out and does not keep the group from being planned for: configurations are
// copied from robot to robot.
std::vector<std::string> JointSpace::setProjection(const std::string& text)
{
  if (text.empty())
    return {};
  const std::size_t open = text.find('('), close = text.find(')');
  const bool call = open != std::string::npos && close != std::string::npos && open < close;
  const std::string kind = call ? text.substr(0, open) : "";
  const std::vector<std::string> names = call ? listed(text.substr(open + 1, close - open - 1)) : std::vector<std::string>();
  std::vector<std::string> problems;
  const std::string is = "projection_evaluator '" + text.substr(0, 60) + "' ";
  if (kind == "link" && names.size() == 1)
  {
    if (const LinkModel* link = model_->findLink(names[0]))
      projection_link_ = link->index;
    else
      problems.push_back(is + "names no link of robot '" + model_->name + "': the default is used");
  }
  else if (kind == "joints" && !names.empty())
    for (const std::string& joint : names)
    {
      const auto found = std::find(group_.variable_names.begin(), group_.variable_names.end(), joint);
      const JointModel* other = model_->findJoint(joint);
      if (found == group_.variable_names.end() && other && other->mimic >= 0)
        continue;  // it follows one that may be named as well
      if (found == group_.variable_names.end())
        problems.push_back(is + "names '" + joint + "', which is no joint of group '" + group_.name + "': left out");
      else
        projection_joints_.push_back(static_cast<int>(found - group_.variable_names.begin()));
    }
  else
    problems.push_back(is + "is neither joints(a,b) nor link(l): the default is used");
  return problems;
}

double JointSpace::distance(const double* a, const double* b) const
{
  double sum = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    sum += joints_[i]->distance_factor * joints_[i]->distance(a + first_[i], b + first_[i]);
  return sum;
}

void JointSpace::sample(double* values, const std::function<double(double, double)>& uniform) const
{
  for (std::size_t i = 0; i < size(); ++i)
    values[i] = uniform(lower_[i], upper_[i]);
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i]->type == JointType::Floating)
    {
      double* q = values + first_[i] + 3;
      const double u = uniform(0, 1), x = 2 * M_PI * uniform(0, 1), y = 2 * M_PI * uniform(0, 1);
      q[0] = std::sqrt(1 - u) * std::sin(x), q[1] = std::sqrt(1 - u) * std::cos(x);
      q[2] = std::sqrt(u) * std::sin(y), q[3] = std::sqrt(u) * std::cos(y);
    }
}

void JointSpace::clip(double* values) const
{
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    joints_[i]->enforceBounds(values + first_[i]);
    const bool floating = joints_[i]->type == JointType::Floating;
    for (int k = 0; k < (floating ? 3 : joints_[i]->variable_count); ++k)
    {
      const int index = first_[i] + k;
      values[index] = std::min(std::max(values[index], lower_[index]), upper_[index]);
    }
  }
}

bool JointSpace::project(double* values) const
{
  StatePool::Lease lease(pool_);
  RobotState& state = *lease;
  state.setGroup(group_, values);
  if (!constraints_->project(state, group_))
    return false;
  state.getGroup(group_, values);
  return true;
}

unsigned int JointSpace::getDimension() const
{
  unsigned int dimension = 0;
  for (const JointModel* joint : joints_)
    dimension += joint->type == JointType::Floating ? 6 : joint->variable_count;
  return dimension;
}

double JointSpace::getMaximumExtent() const
{
  double sum = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    const JointModel& joint = *joints_[i];
    auto range = [&](int k) { return upper_[first_[i] + k] - lower_[first_[i] + k]; };
    double extent = joint.continuous ? M_PI : range(0);
    if (joint.type == JointType::Planar)
      extent = std::hypot(range(0), range(1)) + joint.angular_distance_weight * M_PI;
    if (joint.type == JointType::Floating)
      extent = Vector3(range(0), range(1), range(2)).norm() + joint.angular_distance_weight * M_PI / 2;
    sum += joint.distance_factor * extent;
  }
  return std::max(sum, 1e-6);
}

double JointSpace::getMeasure() const
{
  double product = 1;
  for (std::size_t i = 0; i < size(); ++i)
    product *= std::max(upper_[i] - lower_[i], 1e-6);
  return product;
}

void JointSpace::enforceBounds(ob::State* state) const { clip(values(state)); }

bool JointSpace::satisfiesBounds(const ob::State* state) const
{
  const double* v = values(state);
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (!joints_[i]->satisfiesBounds(v + first_[i], 1e-9))
      return false;
  for (std::size_t i = 0; i < size(); ++i)
    if (v[i] < lower_[i] - 1e-9 || v[i] > upper_[i] + 1e-9)
      return false;
  return true;
}

void JointSpace::copyState(ob::State* to, const ob::State* from) const
{
  std::memcpy(values(to), values(from), size() * sizeof(double));
}

double JointSpace::distance(const ob::State* a, const ob::State* b) const { return distance(values(a), values(b)); }

bool JointSpace::equalStates(const ob::State* a, const ob::State* b) const
{
  const double *va = values(a), *vb = values(b);
  for (std::size_t i = 0; i < size(); ++i)
    if (std::abs(va[i] - vb[i]) > 1e-12)
      return false;
  return true;
}

void JointSpace::interpolate(const ob::State* from, const ob::State* to, double t, ob::State* state) const
{
  const double *a = values(from), *b = values(to);
  double* out = values(state);
  for (std::size_t i = 0; i < joints_.size(); ++i)
    joints_[i]->interpolate(a + first_[i], b + first_[i], t, out + first_[i]);
  if (constraints_ && t > 1e-9 && t < 1 - 1e-9)
    project(out);
}

namespace
{
class Sampler : public ob::StateSampler
{
public:
  explicit Sampler(const JointSpace* space) : StateSampler(space), joints_(*space) {}

  void sampleUniform(ob::State* state) override
  {
    // What cannot be projected is left as it is: the validity check refuses it.
    for (int attempt = 0; attempt < 4; ++attempt)
    {
      joints_.sample(JointSpace::values(state), [this](double low, double high) { return rng_.uniformReal(low, high); });
      if (!joints_.projects() || joints_.project(JointSpace::values(state)))
        return;
    }
  }

  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override
  {
    around(state, near, [&]() { return rng_.uniformReal(-distance, distance); });
  }

  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override
  {
    around(state, mean, [&]() { return rng_.gaussian(0, deviation); });
  }

private:
  template <typename Draw>
  void around(ob::State* state, const ob::State* centre, Draw&& draw)
  {
    double* values = JointSpace::values(state);
    const double* from = JointSpace::values(centre);
    for (std::size_t i = 0; i < joints_.size(); ++i)
      values[i] = from[i] + draw();
    joints_.clip(values);
    if (joints_.projects())
      joints_.project(values);
  }

  const JointSpace& joints_;
};

class JointProjection : public ob::ProjectionEvaluator
{
public:
  JointProjection(const JointSpace* space, std::vector<int> joints) : ProjectionEvaluator(space), joints_(std::move(joints)) {}
  unsigned int getDimension() const override { return static_cast<unsigned int>(joints_.size()); }
  void defaultCellSizes() override { cellSizes_.assign(joints_.size(), 0.1); }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> out) const override
  {
    for (std::size_t i = 0; i < joints_.size(); ++i)
      out[i] = JointSpace::values(state)[joints_[i]];
  }

private:
  std::vector<int> joints_;
};

class LinkProjection : public ob::ProjectionEvaluator
{
public:
  LinkProjection(const JointSpace* space, int link) : ProjectionEvaluator(space), joints_(*space), link_(link) {}
  unsigned int getDimension() const override { return 3; }
  void defaultCellSizes() override { cellSizes_.assign(3, 0.1); }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> out) const override
  {
    StatePool::Lease lease(joints_.pool());
    (*lease).setGroup(joints_.group(), JointSpace::values(state));
    out = (*lease).linkPose(link_).translation();
  }

private:
  const JointSpace& joints_;
  int link_;
};
}  // namespace

ob::StateSamplerPtr JointSpace::allocDefaultStateSampler() const { return std::make_shared<Sampler>(this); }

ob::State* JointSpace::allocState() const
{
  auto* state = new StateType();
  state->values = new double[size()]();
  return state;
}

void JointSpace::freeState(ob::State* state) const
{
  auto* own = static_cast<StateType*>(state);
  delete[] own->values;
  delete own;
}

double* JointSpace::getValueAddressAtIndex(ob::State* state, unsigned int index) const
{
  return index < size() ? values(state) + index : nullptr;
}

unsigned int JointSpace::getSerializationLength() const { return static_cast<unsigned int>(size() * sizeof(double)); }

void JointSpace::serialize(void* bytes, const ob::State* state) const
{
  std::memcpy(bytes, values(state), size() * sizeof(double));
}

void JointSpace::deserialize(ob::State* state, const void* bytes) const
{
  std::memcpy(values(state), bytes, size() * sizeof(double));
}

void JointSpace::registerProjections()
{
  if (projection_link_ >= 0)
  {
    registerDefaultProjection(std::make_shared<LinkProjection>(this, projection_link_));
    return;
  }
  std::vector<int> joints = projection_joints_;
  if (joints.empty())
    joints = size() > 1 ? std::vector<int>{0, 1} : std::vector<int>{0};
  registerDefaultProjection(std::make_shared<JointProjection>(this, joints));
}

// ---------------------------------------------------------------- validity

bool JointSpaceValidity::isValid(const ob::State* state) const
{
  checked.fetch_add(1, std::memory_order_relaxed);
  if (!space_.satisfiesBounds(state))
    return false;
  StatePool::Lease lease(space_.pool());
  RobotState& robot = *lease;
  robot.setGroup(space_.group(), JointSpace::values(state));
  return (!constraints_ || constraints_->satisfied(robot)) && free_(robot);
}

double CloseMotion::gone(const ob::State* a, const ob::State* b) const
{
  const double* from = JointSpace::values(a);
  const double* to = JointSpace::values(b);
  double largest = 1e-9;
  for (std::size_t i = 0; i < space_.size(); ++i)
    largest = std::max(largest, std::abs(to[i] - from[i]));  // of an endless joint at most too large: steps get smaller
  StatePool::Lease lease(space_.pool());
  RobotState& robot = *lease;
  robot.setGroup(space_.group(), from);
  PathWalk walk(checker_);
  walk.start(robot);
  ob::State* now = si_->allocState();
  const double share = walk.go(
      [&](double part) -> const RobotState& {
        space_.interpolate(a, b, part, now);
        robot.setGroup(space_.group(), JointSpace::values(now));
        return robot;
      },
      std::min(1.0, 0.05 / largest));
  si_->freeState(now);
  return share;
}

bool CloseMotion::checkMotion(const ob::State* a, const ob::State* b) const
{
  const bool valid = coarse_.checkMotion(a, b) && gone(a, b) >= 1;
  valid ? ++valid_ : ++invalid_;
  return valid;
}

bool CloseMotion::checkMotion(const ob::State* a, const ob::State* b, std::pair<ob::State*, double>& last_valid) const
{
  last_valid.second = gone(a, b);
  const bool valid = last_valid.second >= 1 && si_->isValid(b);
  if (!valid)
  {
    last_valid.second = std::min(last_valid.second, 0.999);
    if (last_valid.first)
      space_.interpolate(a, b, last_valid.second, last_valid.first);
  }
  valid ? ++valid_ : ++invalid_;
  return valid;
}

bool ProjectedMotion::walk(const ob::State* a, const ob::State* b, double& reached, ob::State* last) const
{
  const auto& space = si_->getStateSpace();
  const unsigned int count = std::max(1u, space->validSegmentCount(a, b));
  const double step = space->distance(a, b) / count;
  ob::State *before = si_->cloneState(a), *now = si_->allocState();
  bool valid = true;
  reached = 0;
  for (unsigned int i = 1; i <= count && valid; ++i)
  {
    space->interpolate(a, b, static_cast<double>(i) / count, now);
    valid = si_->isValid(now) && space->distance(before, now) < 4 * step + 1e-3;
    if (valid)
    {
      reached = static_cast<double>(i) / count;
      std::swap(before, now);
    }
  }
  if (last && !valid)
    si_->copyState(last, before);
  si_->freeState(before);
  si_->freeState(now);
  valid ? ++valid_ : ++invalid_;
  return valid;
}

bool ProjectedMotion::checkMotion(const ob::State* a, const ob::State* b) const
{
  double reached;
  return walk(a, b, reached, nullptr);
}

bool ProjectedMotion::checkMotion(const ob::State* a, const ob::State* b, std::pair<ob::State*, double>& last_valid) const
{
  return walk(a, b, last_valid.second, last_valid.first);
}
}  // namespace motion
