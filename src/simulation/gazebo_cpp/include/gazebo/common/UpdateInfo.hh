#pragma once
#include <string>

#include <gazebo/common/Time.hh>

namespace gazebo
{
namespace common
{

/// What the events of a step tell.
class UpdateInfo
{
public:
  std::string worldName;
  Time simTime;
  Time realTime;
};

}  // namespace common
}  // namespace gazebo
