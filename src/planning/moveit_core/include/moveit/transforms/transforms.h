// Poses of frames in one target frame.
#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <Eigen/Geometry>
#include <boost/noncopyable.hpp>
#include <map>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>

namespace moveit
{
namespace core
{
MOVEIT_CLASS_FORWARD(Transforms);

using FixedTransformsMap = std::map<std::string, Eigen::Isometry3d, std::less<std::string>,
                                    Eigen::aligned_allocator<std::pair<const std::string, Eigen::Isometry3d>>>;

class Transforms : private boost::noncopyable
{
public:
  explicit Transforms(const std::string& target_frame);
  virtual ~Transforms();

  // The same but for a leading slash?
  static bool sameFrame(const std::string& frame1, const std::string& frame2);

  const std::string& getTargetFrame() const { return target_frame_; }
  const FixedTransformsMap& getAllTransforms() const { return transforms_map_; }
  void copyTransforms(std::vector<geometry_msgs::TransformStamped>& transforms) const;

  // t: pose of `from_frame` in the target frame.
  void setTransform(const Eigen::Isometry3d& t, const std::string& from_frame);
  void setTransform(const geometry_msgs::TransformStamped& transform);
  void setTransforms(const std::vector<geometry_msgs::TransformStamped>& transforms);
  void setAllTransforms(const FixedTransformsMap& transforms);

  // Not inline: Eigen's products in a header cost every file that includes it seconds.
  void transformVector3(const std::string& from_frame, const Eigen::Vector3d& v_in, Eigen::Vector3d& v_out) const;
  void transformQuaternion(const std::string& from_frame, const Eigen::Quaterniond& q_in, Eigen::Quaterniond& q_out) const;
  void transformRotationMatrix(const std::string& from_frame, const Eigen::Matrix3d& m_in, Eigen::Matrix3d& m_out) const;
  void transformPose(const std::string& from_frame, const Eigen::Isometry3d& t_in, Eigen::Isometry3d& t_out) const;

  virtual bool canTransform(const std::string& from_frame) const;
  virtual bool isFixedFrame(const std::string& frame) const;
  // The identity, and a line in the log, when the frame is not known.
  virtual const Eigen::Isometry3d& getTransform(const std::string& from_frame) const;

protected:
  std::string target_frame_;
  FixedTransformsMap transforms_map_;
};
}  // namespace core
}  // namespace moveit
