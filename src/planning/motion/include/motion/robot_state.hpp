// Where a robot is: a value for each variable, what it carries, and from these the pose of each link.
#pragma once

#include <any>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "motion/robot_model.hpp"

namespace motion
{
using Random = std::mt19937_64;
using Subframes = std::map<std::string, Transform>;

struct AttachedBody
{
  std::string id, link;
  Transform pose = Transform::Identity();  // of the object in the link
  std::vector<ShapePtr> shapes;
  std::vector<Transform> shape_poses;  // in the object
  Subframes subframes;                 // in the object
  std::set<std::string> touch_links;
  double weight = 0;
  std::string type;
  std::any posture;  // whatever the owner wants kept
};
using AttachedBodyPtr = std::shared_ptr<const AttachedBody>;
using AttachedBodies = std::map<std::string, AttachedBodyPtr>;

class RobotState
{
public:
  explicit RobotState(RobotModelPtr model);

  const RobotModelPtr& model() const { return model_; }

  // ------------------------------------------------------------ variables
  const std::vector<double>& positions() const { return positions_; }
  void setPositions(const double* values);
  // For those who write values themselves, mimic joints too. Poses are computed anew after this call.
  double* writePositions()
  {
    dirty_ = true;
    return positions_.data();
  }
  std::vector<double> velocities, efforts, accelerations;  // empty or one per variable
  void setVariable(int variable, double value);            // joints that mimic it follow
  void setGroup(const JointModelGroup& group, const double* values);
  void getGroup(const JointModelGroup& group, double* values) const;
  void setJoint(const JointModel& joint, const double* values);
  const double* joint(const JointModel& joint) const { return positions_.data() + joint.first_variable; }
  void setDefault();
  bool setNamed(const JointModelGroup& group, const std::string& state);
  void randomize(const JointModelGroup* group, Random& random);
  void randomizeNear(const JointModelGroup& group, const RobotState& near, double distance, Random& random);

  bool satisfiesBounds(const JointModelGroup* group, double margin) const;
  void enforceBounds(const JointModelGroup* group);
  void normalizeContinuous(const JointModelGroup* group);
  double distance(const RobotState& other, const JointModelGroup* group) const;
  RobotState interpolate(const RobotState& other, double t, const JointModelGroup* group) const;

  // ------------------------------------------------------------ poses (in the model frame)
  // The first call after a change computes all of them: a state is not to be read first by two threads at once.
  const std::vector<Transform>& linkPoses() const;
  const Transform& linkPose(int link) const { return linkPoses()[link]; }
  // A link goes to a pose, with all that it carries or (`whole`) with the whole robot; until values change again.
  void placeLink(int link, const Transform& pose, bool whole);
  // A link, an attached body or `body/subframe`; false if there is no such frame.
  bool framePose(const std::string& name, Transform& pose) const;
  // The link that moves the frame, and the frame's pose in it; -1 if there is no such frame.
  int frameLink(const std::string& name, Transform& in_link) const;
  // Rows v, w at `point` of `link`, in the frame of the group's base link; one column per group variable.
  Jacobian jacobian(const JointModelGroup& group, int link, const Vector3& point) const;

  // ------------------------------------------------------------ what it carries
  const AttachedBodies& attached() const;
  const std::shared_ptr<const AttachedBodies>& attachedShared() const { return attached_; }
  void attach(AttachedBodyPtr body);
  AttachedBodyPtr detach(const std::string& id);  // null if there is none
  void clearAttached(const std::string& link = "");

private:
  void follow(const JointModel& joint);
  const std::vector<const JointModel*> jointsOf(const JointModelGroup* group) const;

  RobotModelPtr model_;
  std::vector<double> positions_;
  mutable std::vector<Transform> poses_;
  mutable bool dirty_ = true;
  std::shared_ptr<const AttachedBodies> attached_;  // null: nothing
};

// A number within the bounds of a single variable; unbounded: in (-pi, pi] for angles, [-1, 1] for lengths.
double randomValue(const JointModel& joint, int which, Random& random);
void randomJoint(const JointModel& joint, double* values, Random& random);
}  // namespace motion
