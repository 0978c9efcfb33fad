// What a collision check is asked and what it answers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/array.hpp>
#include <boost/function.hpp>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/robot_model/robot_model.h>

namespace collision_detection
{
MOVEIT_CLASS_FORWARD(AllowedCollisionMatrix);

namespace BodyTypes
{
enum Type
{
  ROBOT_LINK,
  ROBOT_ATTACHED,
  WORLD_OBJECT
};
}
using BodyType = BodyTypes::Type;

struct Contact
{
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  Eigen::Vector3d pos;     // in the model frame
  Eigen::Vector3d normal;  // from body 1 to body 2
  double depth = 0.0;      // m
  std::string body_name_1;
  BodyType body_type_1 = BodyTypes::ROBOT_LINK;
  std::string body_name_2;
  BodyType body_type_2 = BodyTypes::ROBOT_LINK;
  double percent_interpolation = 0.0;
  Eigen::Vector3d nearest_points[2];
};

// Room that two colliding shapes share: a box in the planning frame, m.
struct CostSource
{
  boost::array<double, 3> aabb_min, aabb_max;
  double cost;
  double getVolume() const { return (aabb_max[0] - aabb_min[0]) * (aabb_max[1] - aabb_min[1]) * (aabb_max[2] - aabb_min[2]); }
  bool operator<(const CostSource& other) const { return cost * getVolume() > other.cost * other.getVolume(); }
};

struct CollisionResult;

struct CollisionRequest
{
  virtual ~CollisionRequest() {}
  std::string group_name;  // "": the whole robot
  bool distance = false, detailed_distance = false, cost = false, contacts = false;
  std::size_t max_contacts = 1, max_contacts_per_pair = 1, max_cost_sources = 1;
  boost::function<bool(const CollisionResult&)> is_done;
  bool verbose = false;
};

namespace DistanceRequestTypes
{
enum DistanceRequestType
{
  GLOBAL,
  SINGLE,
  LIMITED,
  ALL
};
}
using DistanceRequestType = DistanceRequestTypes::DistanceRequestType;

struct DistanceRequest
{
  void enableGroup(const moveit::core::RobotModelConstPtr& robot_model)
  {
    active_components_only = robot_model->hasJointModelGroup(group_name)
                                 ? &robot_model->getJointModelGroup(group_name)->getUpdatedLinkModelsSet()
                                 : nullptr;
  }
  bool enable_nearest_points = false, enable_signed_distance = false;
  DistanceRequestType type = DistanceRequestTypes::GLOBAL;
  std::size_t max_contacts_per_body = 1;
  std::string group_name;
  const std::set<const moveit::core::LinkModel*>* active_components_only = nullptr;
  const AllowedCollisionMatrix* acm = nullptr;
  double distance_threshold = std::numeric_limits<double>::max();
  bool verbose = false, compute_gradient = false;
};

struct DistanceResultsData
{
  DistanceResultsData() { clear(); }
  double distance;
  Eigen::Vector3d nearest_points[2];
  std::string link_names[2];
  BodyType body_types[2];
  Eigen::Vector3d normal;
  void clear()
  {
    distance = std::numeric_limits<double>::max();
    for (int i = 0; i < 2; ++i)
    {
      nearest_points[i].setZero();
      body_types[i] = BodyTypes::WORLD_OBJECT;
      link_names[i].clear();
    }
    normal.setZero();
  }
  bool operator<(const DistanceResultsData& other) { return distance < other.distance; }
  bool operator>(const DistanceResultsData& other) { return distance > other.distance; }
};
using DistanceMap = std::map<const std::pair<std::string, std::string>, std::vector<DistanceResultsData>>;

struct DistanceResult
{
  bool collision = false;
  DistanceResultsData minimum_distance;
  DistanceMap distances;
  void clear() { *this = DistanceResult(); }
};

struct CollisionResult
{
  using ContactMap = std::map<std::pair<std::string, std::string>, std::vector<Contact>>;
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW

  void clear() { *this = CollisionResult(); }
  void print() const;

  bool collision = false;
  double distance = std::numeric_limits<double>::max();  // m, when asked for
  DistanceResult distance_result;
  std::size_t contact_count = 0;
  ContactMap contacts;  // by the two names, in alphabetical order
  std::set<CostSource> cost_sources;
};
}  // namespace collision_detection
