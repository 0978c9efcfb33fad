// Between octomap's types and those of messages and tf. Lengths in metres, frames as the caller has them.
#ifndef OCTOMAP_ROS_CONVERT_MSGS_H
#define OCTOMAP_ROS_CONVERT_MSGS_H

#include <geometry_msgs/Point.h>
#include <octomap/octomap.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf/transform_datatypes.h>

namespace octomap
{

/// A cloud of x, y, z (float32) in one row; the header stays as it is.
void pointsOctomapToPointCloud2(const point3d_list& points, sensor_msgs::PointCloud2& cloud);

/// All points of the cloud whose x, y and z are numbers, behind those that are in `points`. A cloud without such fields throws
/// std::runtime_error.
void pointCloud2ToOctomap(const sensor_msgs::PointCloud2& cloud, Pointcloud& points);

inline geometry_msgs::Point pointOctomapToMsg(const point3d& p)
{
  geometry_msgs::Point out;
  out.x = p.x(), out.y = p.y(), out.z = p.z();
  return out;
}
inline point3d pointMsgToOctomap(const geometry_msgs::Point& p)
{
  return { static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z) };
}

inline tf::Point pointOctomapToTf(const point3d& p) { return { p.x(), p.y(), p.z() }; }
inline point3d pointTfToOctomap(const tf::Point& p)
{
  return { static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()) };
}

// octomap has the real part first, and calls it u.
inline tf::Quaternion quaternionOctomapToTf(const octomath::Quaternion& q) { return { q.x(), q.y(), q.z(), q.u() }; }
inline octomath::Quaternion quaternionTfToOctomap(const tf::Quaternion& q)
{
  return { static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()) };
}

inline tf::Pose poseOctomapToTf(const pose6d& X)
{
  return tf::Pose(quaternionOctomapToTf(X.rot()), pointOctomapToTf(X.trans()));
}
inline pose6d poseTfToOctomap(const tf::Pose& X)
{
  return pose6d(pointTfToOctomap(X.getOrigin()), quaternionTfToOctomap(X.getRotation()));
}

}  // namespace octomap

#endif
