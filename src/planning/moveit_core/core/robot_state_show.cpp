// States: markers, boxes and text to look at.
#include <geometric_shapes/shape_operations.h>
#include <tf2_eigen/tf2_eigen.h>

#include <iomanip>
#include <sstream>

#include <moveit/robot_model/aabb.h>
#include <moveit/robot_state/robot_state.h>

namespace moveit
{
namespace core
{
namespace
{
visualization_msgs::Marker markerAt(const Eigen::Isometry3d& pose, const std::string& frame)
{
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = ros::Time::now();
  marker.pose = tf2::toMsg(pose);
  return marker;
}
}  // namespace

void RobotState::getRobotMarkers(visualization_msgs::MarkerArray& arr, const std::vector<std::string>& link_names,
                                 const std_msgs::ColorRGBA& color, const std::string& ns, const ros::Duration& dur,
                                 bool include_attached) const
{
  const std::size_t first = arr.markers.size();
  getRobotMarkers(arr, link_names, include_attached);
  int id = static_cast<int>(first);
  for (std::size_t i = first; i < arr.markers.size(); ++i)
  {
    arr.markers[i].ns = ns;
    arr.markers[i].id = id++;
    arr.markers[i].lifetime = dur;
    arr.markers[i].color = color;
  }
}

void RobotState::getRobotMarkers(visualization_msgs::MarkerArray& arr, const std::vector<std::string>& link_names,
                                 bool include_attached) const
{
  const std::string& frame = robot_model_->getModelFrame();
  for (const std::string& name : link_names)
  {
    const LinkModel* link = robot_model_->getLinkModel(name);
    if (!link)
      continue;
    for (const auto& body : bodies_)
    {
      if (!include_attached || body.second->getAttachedLink() != link)
        continue;
      for (std::size_t j = 0; j < body.second->getShapes().size(); ++j)
      {
        visualization_msgs::Marker marker = markerAt(body.second->getGlobalCollisionBodyTransforms()[j], frame);
        shapes::constructMarkerFromShape(body.second->getShapes()[j].get(), marker);
        if (std::abs(marker.scale.x * marker.scale.y * marker.scale.z) >= std::numeric_limits<float>::epsilon())
          arr.markers.push_back(marker);
      }
    }
    if (link->getVisualMeshFilename().empty())
    {
      for (std::size_t j = 0; j < link->getShapes().size(); ++j)
      {
        visualization_msgs::Marker marker = markerAt(getCollisionBodyTransform(link, j), frame);
        if (shapes::constructMarkerFromShape(link->getShapes()[j].get(), marker) &&
            std::abs(marker.scale.x * marker.scale.y * marker.scale.z) >= std::numeric_limits<float>::epsilon())
          arr.markers.push_back(marker);
      }
      continue;
    }
    visualization_msgs::Marker marker = markerAt(getGlobalLinkTransform(link) * link->getVisualMeshOrigin(), frame);
    marker.type = visualization_msgs::Marker::MESH_RESOURCE;
    marker.mesh_use_embedded_materials = false;
    marker.mesh_resource = link->getVisualMeshFilename();
    marker.scale.x = link->getVisualMeshScale()[0];
    marker.scale.y = link->getVisualMeshScale()[1];
    marker.scale.z = link->getVisualMeshScale()[2];
    arr.markers.push_back(marker);
  }
}

void RobotState::computeAABB(std::vector<double>& aabb) const
{
  AABB box;
  for (const LinkModel* link : robot_model_->getLinkModelsWithCollisionGeometry())
  {
    Eigen::Isometry3d centre = getGlobalLinkTransform(link);
    centre.translate(link->getCenteredBoundingBoxOffset());
    box.extendWithTransformedBox(centre, link->getShapeExtentsAtOrigin());
  }
  for (const auto& body : bodies_)
    for (std::size_t i = 0; i < body.second->getShapes().size(); ++i)
      box.extendWithTransformedBox(body.second->getGlobalCollisionBodyTransforms()[i],
                                   shapes::computeShapeExtents(body.second->getShapes()[i].get()));
  aabb.assign(6, 0.0);
  for (int k = 0; k < 3 && !box.isEmpty(); ++k)
  {
    aabb[2 * k] = box.min()[k];
    aabb[2 * k + 1] = box.max()[k];
  }
}

// ---------------------------------------------------------------- text

void RobotState::printStatePositions(std::ostream& out) const
{
  for (std::size_t i = 0; i < getVariableNames().size(); ++i)
    out << getVariableNames()[i] << '=' << getVariablePosition(i) << std::endl;
}

void RobotState::printStatePositionsWithJointLimits(const JointModelGroup* jmg, std::ostream& out) const
{
  for (const JointModel* joint : jmg->getActiveJointModels())
  {
    if (joint->getVariableCount() != 1)
      continue;
    const VariableBounds& b = joint->getVariableBounds()[0];
    const double value = *getJointPositions(joint);
    out << "   " << std::fixed << std::setprecision(5) << b.min_position_ << "\t";
    const double share = (value - b.min_position_) / (b.max_position_ - b.min_position_);
    for (int step = 0; step < 20; ++step)
      out << (static_cast<int>(share * 19 + 0.5) == step ? '|' : '-');
    out << " \t" << b.max_position_ << "  \t" << joint->getName() << " current: " << value
        << (joint->satisfiesPositionBounds(&value) ? "" : " <-- out of bounds") << std::endl;
  }
}

void RobotState::printDirtyInfo(std::ostream& out) const
{
  out << "  * Dirty Joint Transforms: " << std::endl << "  * Dirty Link Transforms: NULL" << std::endl;
}

void RobotState::printStateInfo(std::ostream& out) const
{
  out << "Robot State @" << this << std::endl << "  * Position: ";
  for (std::size_t i = 0; i < getVariableCount(); ++i)
    out << getVariablePosition(i) << ' ';
  out << std::endl << "  * Velocity: ";
  for (std::size_t i = 0; i < getVariableCount() && hasVelocities(); ++i)
    out << getVariableVelocity(i) << ' ';
  out << (hasVelocities() ? "" : "NULL") << std::endl << "  * Acceleration: ";
  for (std::size_t i = 0; i < getVariableCount() && hasAccelerations(); ++i)
    out << getVariableAcceleration(i) << ' ';
  out << (hasAccelerations() ? "" : "NULL") << std::endl;
  printTransforms(out);
}

void RobotState::printTransform(const Eigen::Isometry3d& transform, std::ostream& out) const
{
  const Eigen::Quaterniond q(transform.linear());
  out << "T.xyz = [" << transform.translation().transpose() << "], Q.xyzw = [" << q.x() << ", " << q.y() << ", " << q.z()
      << ", " << q.w() << "]" << std::endl;
}

void RobotState::printTransforms(std::ostream& out) const
{
  out << "Joint transforms:" << std::endl;
  for (const JointModel* joint : robot_model_->getJointModels())
  {
    out << "  " << joint->getName() << ": ";
    printTransform(getJointTransform(joint), out);
  }
  out << "Link poses:" << std::endl;
  for (const LinkModel* link : robot_model_->getLinkModels())
  {
    out << "  " << link->getName() << ": ";
    printTransform(getGlobalLinkTransform(link), out);
  }
}

std::string RobotState::getStateTreeString() const
{
  std::ostringstream out;
  out << "ROBOT: " << robot_model_->getName() << std::endl;
  for (const LinkModel* link : robot_model_->getLinkModels())
  {
    int depth = 0;
    for (const LinkModel* above = link->getParentLinkModel(); above; above = above->getParentLinkModel())
      ++depth;
    const JointModel* joint = link->getParentJointModel();
    const std::string indent(2 * depth, ' ');
    out << indent << "Joint: " << joint->getName() << std::endl;
    for (std::size_t k = 0; k < joint->getVariableCount(); ++k)
      out << indent << "  " << joint->getVariableNames()[k] << " = " << getJointPositions(joint)[k] << std::endl;
    out << indent << "Link: " << link->getName() << ": ";
    printTransform(getGlobalLinkTransform(link), out);
  }
  return out.str();
}

std::ostream& operator<<(std::ostream& out, const RobotState& s)
{
  s.printStateInfo(out);
  return out;
}
}  // namespace core
}  // namespace moveit
