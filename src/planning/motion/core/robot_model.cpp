#include "motion/robot_model.hpp"

#include <algorithm>

#include "model_builder.hpp"

namespace motion
{
const char* JointModel::typeName() const
{
  static const char* names[] = {"fixed", "revolute", "prismatic", "planar", "floating"};
  return continuous ? "continuous" : names[static_cast<int>(type)];
}

Transform JointModel::transform(const double* v) const
{
  switch (type)
  {
    case JointType::Fixed:
      return origin;
    case JointType::Revolute: {
      // Rodrigues' formula, written out: forward kinematics spends most of its time here.
      const double c = std::cos(v[0]), s = std::sin(v[0]), t = 1.0 - c;
      const double x = axis.x(), y = axis.y(), z = axis.z();
      Eigen::Matrix3d R;
      R << t * x * x + c, t * x * y - s * z, t * x * z + s * y,  //
          t * x * y + s * z, t * y * y + c, t * y * z - s * x,   //
          t * x * z - s * y, t * y * z + s * x, t * z * z + c;
      Transform out;
      out.linear().noalias() = origin.linear() * R;
      out.translation() = origin.translation();
      out.makeAffine();
      return out;
    }
    case JointType::Prismatic: {
      Transform out = origin;
      out.translation() += origin.linear() * (axis * v[0]);
      return out;
    }
    case JointType::Planar: {
      Transform out = origin;
      out.translate(Vector3(v[0], v[1], 0.0));
      out.rotate(Eigen::AngleAxisd(v[2], Vector3::UnitZ()));
      return out;
    }
    case JointType::Floating: {
      Transform out = origin;
      out.translate(Vector3(v[0], v[1], v[2]));
      out.rotate(Quaternion(v[6], v[3], v[4], v[5]).normalized());
      return out;
    }
  }
  return origin;
}

void JointModel::valuesOf(const Transform& moved, double* v) const
{
  const Quaternion q(moved.linear());
  switch (type)
  {
    case JointType::Revolute:
      v[0] = wrapAngle(2.0 * std::atan2(q.vec().dot(axis), q.w()));
      break;
    case JointType::Prismatic:
      v[0] = moved.translation().dot(axis);
      break;
    case JointType::Planar:
      v[0] = moved.translation().x(), v[1] = moved.translation().y();
      v[2] = std::atan2(moved.linear()(1, 0), moved.linear()(0, 0));
      break;
    case JointType::Floating:
      for (int k = 0; k < 3; ++k)
        v[k] = moved.translation()[k];
      v[3] = q.x(), v[4] = q.y(), v[5] = q.z(), v[6] = q.w();
      break;
    default:
      break;
  }
}

namespace
{
double quaternionAngle(const double* a, const double* b)
{
  const double dot = std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]);
  return dot >= 1.0 ? 0.0 : std::acos(dot);
}
}  // namespace

double JointModel::distance(const double* a, const double* b) const
{
  switch (type)
  {
    case JointType::Revolute:
      return continuous ? std::abs(wrapAngle(a[0] - b[0])) : std::abs(a[0] - b[0]);
    case JointType::Prismatic:
      return std::abs(a[0] - b[0]);
    case JointType::Planar:
      return std::hypot(a[0] - b[0], a[1] - b[1]) + angular_distance_weight * std::abs(wrapAngle(a[2] - b[2]));
    case JointType::Floating:
      return Vector3(a[0] - b[0], a[1] - b[1], a[2] - b[2]).norm() + angular_distance_weight * quaternionAngle(a + 3, b + 3);
    default:
      return 0;
  }
}

double JointModel::maximumExtent() const
{
  auto range = [this](int k) { return bounds[k].has_position ? bounds[k].max_position - bounds[k].min_position : 2.0 * M_PI; };
  switch (type)
  {
    case JointType::Revolute:
      return continuous ? M_PI : range(0);
    case JointType::Prismatic:
      return range(0);
    case JointType::Planar:
      return std::hypot(range(0), range(1)) + angular_distance_weight * M_PI;
    case JointType::Floating:
      return Vector3(range(0), range(1), range(2)).norm() + angular_distance_weight * M_PI * 0.5;
    default:
      return 0;
  }
}

void JointModel::interpolate(const double* from, const double* to, double t, double* out) const
{
  switch (type)
  {
    case JointType::Revolute:
      out[0] = continuous ? wrapAngle(from[0] + t * wrapAngle(to[0] - from[0])) : from[0] + t * (to[0] - from[0]);
      break;
    case JointType::Prismatic:
      out[0] = from[0] + t * (to[0] - from[0]);
      break;
    case JointType::Planar:
      out[0] = from[0] + t * (to[0] - from[0]);
      out[1] = from[1] + t * (to[1] - from[1]);
      out[2] = wrapAngle(from[2] + t * wrapAngle(to[2] - from[2]));
      break;
    case JointType::Floating: {
      for (int k = 0; k < 3; ++k)
        out[k] = from[k] + t * (to[k] - from[k]);
      const Quaternion a(from[6], from[3], from[4], from[5]), b(to[6], to[3], to[4], to[5]);
      const Quaternion q = a.slerp(t, b).normalized();
      out[3] = q.x(), out[4] = q.y(), out[5] = q.z(), out[6] = q.w();
      break;
    }
    default:
      break;
  }
}

