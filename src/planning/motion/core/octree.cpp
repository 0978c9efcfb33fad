#include <octomap/octomap.h>

#include <fstream>
#include <sstream>

#include "motion/shapes.hpp"

namespace motion
{
namespace
{
void demandResolution(double resolution)
{
  if (!std::isfinite(resolution) || resolution < 1e-4)
    throw InvalidInput("octomap: the resolution is " + std::to_string(resolution) + " m, but must be 0.0001 or more");
}

std::shared_ptr<const OcTreeShape> finished(std::shared_ptr<octomap::OcTree> tree)
{
  // Collision checks read the tree from several threads: what octomap computes lazily is computed here.
  double unused;
  tree->getMetricMin(unused, unused, unused);
  return std::make_shared<OcTreeShape>(std::move(tree));
}
}  // namespace

std::shared_ptr<const OcTreeShape> OcTreeShape::fromMessage(const std::string& data, double resolution, bool binary,
                                                            const std::string& type)
{
  demandResolution(resolution);
  if (type != "OcTree")
    throw InvalidInput("octomap: trees of type '" + type.substr(0, 40) + "' are not understood, only 'OcTree'");
  auto tree = std::make_shared<octomap::OcTree>(resolution);
  std::istringstream stream(data);
  if (!data.empty())
  {
    if (binary)
      tree->readBinaryData(stream);
    else
      tree->readData(stream);
    if (stream.fail())
      throw InvalidInput("octomap: the data (" + std::to_string(data.size()) + " bytes) ends in the middle of the tree");
  }
  return finished(std::move(tree));
}

std::shared_ptr<const OcTreeShape> OcTreeShape::fromPoints(const std::vector<Vector3>& points, double resolution,
                                                           const Vector3* origin)
{
  demandResolution(resolution);
  auto tree = std::make_shared<octomap::OcTree>(resolution);
  octomap::Pointcloud cloud;
  for (const Vector3& p : points)
    if (p.allFinite())
      cloud.push_back(p.x(), p.y(), p.z());
  if (origin)
    tree->insertPointCloud(cloud, octomap::point3d(origin->x(), origin->y(), origin->z()));
  else
    for (const octomap::point3d& p : cloud)
      tree->updateNode(p, true, true);
  tree->updateInnerOccupancy();
  return finished(std::move(tree));
}

std::shared_ptr<const OcTreeShape> OcTreeShape::load(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InvalidInput("octomap file '" + path + "' cannot be opened");
  std::string first;
  std::getline(file, first);
  file.seekg(0);
  if (first.rfind("# Octomap OcTree binary", 0) == 0)
  {
    auto tree = std::make_shared<octomap::OcTree>(0.1);
    if (tree->readBinary(file))
      return finished(tree);
  }
  else
  {
    std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(file));
    if (auto* tree = dynamic_cast<octomap::OcTree*>(read.get()))
    {
      read.release();
      return finished(std::shared_ptr<octomap::OcTree>(tree));
    }
  }
  throw InvalidInput("octomap file '" + path + "' does not hold an OcTree (.bt or .ot)");
}

void OcTreeShape::save(const std::string& path) const
{
  std::ofstream file(path, std::ios::binary);
  auto copy = octomap::OcTree(*tree);
  const bool binary = path.size() > 3 && path.compare(path.size() - 3, 3, ".bt") == 0;
  if (!file || !(binary ? copy.writeBinary(file) : copy.write(file)))
    throw InvalidInput("octomap file '" + path + "' cannot be written");
}

std::string OcTreeShape::message(bool binary) const
{
  std::ostringstream stream;
  if (binary)
  {
    octomap::OcTree copy(*tree);
    copy.toMaxLikelihood();
    copy.writeBinaryData(stream);
  }
  else
    tree->writeData(stream);
  return stream.str();
}

double OcTreeShape::resolution() const { return tree->getResolution(); }

std::size_t OcTreeShape::nodes() const { return tree->size(); }
}  // namespace motion
