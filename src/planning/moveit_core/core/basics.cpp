// The small parts: exceptions, numbers as text, message checks, error codes, parameters, transforms.
#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>

#include <locale>
#include <ostream>
#include <sstream>

#include <moveit/exceptions/exceptions.h>
#include <moveit/transforms/transforms.h>
#include <moveit/utils/lexical_casts.h>
#include <moveit/utils/message_checks.h>
#include <moveit/utils/moveit_error_code.h>
#include <moveit/utils/xmlrpc_casts.h>

#include "frames.hpp"

namespace moveit
{
ConstructException::ConstructException(const std::string& what_arg) : std::runtime_error(what_arg)
{
  ROS_ERROR_NAMED("exceptions", "Error during construction of object: %s\nException thrown.", what_arg.c_str());
}

Exception::Exception(const std::string& what_arg) : std::runtime_error(what_arg)
{
  ROS_ERROR_NAMED("exceptions", "%s\nException thrown.", what_arg.c_str());
}

namespace core
{
// ---------------------------------------------------------------- numbers

namespace
{
template <typename Number>
std::string textOf(Number number)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << number;
  return out.str();
}

template <typename Number>
Number numberOf(const std::string& text)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  Number number;
  in >> number;
  if (in.fail() || !in.eof())
    throw std::runtime_error("Failed converting string to real number");
  return number;
}
}  // namespace

std::string toString(double d) { return textOf(d); }

std::string toString(float f) { return textOf(f); }

double toDouble(const std::string& s) { return numberOf<double>(s); }

float toFloat(const std::string& s) { return numberOf<float>(s); }

double parseDouble(const XmlRpc::XmlRpcValue& v)
{
  XmlRpc::XmlRpcValue value = v;
  return v.getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int>(value) : static_cast<double>(value);
}

bool isArray(const XmlRpc::XmlRpcValue& v, size_t size, const std::string& name, const std::string& description)
{
  if (v.getType() == XmlRpc::XmlRpcValue::TypeArray && (size == 0 || static_cast<size_t>(v.size()) == size))
    return true;
  if (!name.empty())
    ROS_WARN_STREAM(name << " is not an array" << (size ? " of size " + std::to_string(size) : "")
                         << (description.empty() ? "" : " (" + description + ")"));
  return false;
}

bool isStruct(const XmlRpc::XmlRpcValue& v, const std::vector<std::string>& keys, const std::string& name)
{
  bool good = v.getType() == XmlRpc::XmlRpcValue::TypeStruct;
  std::string wanted;
  for (const std::string& key : keys)
  {
    good = good && v.hasMember(key);
    wanted += (wanted.empty() ? "" : ", ") + key;
  }
  if (!good && !name.empty())
    ROS_WARN_STREAM(name << " is not a struct with keys " << wanted);
  return good;
}

// ---------------------------------------------------------------- messages

bool isEmpty(const moveit_msgs::PlanningScene& msg)
{
  return moveit::core::isEmpty(msg.world) && moveit::core::isEmpty(msg.robot_state) && msg.is_diff && msg.name.empty() &&
         msg.fixed_frame_transforms.empty() && msg.allowed_collision_matrix.entry_names.empty() && msg.link_padding.empty() &&
         msg.link_scale.empty() && msg.object_colors.empty();
}

bool isEmpty(const moveit_msgs::PlanningSceneWorld& msg)
{
  return msg.collision_objects.empty() && msg.octomap.octomap.data.empty();
}

bool isEmpty(const moveit_msgs::RobotState& msg)
{
  // A state that takes bodies away is a difference with nothing in it but that.
  return msg.is_diff && msg.multi_dof_joint_state.joint_names.empty() && msg.joint_state.name.empty() &&
         msg.attached_collision_objects.empty() && msg.joint_state.position.empty() && msg.joint_state.velocity.empty() &&
         msg.joint_state.effort.empty() && msg.multi_dof_joint_state.transforms.empty() &&
         msg.multi_dof_joint_state.twist.empty() && msg.multi_dof_joint_state.wrench.empty();
}

bool isEmpty(const moveit_msgs::Constraints& msg)
{
  return msg.position_constraints.empty() && msg.orientation_constraints.empty() && msg.visibility_constraints.empty() &&
         msg.joint_constraints.empty();
}

bool isEmpty(const geometry_msgs::Quaternion& msg) { return msg.x == 0.0 && msg.y == 0.0 && msg.z == 0.0 && msg.w == 0.0; }

bool isEmpty(const geometry_msgs::Pose& msg)
{
  return msg.position.x == 0.0 && msg.position.y == 0.0 && msg.position.z == 0.0 && isEmpty(msg.orientation);
}

// ---------------------------------------------------------------- error codes

