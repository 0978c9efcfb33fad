#include "motion/robot_state.hpp"

#include <algorithm>

namespace motion
{
RobotState::RobotState(RobotModelPtr model) : model_(std::move(model)), positions_(model_->defaults) {}

// ---------------------------------------------------------------- variables

void RobotState::follow(const JointModel& joint)
{
  for (int index : joint.mimicked_by)
  {
    const JointModel& mimic = model_->joints[index];
    positions_[mimic.first_variable] = mimic.mimic_factor * positions_[joint.first_variable] + mimic.mimic_offset;
  }
}

void RobotState::setPositions(const double* values)
{
  std::copy(values, values + positions_.size(), positions_.begin());
  for (const JointModel& joint : model_->joints)
    if (!joint.mimicked_by.empty())
      follow(joint);
  dirty_ = true;
}

void RobotState::setVariable(int variable, double value)
{
  positions_[variable] = value;
  follow(model_->joints[model_->variable_joint[variable]]);
  dirty_ = true;
}

void RobotState::setGroup(const JointModelGroup& group, const double* values)
{
  for (std::size_t i = 0; i < group.variables.size(); ++i)
    positions_[group.variables[i]] = values[i];
  for (int j : group.active_joints)
    follow(model_->joints[j]);
  dirty_ = true;
}

void RobotState::getGroup(const JointModelGroup& group, double* values) const
{
  for (std::size_t i = 0; i < group.variables.size(); ++i)
    values[i] = positions_[group.variables[i]];
}

void RobotState::setJoint(const JointModel& joint, const double* values)
{
  std::copy(values, values + joint.variable_count, positions_.begin() + joint.first_variable);
  follow(joint);
  dirty_ = true;
}

void RobotState::setDefault()
{
  positions_ = model_->defaults;
  velocities.clear();
  accelerations.clear();
  efforts.clear();
  dirty_ = true;
}

bool RobotState::setNamed(const JointModelGroup& group, const std::string& state)
{
  const auto found = group.states.find(state);
  if (found == group.states.end())
    return false;
  for (const auto& [name, values] : found->second)
    setJoint(*model_->findJoint(name), values.data());
  return true;
}

double randomValue(const JointModel& joint, int which, Random& random)
{
  const VariableBounds& b = joint.bounds[which];
  double low = b.min_position, high = b.max_position;
  if (!b.has_position)
  {
    const bool angle = joint.type == JointType::Revolute || (joint.type == JointType::Planar && which == 2);
    low = angle ? -M_PI : -1.0;
    high = -low;
  }
  // Not std::uniform_real_distribution: its numbers differ between standard libraries.
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1.0p-53);
}

