#include <moveit/collision_detection/collision_tools.h>

#include <algorithm>

namespace collision_detection
{
namespace
{
std_msgs::ColorRGBA colour(float r, float g, float b, float a)
{
  std_msgs::ColorRGBA c;
  c.r = r;
  c.g = g;
  c.b = b;
  c.a = a;
  return c;
}

visualization_msgs::Marker marker(const std::string& frame, const std_msgs::ColorRGBA& color, const ros::Duration& lifetime)
{
  visualization_msgs::Marker m;
  m.header.frame_id = frame;
  m.header.stamp = ros::Time::now();
  m.action = visualization_msgs::Marker::ADD;
  m.pose.orientation.w = 1.0;
  m.color = color;
  m.lifetime = lifetime;
  return m;
}

// The box that both share; false if there is none.
bool common(const CostSource& a, const CostSource& b, CostSource& out)
{
  out.cost = std::max(a.cost, b.cost);
  for (int i = 0; i < 3; ++i)
  {
    out.aabb_min[i] = std::max(a.aabb_min[i], b.aabb_min[i]);
    out.aabb_max[i] = std::min(a.aabb_max[i], b.aabb_max[i]);
    if (out.aabb_min[i] >= out.aabb_max[i])
      return false;
  }
  return true;
}

bool overlaps(const CostSource& one, const CostSource& other, double fraction)
{
  CostSource shared;
  return common(one, other, shared) && shared.getVolume() >= one.getVolume() * fraction;
}
}  // namespace

void getCollisionMarkersFromContacts(visualization_msgs::MarkerArray& arr, const std::string& frame_id,
                                     const CollisionResult::ContactMap& con)
{
  getCollisionMarkersFromContacts(arr, frame_id, con, colour(1.0f, 0.0f, 0.0f, 0.8f), ros::Duration(60.0));
}

void getCollisionMarkersFromContacts(visualization_msgs::MarkerArray& arr, const std::string& frame_id,
                                     const CollisionResult::ContactMap& con, const std_msgs::ColorRGBA& color,
                                     const ros::Duration& lifetime, const double radius)
{
  std::map<std::string, int> numbers;
  for (const auto& pair : con)
    for (const Contact& contact : pair.second)
    {
      visualization_msgs::Marker m = marker(frame_id, color, lifetime);
      m.ns = contact.body_name_1 + "=" + contact.body_name_2;
      m.id = numbers[m.ns]++;
      m.type = visualization_msgs::Marker::SPHERE;
      m.pose.position.x = contact.pos.x();
      m.pose.position.y = contact.pos.y();
      m.pose.position.z = contact.pos.z();
      m.scale.x = m.scale.y = m.scale.z = 2.0 * radius;
      arr.markers.push_back(m);
    }
}

void getCostMarkers(visualization_msgs::MarkerArray& arr, const std::string& frame_id, std::set<CostSource>& cost_sources)
{
  getCostMarkers(arr, frame_id, cost_sources, colour(1.0f, 0.5f, 0.0f, 0.4f), ros::Duration(60.0));
}

void getCostMarkers(visualization_msgs::MarkerArray& arr, const std::string& frame_id, std::set<CostSource>& cost_sources,
                    const std_msgs::ColorRGBA& color, const ros::Duration& lifetime)
{
  int number = 0;
  for (const CostSource& source : cost_sources)
  {
    visualization_msgs::Marker m = marker(frame_id, color, lifetime);
    m.ns = "cost_source";
    m.id = number++;
    m.type = visualization_msgs::Marker::CUBE;
    m.pose.position.x = (source.aabb_max[0] + source.aabb_min[0]) / 2.0;
    m.pose.position.y = (source.aabb_max[1] + source.aabb_min[1]) / 2.0;
    m.pose.position.z = (source.aabb_max[2] + source.aabb_min[2]) / 2.0;
    m.scale.x = source.aabb_max[0] - source.aabb_min[0];
    m.scale.y = source.aabb_max[1] - source.aabb_min[1];
    m.scale.z = source.aabb_max[2] - source.aabb_min[2];
    arr.markers.push_back(m);
  }
}

double getTotalCost(const std::set<CostSource>& cost_sources)
{
  double sum = 0.0;
  for (const CostSource& source : cost_sources)
    sum += source.getVolume() * source.cost;
  return sum;
}

void removeCostSources(std::set<CostSource>& cost_sources, const std::set<CostSource>& cost_sources_to_remove,
                       double overlap_fraction)
{
  for (auto it = cost_sources.begin(); it != cost_sources.end();)
    it = std::any_of(cost_sources_to_remove.begin(), cost_sources_to_remove.end(),
                     [&](const CostSource& other) { return overlaps(*it, other, overlap_fraction); })
             ? cost_sources.erase(it)
             : std::next(it);
}

void intersectCostSources(std::set<CostSource>& cost_sources, const std::set<CostSource>& a, const std::set<CostSource>& b)
{
  cost_sources.clear();
  CostSource shared;
  for (const CostSource& one : a)
    for (const CostSource& other : b)
      if (common(one, other, shared))
        cost_sources.insert(shared);
}

void removeOverlapping(std::set<CostSource>& cost_sources, double overlap_fraction)
{
  for (auto it = cost_sources.begin(); it != cost_sources.end(); ++it)
    for (auto other = std::next(it); other != cost_sources.end();)
      other = overlaps(*other, *it, overlap_fraction) ? cost_sources.erase(other) : std::next(other);
}

bool getSensorPositioning(geometry_msgs::Point& point, const std::set<CostSource>& cost_sources)
{
  if (cost_sources.empty())
    return false;
  Eigen::Vector3d sum(0.0, 0.0, 0.0);
  double weight = 0.0;
  for (const CostSource& source : cost_sources)
  {
    const double cost = source.getVolume() * source.cost;
    for (int i = 0; i < 3; ++i)
      sum[i] += cost * (source.aabb_min[i] + source.aabb_max[i]) / 2.0;
    weight += cost;
  }
  if (!(weight > 0.0))
    return false;
  point.x = sum.x() / weight;
  point.y = sum.y() / weight;
  point.z = sum.z() / weight;
  return true;
}

void costSourceToMsg(const CostSource& cost_source, moveit_msgs::CostSource& msg)
{
  msg.cost_density = cost_source.cost;
  msg.aabb_min.x = cost_source.aabb_min[0];
  msg.aabb_min.y = cost_source.aabb_min[1];
  msg.aabb_min.z = cost_source.aabb_min[2];
  msg.aabb_max.x = cost_source.aabb_max[0];
  msg.aabb_max.y = cost_source.aabb_max[1];
  msg.aabb_max.z = cost_source.aabb_max[2];
}

namespace
{
std::uint32_t messageType(BodyType type)
{
  return type == BodyTypes::ROBOT_LINK       ? moveit_msgs::ContactInformation::ROBOT_LINK
         : type == BodyTypes::ROBOT_ATTACHED ? moveit_msgs::ContactInformation::ROBOT_ATTACHED
                                             : moveit_msgs::ContactInformation::WORLD_OBJECT;
}
}  // namespace

void contactToMsg(const Contact& contact, moveit_msgs::ContactInformation& msg)
{
  msg.contact_body_1 = contact.body_name_1;
  msg.contact_body_2 = contact.body_name_2;
  msg.body_type_1 = messageType(contact.body_type_1);
  msg.body_type_2 = messageType(contact.body_type_2);
  msg.depth = contact.depth;
  msg.position.x = contact.pos.x();
  msg.position.y = contact.pos.y();
  msg.position.z = contact.pos.z();
  msg.normal.x = contact.normal.x();
  msg.normal.y = contact.normal.y();
  msg.normal.z = contact.normal.z();
}
}  // namespace collision_detection