const char* MoveItErrorCode::toString(const moveit_msgs::MoveItErrorCodes& error_code)
{
#define MOVEIT_CODE(name)                   \
  case moveit_msgs::MoveItErrorCodes::name: \
    return #name;
  switch (error_code.val)
  {
    MOVEIT_CODE(SUCCESS)
    MOVEIT_CODE(FAILURE)
    MOVEIT_CODE(PLANNING_FAILED)
    MOVEIT_CODE(INVALID_MOTION_PLAN)
    MOVEIT_CODE(MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE)
    MOVEIT_CODE(CONTROL_FAILED)
    MOVEIT_CODE(UNABLE_TO_AQUIRE_SENSOR_DATA)
    MOVEIT_CODE(TIMED_OUT)
    MOVEIT_CODE(PREEMPTED)
    MOVEIT_CODE(START_STATE_IN_COLLISION)
    MOVEIT_CODE(START_STATE_VIOLATES_PATH_CONSTRAINTS)
    MOVEIT_CODE(GOAL_IN_COLLISION)
    MOVEIT_CODE(GOAL_VIOLATES_PATH_CONSTRAINTS)
    MOVEIT_CODE(GOAL_CONSTRAINTS_VIOLATED)
    MOVEIT_CODE(INVALID_GROUP_NAME)
    MOVEIT_CODE(INVALID_GOAL_CONSTRAINTS)
    MOVEIT_CODE(INVALID_ROBOT_STATE)
    MOVEIT_CODE(INVALID_LINK_NAME)
    MOVEIT_CODE(INVALID_OBJECT_NAME)
    MOVEIT_CODE(FRAME_TRANSFORM_FAILURE)
    MOVEIT_CODE(COLLISION_CHECKING_UNAVAILABLE)
    MOVEIT_CODE(ROBOT_STATE_STALE)
    MOVEIT_CODE(SENSOR_INFO_STALE)
    MOVEIT_CODE(COMMUNICATION_FAILURE)
    MOVEIT_CODE(NO_IK_SOLUTION)
  }
#undef MOVEIT_CODE
  return "Unrecognized MoveItErrorCode. This should never happen!";
}

std::ostream& operator<<(std::ostream& out, const MoveItErrorCode& e) { return out << MoveItErrorCode::toString(e); }

// ---------------------------------------------------------------- transforms

Transforms::Transforms(const std::string& target_frame) : target_frame_(frames::withoutSlash(target_frame))
{
  if (target_frame_.empty())
    ROS_ERROR_NAMED("transforms", "The target frame for MoveIt transforms cannot be empty.");
  else
    transforms_map_[target_frame_] = frames::IDENTITY;
}

Transforms::~Transforms() = default;

bool Transforms::sameFrame(const std::string& frame1, const std::string& frame2)
{
  return !frame1.empty() && !frame2.empty() && frames::withoutSlash(frame1) == frames::withoutSlash(frame2);
}

void Transforms::copyTransforms(std::vector<geometry_msgs::TransformStamped>& transforms) const
{
  transforms.clear();
  for (const auto& item : transforms_map_)
  {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(item.second);
    // As upstream: the wrong way round for TF, the header names the frame.
    transform.child_frame_id = target_frame_;
    transform.header.frame_id = item.first;
    transforms.push_back(transform);
  }
}

void Transforms::setTransform(const Eigen::Isometry3d& t, const std::string& from_frame)
{
  if (from_frame.empty())
    ROS_ERROR_NAMED("transforms", "Cannot record transform with empty name");
  else
    transforms_map_[frames::withoutSlash(from_frame)] = t;
}

void Transforms::setTransform(const geometry_msgs::TransformStamped& transform)
{
  if (!sameFrame(transform.child_frame_id, target_frame_))
    ROS_ERROR_NAMED("transforms", "Given transform is to frame '%s', but frame '%s' was expected.",
                    transform.child_frame_id.c_str(), target_frame_.c_str());
  else
    setTransform(tf2::transformToEigen(transform.transform), transform.header.frame_id);
}

void Transforms::setTransforms(const std::vector<geometry_msgs::TransformStamped>& transforms)
{
  for (const auto& transform : transforms)
    setTransform(transform);
}

void Transforms::setAllTransforms(const FixedTransformsMap& transforms) { transforms_map_ = transforms; }

bool Transforms::isFixedFrame(const std::string& frame) const
{
  return !frame.empty() && transforms_map_.count(frames::withoutSlash(frame));
}

bool Transforms::canTransform(const std::string& from_frame) const { return isFixedFrame(from_frame); }

void Transforms::transformVector3(const std::string& from_frame, const Eigen::Vector3d& v_in, Eigen::Vector3d& v_out) const
{
  v_out = getTransform(from_frame).linear() * v_in;
}

void Transforms::transformQuaternion(const std::string& from_frame, const Eigen::Quaterniond& q_in,
                                     Eigen::Quaterniond& q_out) const
{
  q_out = getTransform(from_frame).linear() * q_in;
}

void Transforms::transformRotationMatrix(const std::string& from_frame, const Eigen::Matrix3d& m_in,
                                         Eigen::Matrix3d& m_out) const
{
  m_out = getTransform(from_frame).linear() * m_in;
}

void Transforms::transformPose(const std::string& from_frame, const Eigen::Isometry3d& t_in, Eigen::Isometry3d& t_out) const
{
  t_out = getTransform(from_frame) * t_in;
}

const Eigen::Isometry3d& Transforms::getTransform(const std::string& from_frame) const
{
  const auto found = transforms_map_.find(frames::withoutSlash(from_frame));
  if (found != transforms_map_.end())
    return found->second;
  ROS_ERROR_NAMED("transforms", "Unable to transform from frame '%s' to frame '%s'. Returning identity.", from_frame.c_str(),
                  target_frame_.c_str());
  return frames::IDENTITY;
}
}  // namespace core
}  // namespace moveit