void randomJoint(const JointModel& joint, double* values, Random& random)
{
  for (int k = 0; k < joint.variable_count; ++k)
    values[k] = randomValue(joint, k, random);
  if (joint.type == JointType::Floating)
  {
    // Uniform over rotations (Shoemake).
    auto uniform = [&random]() { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
    const double u = uniform(), a = 2 * M_PI * uniform(), b = 2 * M_PI * uniform();
    values[3] = std::sqrt(1 - u) * std::sin(a);
    values[4] = std::sqrt(1 - u) * std::cos(a);
    values[5] = std::sqrt(u) * std::sin(b);
    values[6] = std::sqrt(u) * std::cos(b);
  }
}

const std::vector<const JointModel*> RobotState::jointsOf(const JointModelGroup* group) const
{
  std::vector<const JointModel*> out;
  if (group)
    for (int j : group->active_joints)
      out.push_back(&model_->joints[j]);
  else
    for (const JointModel& joint : model_->joints)
      if (joint.active())
        out.push_back(&joint);
  return out;
}

void RobotState::randomize(const JointModelGroup* group, Random& random)
{
  for (const JointModel* joint : jointsOf(group))
  {
    randomJoint(*joint, positions_.data() + joint->first_variable, random);
    follow(*joint);
  }
  dirty_ = true;
}

void RobotState::randomizeNear(const JointModelGroup& group, const RobotState& near, double distance, Random& random)
{
  for (const JointModel* joint : jointsOf(&group))
  {
    double* values = positions_.data() + joint->first_variable;
    const double* centre = near.positions_.data() + joint->first_variable;
    for (int k = 0; k < joint->variable_count; ++k)
      values[k] = centre[k] + distance * (2.0 * static_cast<double>(random() >> 11) * 0x1.0p-53 - 1.0);
    joint->enforceBounds(values);
    follow(*joint);
  }
  dirty_ = true;
}

bool RobotState::satisfiesBounds(const JointModelGroup* group, double margin) const
{
  for (const JointModel* joint : jointsOf(group))
    if (!joint->satisfiesBounds(this->joint(*joint), margin))
      return false;
  return true;
}

void RobotState::enforceBounds(const JointModelGroup* group)
{
  for (const JointModel* joint : jointsOf(group))
  {
    joint->enforceBounds(positions_.data() + joint->first_variable);
    follow(*joint);
  }
  dirty_ = true;
}

void RobotState::normalizeContinuous(const JointModelGroup* group)
{
  for (const JointModel* joint : jointsOf(group))
    if (joint->continuous)
    {
      double& value = positions_[joint->first_variable];
      if (std::abs(value) > M_PI)
        value = wrapAngle(value);
      follow(*joint);
    }
  dirty_ = true;
}

double RobotState::distance(const RobotState& other, const JointModelGroup* group) const
{
  double sum = 0;
  for (const JointModel* joint : jointsOf(group))
    sum += joint->distance_factor * joint->distance(this->joint(*joint), other.joint(*joint));
  return sum;
}

RobotState RobotState::interpolate(const RobotState& other, double t, const JointModelGroup* group) const
{
  RobotState out(*this);
  for (const JointModel* joint : jointsOf(group))
  {
    joint->interpolate(this->joint(*joint), other.joint(*joint), t, out.positions_.data() + joint->first_variable);
    out.follow(*joint);
  }
  out.dirty_ = true;
  return out;
}

// ---------------------------------------------------------------- poses

const std::vector<Transform>& RobotState::linkPoses() const
{
  if (!dirty_)
    return poses_;
  poses_.resize(model_->links.size());
  for (std::size_t i = 0; i < poses_.size(); ++i)
  {
    const LinkModel& link = model_->links[i];
    const JointModel& joint = model_->joints[link.parent_joint];
    if (link.parent_link < 0)
      poses_[i] = joint.transform(positions_.data() + joint.first_variable);
    else if (joint.type == JointType::Fixed)
      poses_[i] = poses_[link.parent_link] * joint.origin;
    else
      poses_[i] = poses_[link.parent_link] * joint.transform(positions_.data() + joint.first_variable);
  }
  dirty_ = false;
  return poses_;
}

void RobotState::placeLink(int link, const Transform& pose, bool whole)
{
  const Transform move = pose * linkPose(link).inverse();
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (whole || model_->isAncestor(link, static_cast<int>(i)))
      poses_[i] = move * poses_[i];
  poses_[link] = pose;
}

int RobotState::frameLink(const std::string& name, Transform& in_link) const
{
  in_link.setIdentity();
  if (const LinkModel* link = model_->findLink(name))
    return link->index;
  if (!attached_)
    return -1;
  auto body = attached_->find(name);
  if (body != attached_->end())
  {
    in_link = body->second->pose;
    return model_->findLink(body->second->link)->index;
  }
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos)
    return -1;
  // The body's own name may hold slashes: the longest that fits.
  for (std::size_t at = name.rfind('/'); at != std::string::npos && at > 0; at = name.rfind('/', at - 1))
  {
    body = attached_->find(name.substr(0, at));
    if (body == attached_->end())
      continue;
    const auto frame = body->second->subframes.find(name.substr(at + 1));
    if (frame == body->second->subframes.end())
      continue;
    in_link = body->second->pose * frame->second;
    return model_->findLink(body->second->link)->index;
  }
  return -1;
}

