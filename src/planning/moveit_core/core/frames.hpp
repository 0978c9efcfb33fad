#pragma once
#include <Eigen/Geometry>
#include <string>

namespace frames
{
inline const Eigen::Isometry3d IDENTITY = Eigen::Isometry3d::Identity();

/// tf's names of frames may begin with a slash, tf2's do not.
inline std::string withoutSlash(const std::string& frame)
{
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}
}  // namespace frames