bool JointModel::satisfiesBounds(const double* values, double margin) const
{
  if (type == JointType::Floating)
  {
    const double norm = Eigen::Map<const Eigen::Vector4d>(values + 3).squaredNorm();
    if (!(std::abs(norm - 1.0) < 1e-3))
      return false;
  }
  for (int k = 0; k < variable_count; ++k)
  {
    if (!std::isfinite(values[k]))
      return false;
    if (continuous)
      continue;  // any turn will do
    if (type == JointType::Planar && k == 2)
    {
      // As upstream has it, the heading is kept within one turn.
      if (std::abs(values[k]) > M_PI + 1e-9 + margin)
        return false;
    }
    else if (bounds[k].has_position &&
             (values[k] < bounds[k].min_position - margin || values[k] > bounds[k].max_position + margin))
      return false;
  }
  return true;
}

bool JointModel::enforceBounds(double* values) const
{
  bool changed = false;
  if (type == JointType::Floating)
  {
    Eigen::Map<Eigen::Vector4d> q(values + 3);
    const double norm = q.norm();
    if (norm < 1e-9 || !std::isfinite(norm))
      q = Eigen::Vector4d(0, 0, 0, 1);
    else
      q /= norm;
    changed = std::abs(norm - 1) > 1e-9;
  }
  for (int k = 0; k < variable_count; ++k)
  {
    double value = values[k];
    if (continuous || (type == JointType::Planar && k == 2))
      value = std::abs(value) > M_PI ? wrapAngle(value) : value;
    else if (bounds[k].has_position && !(type == JointType::Floating && k >= 3))
      value = std::min(std::max(value, bounds[k].min_position), bounds[k].max_position);
    changed = changed || value != values[k];
    values[k] = value;
  }
  return changed;
}

bool JointModelGroup::hasJoint(int joint) const { return std::binary_search(joints.begin(), joints.end(), joint); }

// ---------------------------------------------------------------- RobotModel

RobotModelPtr RobotModel::load(const std::string& urdf, const std::string& srdf, const Options& options)
{
  auto model = std::make_shared<RobotModel>();
  const auto parsed = parseUrdf(urdf, model->warnings);
  if (!srdf.empty())
    model->srdf = Srdf::parse(srdf, model->warnings);
  ModelBuilder(parsed, options, *model).build();
  return model;
}

std::shared_ptr<RobotModel> RobotModel::load(const std::shared_ptr<urdf::ModelInterface>& urdf, const Srdf& srdf,
                                             const Options& options)
{
  if (!urdf || !urdf->getRoot())
    throw ModelError("the URDF '" + (urdf ? urdf->getName() : "") + "' has no root link");
  auto model = std::make_shared<RobotModel>();
  model->srdf = srdf;
  ModelBuilder(urdf, options, *model).build();
  return model;
}

void RobotModel::setBounds(int joint, const std::vector<VariableBounds>& limits)
{
  JointModel& changed = joints[joint];
  if (limits.size() != changed.bounds.size())
    throw InvalidInput("joint '" + changed.name + "': " + std::to_string(limits.size()) + " limits for " +
                       std::to_string(changed.bounds.size()) + " variables");
  changed.bounds = limits;
  std::copy(limits.begin(), limits.end(), bounds.begin() + changed.first_variable);
}

void RobotModel::setSolver(const std::string& group, std::shared_ptr<const GroupSolver> solver)
{
  this->group(group);
  solvers_[group] = std::move(solver);
}

const GroupSolver* RobotModel::solver(const std::string& group) const
{
  const auto found = solvers_.find(group);
  return found == solvers_.end() ? nullptr : found->second.get();
}

namespace
{
template <typename Items>
auto* find(Items& items, const std::unordered_map<std::string, int>& index, const std::string& name)
{
  const auto found = index.find(name);
  return found == index.end() ? nullptr : &items[found->second];
}

template <typename Items>
std::vector<std::string> names(const Items& items)
{
  std::vector<std::string> out;
  for (const auto& item : items)
    out.push_back(item.name);
  return out;
}
}  // namespace

const JointModel* RobotModel::findJoint(const std::string& name) const { return find(joints, joint_index_, name); }

const LinkModel* RobotModel::findLink(const std::string& name) const { return find(links, link_index_, name); }

const JointModelGroup* RobotModel::findGroup(const std::string& name) const { return find(groups, group_index_, name); }

int RobotModel::findVariable(const std::string& name) const
{
  const auto found = variable_index_.find(name);
  return found == variable_index_.end() ? -1 : found->second;
}

const JointModel& RobotModel::joint(const std::string& name) const
{
  if (const JointModel* found = findJoint(name))
    return *found;
  throwUnknown("joint", name, "robot '" + this->name + "'", jointNames());
}

const LinkModel& RobotModel::link(const std::string& name) const
{
  if (const LinkModel* found = findLink(name))
    return *found;
  throwUnknown("link", name, "robot '" + this->name + "'", linkNames());
}

const JointModelGroup& RobotModel::group(const std::string& name) const
{
  if (const JointModelGroup* found = findGroup(name))
    return *found;
  throwUnknown("group", name, "robot '" + this->name + "'", groupNames());
}

int RobotModel::variable(const std::string& name) const
{
  const int found = findVariable(name);
  if (found < 0)
    throwUnknown("variable", name, "robot '" + this->name + "'", variables);
  return found;
}

int RobotModel::rigidParent(int link, Transform& pose) const
{
  pose.setIdentity();
  while (links[link].parent_link >= 0 && joints[links[link].parent_joint].type == JointType::Fixed)
  {
    pose = joints[links[link].parent_joint].origin * pose;
    link = links[link].parent_link;
  }
  return link;
}

bool RobotModel::isAncestor(int ancestor, int link) const
{
  while (link > ancestor)  // depth first: parents have smaller indices
    link = links[link].parent_link;
  return link == ancestor;
}

std::vector<std::string> RobotModel::jointNames() const { return names(joints); }

std::vector<std::string> RobotModel::linkNames() const { return names(links); }

std::vector<std::string> RobotModel::groupNames() const { return names(groups); }
}  // namespace motion