bool RobotState::framePose(const std::string& name, Transform& pose) const
{
  Transform in_link;
  const int link = frameLink(name, in_link);
  if (link < 0)
    return false;
  pose = linkPoses()[link] * in_link;
  return true;
}

Jacobian RobotState::jacobian(const JointModelGroup& group, int link, const Vector3& point) const
{
  Jacobian J = Jacobian::Zero(6, static_cast<int>(group.size()));
  const auto& poses = linkPoses();
  const Vector3 p = poses[link] * point;
  // A joint turns the link itself and through each joint that mimics it.
  auto add = [&](const JointModel& joint, double factor, int column) {
    if (!model_->isAncestor(joint.child_link, link))
      return;
    const Transform parent = joint.parent_link < 0 ? joint.origin : poses[joint.parent_link] * joint.origin;
    const double* v = this->joint(joint);
    const Eigen::Matrix3d& R = parent.linear();
    auto turn = [&](const Vector3& axis, const Vector3& at, int c) {
      J.block<3, 1>(0, c) += factor * axis.cross(p - at);
      J.block<3, 1>(3, c) += factor * axis;
    };
    switch (joint.type)
    {
      case JointType::Revolute:
        turn(R * joint.axis, parent.translation(), column);
        break;
      case JointType::Prismatic:
        J.block<3, 1>(0, column) += factor * (R * joint.axis);
        break;
      case JointType::Planar:
        J.block<3, 1>(0, column) += R.col(0);
        J.block<3, 1>(0, column + 1) += R.col(1);
        turn(R.col(2), parent * Vector3(v[0], v[1], 0), column + 2);
        break;
      case JointType::Floating:
        for (int k = 0; k < 3; ++k)
          J.block<3, 1>(0, column + k) += R.col(k);
        break;  // a quaternion has no Jacobian of its own here, as upstream
      default:
        break;
    }
  };
  int column = 0;
  for (int j : group.active_joints)
  {
    const JointModel& joint = model_->joints[j];
    add(joint, 1.0, column);
    for (int m : joint.mimicked_by)
      add(model_->joints[m], model_->joints[m].mimic_factor, column);
    column += joint.variable_count;
  }
  if (group.base_link >= 0)
  {
    const Eigen::Matrix3d to_base = poses[group.base_link].linear().transpose();
    J.topRows<3>() = to_base * J.topRows<3>();
    J.bottomRows<3>() = to_base * J.bottomRows<3>();
  }
  return J;
}

// ---------------------------------------------------------------- attached bodies

const AttachedBodies& RobotState::attached() const
{
  static const AttachedBodies none;
  return attached_ ? *attached_ : none;
}

void RobotState::attach(AttachedBodyPtr body)
{
  model_->link(body->link);
  if (body->id.empty())
    throw InvalidInput("an attached body needs an id");
  if (body->shapes.empty())
    throw InvalidInput("attached body '" + body->id + "' has no shapes");
  auto bodies = std::make_shared<AttachedBodies>(attached());
  (*bodies)[body->id] = std::move(body);
  attached_ = std::move(bodies);
}

AttachedBodyPtr RobotState::detach(const std::string& id)
{
  const auto found = attached().find(id);
  if (found == attached().end())
    return nullptr;
  const AttachedBodyPtr body = found->second;
  auto bodies = std::make_shared<AttachedBodies>(attached());
  bodies->erase(id);
  attached_ = bodies->empty() ? nullptr : std::shared_ptr<const AttachedBodies>(bodies);
  return body;
}

void RobotState::clearAttached(const std::string& link)
{
  auto bodies = std::make_shared<AttachedBodies>();
  if (!link.empty())
    for (const auto& [id, body] : attached())
      if (body->link != link)
        (*bodies)[id] = body;
  attached_ = bodies->empty() ? nullptr : std::shared_ptr<const AttachedBodies>(bodies);
}
}  // namespace motion
