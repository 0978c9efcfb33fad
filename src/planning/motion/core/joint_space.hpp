// The joint space of a group as OMPL sees it, in MoveIt's metric: the sum over joints of their distances.
#pragma once

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/StateValidityChecker.h>

#include <atomic>
#include <mutex>

#include "motion/constraints.hpp"

namespace motion
{
// Robot states to work on, one for each thread that needs one.
class StatePool
{
public:
  explicit StatePool(const RobotState& like) : like_(like) {}

  class Lease
  {
  public:
    explicit Lease(StatePool& pool) : pool_(pool), state_(pool.take()) {}
    ~Lease() { pool_.give(std::move(state_)); }
    RobotState& operator*() { return *state_; }

  private:
    StatePool& pool_;
    std::unique_ptr<RobotState> state_;
  };

private:
  std::unique_ptr<RobotState> take();
  void give(std::unique_ptr<RobotState> state);
  RobotState like_;
  std::mutex lock_;
  std::vector<std::unique_ptr<RobotState>> free_;
};

class JointSpace : public ompl::base::StateSpace
{
public:
  class StateType : public ompl::base::State
  {
  public:
    double* values;
  };

  JointSpace(const RobotModelPtr& model, const JointModelGroup& group, StatePool& pool);

  // ------------------------------------------------------------ before setup
  void limit(std::size_t index, double lower, double upper);  // narrows the bounds of a variable of the group
  void projectOnto(const ConstraintSet* constraints) { constraints_ = constraints; }
  std::vector<std::string> setProjection(const std::string& description);  // what of it is left out, in a line each

  const JointModelGroup& group() const { return group_; }
  std::size_t size() const { return lower_.size(); }
  StatePool& pool() const { return pool_; }
  bool projects() const { return constraints_ != nullptr; }
  bool project(double* values) const;
  static double* values(ompl::base::State* state) { return static_cast<StateType*>(state)->values; }
  static const double* values(const ompl::base::State* state) { return static_cast<const StateType*>(state)->values; }
  double distance(const double* a, const double* b) const;
  void sample(double* values, const std::function<double(double, double)>& uniform) const;
  void clip(double* values) const;

  // ------------------------------------------------------------ OMPL
  unsigned int getDimension() const override;
  double getMaximumExtent() const override;
  double getMeasure() const override;
  void enforceBounds(ompl::base::State* state) const override;
  bool satisfiesBounds(const ompl::base::State* state) const override;
  void copyState(ompl::base::State* to, const ompl::base::State* from) const override;
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override;
  bool equalStates(const ompl::base::State* a, const ompl::base::State* b) const override;
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;
  ompl::base::State* allocState() const override;
  void freeState(ompl::base::State* state) const override;
  double* getValueAddressAtIndex(ompl::base::State* state, unsigned int index) const override;
  unsigned int getSerializationLength() const override;
  void serialize(void* bytes, const ompl::base::State* state) const override;
  void deserialize(ompl::base::State* state, const void* bytes) const override;
  void registerProjections() override;

private:
  RobotModelPtr model_;
  const JointModelGroup& group_;
  StatePool& pool_;
  std::vector<const JointModel*> joints_;
  std::vector<int> first_;  // of each joint in the group array
  std::vector<double> lower_, upper_;
  std::vector<char> endless_;
  const ConstraintSet* constraints_ = nullptr;
  std::vector<int> projection_joints_;
  int projection_link_ = -1;
};

// Bounds, path constraints, collisions.
class JointSpaceValidity : public ompl::base::StateValidityChecker
{
public:
  JointSpaceValidity(const ompl::base::SpaceInformationPtr& si, const JointSpace& space, const CollisionFree& free,
                     const ConstraintSet* constraints)
    : StateValidityChecker(si)
    , space_(space)
    , free_(free)
    , constraints_(constraints)
  {
  }
  bool isValid(const ompl::base::State* state) const override;
  mutable std::atomic<std::size_t> checked{0};

private:
  const JointSpace& space_;
  const CollisionFree& free_;
  const ConstraintSet* constraints_;
};

// Motions that are looked at all along.
class CloseMotion : public ompl::base::MotionValidator
{
public:
  CloseMotion(const ompl::base::SpaceInformationPtr& si, const JointSpace& space,
              std::shared_ptr<const CollisionChecker> checker)
    : MotionValidator(si)
    , space_(space)
    , coarse_(si)
    , checker_(std::move(checker))
  {
  }
  bool checkMotion(const ompl::base::State* a, const ompl::base::State* b) const override;
  bool checkMotion(const ompl::base::State* a, const ompl::base::State* b,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

private:
  double gone(const ompl::base::State* a, const ompl::base::State* b) const;
  const JointSpace& space_;
  const ompl::base::DiscreteMotionValidator coarse_;  // most motions that touch something are soon refused by it
  std::shared_ptr<const CollisionChecker> checker_;
};

// Motions along projected states: they must not jump from one sheet of the constraint to another.
class ProjectedMotion : public ompl::base::MotionValidator
{
public:
  explicit ProjectedMotion(const ompl::base::SpaceInformationPtr& si) : MotionValidator(si) {}
  bool checkMotion(const ompl::base::State* a, const ompl::base::State* b) const override;
  bool checkMotion(const ompl::base::State* a, const ompl::base::State* b,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

private:
  bool walk(const ompl::base::State* a, const ompl::base::State* b, double& reached, ompl::base::State* last) const;
};

// What the caller asks of states, too.
class FeasibleValidity : public JointSpaceValidity
{
public:
  FeasibleValidity(const ompl::base::SpaceInformationPtr& si, const JointSpace& space, const CollisionFree& free,
                   const ConstraintSet* constraints, const std::function<bool(const RobotState&)>& feasible)
    : JointSpaceValidity(si, space, free, constraints)
    , joints_(space)
    , feasible_(feasible)
  {
  }
  bool isValid(const ompl::base::State* state) const override
  {
    if (!JointSpaceValidity::isValid(state))
      return false;
    StatePool::Lease lease(joints_.pool());
    (*lease).setGroup(joints_.group(), JointSpace::values(state));
    return feasible_(*lease);
  }

private:
  const JointSpace& joints_;
  const std::function<bool(const RobotState&)>& feasible_;
};
}  // namespace motion
