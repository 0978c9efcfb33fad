// Contacts and costs as markers and messages.
#pragma once

#include <geometry_msgs/Point.h>
#include <moveit_msgs/ContactInformation.h>
#include <moveit_msgs/CostSource.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <moveit/collision_detection/collision_common.h>

namespace collision_detection
{
// A sphere of `radius` m at each contact, in a namespace for each pair of bodies; red for 60 s unless told otherwise.
void getCollisionMarkersFromContacts(visualization_msgs::MarkerArray& arr, const std::string& frame_id,
                                     const CollisionResult::ContactMap& con, const std_msgs::ColorRGBA& color,
                                     const ros::Duration& lifetime, const double radius = 0.035);
void getCollisionMarkersFromContacts(visualization_msgs::MarkerArray& arr, const std::string& frame_id,
                                     const CollisionResult::ContactMap& con);
void getCostMarkers(visualization_msgs::MarkerArray& arr, const std::string& frame_id, std::set<CostSource>& cost_sources);
void getCostMarkers(visualization_msgs::MarkerArray& arr, const std::string& frame_id, std::set<CostSource>& cost_sources,
                    const std_msgs::ColorRGBA& color, const ros::Duration& lifetime);

double getTotalCost(const std::set<CostSource>& cost_sources);  // volume times density, summed
// Takes away what overlaps others by more than a fraction of its volume.
void removeCostSources(std::set<CostSource>& cost_sources, const std::set<CostSource>& cost_sources_to_remove,
                       double overlap_fraction);
void intersectCostSources(std::set<CostSource>& cost_sources, const std::set<CostSource>& a, const std::set<CostSource>& b);
void removeOverlapping(std::set<CostSource>& cost_sources, double overlap_fraction);
// The mean of the boxes' centres, weighted by cost; false without any.
bool getSensorPositioning(geometry_msgs::Point& point, const std::set<CostSource>& cost_sources);

void costSourceToMsg(const CostSource& cost_source, moveit_msgs::CostSource& msg);
void contactToMsg(const Contact& contact, moveit_msgs::ContactInformation& msg);
}  // namespace collision_detection
