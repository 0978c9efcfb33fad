#include <octomap_ros/conversions.h>

#include <cmath>

#include <sensor_msgs/point_cloud2_iterator.h>

namespace octomap
{

void pointsOctomapToPointCloud2(const point3d_list& points, sensor_msgs::PointCloud2& cloud)
{
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(3, "x", 1, sensor_msgs::PointField::FLOAT32, "y", 1, sensor_msgs::PointField::FLOAT32, "z", 1,
                                sensor_msgs::PointField::FLOAT32);
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> at(cloud, "x");
  for (const point3d& p : points)
  {
    at[0] = p.x(), at[1] = p.y(), at[2] = p.z();
    ++at;
  }
}

void pointCloud2ToOctomap(const sensor_msgs::PointCloud2& cloud, Pointcloud& points)
{
  points.reserve(points.size() + static_cast<size_t>(cloud.width) * cloud.height);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  for (; x != x.end(); ++x, ++y, ++z)
    if (std::isfinite(*x) && std::isfinite(*y) && std::isfinite(*z))
      points.push_back(*x, *y, *z);
}

}  // namespace octomap
