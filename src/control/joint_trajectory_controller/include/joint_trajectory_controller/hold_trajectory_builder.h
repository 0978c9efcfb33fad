// Rest where the joints are.
#pragma once

#include <cmath>
#include <vector>

#include <joint_trajectory_controller/trajectory_builder.h>

namespace joint_trajectory_controller
{

template <class SegmentImpl, class HardwareInterface>
class HoldTrajectoryBuilder : public TrajectoryBuilder<SegmentImpl>
{
private:
  typedef JointTrajectorySegment<SegmentImpl> Segment;
  typedef std::vector<std::vector<Segment>> Trajectory;
  typedef typename HardwareInterface::ResourceHandleType JointHandle;

public:
  /// \param joints outlive the builder
  HoldTrajectoryBuilder(const std::vector<JointHandle>& joints) : joints_(joints) {}

  /// \return false, as well, if the hardware does not say where a joint is
  bool buildTrajectory(Trajectory* hold_traj) override
  {
    if (!this->getStartTime() || !this->isTrajectoryValid(hold_traj, joints_.size(), 1))
      return false;
    for (const JointHandle& joint : joints_)
      if (!std::isfinite(joint.getPosition()))
        return false;
    const typename Segment::Time start = *this->getStartTime();
    for (std::size_t i = 0; i < joints_.size(); ++i)
    {
      rest_.position[0] = joints_[i].getPosition();
      Segment& segment = (*hold_traj)[i].front();
      segment.init(start, rest_, start, rest_);
      segment.setGoalHandle(this->createGoalHandlePtr());
    }
    return true;
  }

private:
  const std::vector<JointHandle>& joints_;
  typename Segment::State rest_{ 1u };  // made here, as the control loop must not allocate
};

}  // namespace joint_trajectory_controller
