// Noetic's PCL has boost's pointers, and boost::make_shared<pcl::PointCloud<T>>() makes one of its Ptr. Debian's PCL has std's.
// What is made for a class of PCL is boost's pointer that can be handed on as std's.
#ifndef NOETIC_COMPATIBILITY_BOOST_SMART_PTR_MAKE_SHARED_OBJECT_HPP
#define NOETIC_COMPATIBILITY_BOOST_SMART_PTR_MAKE_SHARED_OBJECT_HPP
#include_next <boost/smart_ptr/make_shared_object.hpp>

#if __cplusplus >= 201103L
#include <memory>
#include <type_traits>

namespace pcl
{
template <typename PointT>
class PointCloud;
template <typename PointT>
class KdTree;
template <typename PointT, typename Dist>
class KdTreeFLANN;
struct ModelCoefficients;
struct PCLPointCloud2;
struct PointIndices;
struct PolygonMesh;
struct TextureMesh;
namespace search
{
template <typename PointT, class Tree>
class KdTree;
template <typename PointT>
class OrganizedNeighbor;
}  // namespace search
}  // namespace pcl

namespace noetic_compatibility
{
/** A boost::shared_ptr; a std::shared_ptr made from it shares the object and keeps it as long. */
template <typename T>
struct SharedPointer : boost::shared_ptr<T>
{
  SharedPointer(const boost::shared_ptr<T>& pointer) : boost::shared_ptr<T>(pointer) {}  // NOLINT: as boost's is returned

  template <typename U, typename = typename std::enable_if<std::is_convertible<T*, U*>::value>::type>
  operator std::shared_ptr<U>() const  // NOLINT: as a Ptr is assigned
  {
    const auto keep = std::make_shared<boost::shared_ptr<T>>(*this);
    return std::shared_ptr<U>(keep, this->get());
  }
};

template <typename T>
struct Made
{
  typedef SharedPointer<T> type;
};
}  // namespace noetic_compatibility

namespace boost
{
namespace detail
{
// What boost::make_shared<T> returns.
template <typename PointT>
struct sp_if_not_array<pcl::PointCloud<PointT>> : noetic_compatibility::Made<pcl::PointCloud<PointT>>
{
};
template <typename PointT>
struct sp_if_not_array<pcl::KdTree<PointT>> : noetic_compatibility::Made<pcl::KdTree<PointT>>
{
};
template <typename PointT, typename Dist>
struct sp_if_not_array<pcl::KdTreeFLANN<PointT, Dist>> : noetic_compatibility::Made<pcl::KdTreeFLANN<PointT, Dist>>
{
};
template <typename PointT, class Tree>
struct sp_if_not_array<pcl::search::KdTree<PointT, Tree>> : noetic_compatibility::Made<pcl::search::KdTree<PointT, Tree>>
{
};
template <typename PointT>
struct sp_if_not_array<pcl::search::OrganizedNeighbor<PointT>>
  : noetic_compatibility::Made<pcl::search::OrganizedNeighbor<PointT>>
{
};
template <>
struct sp_if_not_array<pcl::ModelCoefficients> : noetic_compatibility::Made<pcl::ModelCoefficients>
{
};
template <>
struct sp_if_not_array<pcl::PCLPointCloud2> : noetic_compatibility::Made<pcl::PCLPointCloud2>
{
};
template <>
struct sp_if_not_array<pcl::PointIndices> : noetic_compatibility::Made<pcl::PointIndices>
{
};
template <>
struct sp_if_not_array<pcl::PolygonMesh> : noetic_compatibility::Made<pcl::PolygonMesh>
{
};
template <>
struct sp_if_not_array<pcl::TextureMesh> : noetic_compatibility::Made<pcl::TextureMesh>
{
};
// And of boost::make_shared<const T>.
template <typename PointT>
struct sp_if_not_array<const pcl::PointCloud<PointT>> : noetic_compatibility::Made<const pcl::PointCloud<PointT>>
{
};
template <typename PointT>
struct sp_if_not_array<const pcl::KdTree<PointT>> : noetic_compatibility::Made<const pcl::KdTree<PointT>>
{
};
template <typename PointT, typename Dist>
struct sp_if_not_array<const pcl::KdTreeFLANN<PointT, Dist>> : noetic_compatibility::Made<const pcl::KdTreeFLANN<PointT, Dist>>
{
};
template <typename PointT, class Tree>
struct sp_if_not_array<const pcl::search::KdTree<PointT, Tree>>
  : noetic_compatibility::Made<const pcl::search::KdTree<PointT, Tree>>
{
};
template <typename PointT>
struct sp_if_not_array<const pcl::search::OrganizedNeighbor<PointT>>
  : noetic_compatibility::Made<const pcl::search::OrganizedNeighbor<PointT>>
{
};
template <>
struct sp_if_not_array<const pcl::ModelCoefficients> : noetic_compatibility::Made<const pcl::ModelCoefficients>
{
};
template <>
struct sp_if_not_array<const pcl::PCLPointCloud2> : noetic_compatibility::Made<const pcl::PCLPointCloud2>
{
};
template <>
struct sp_if_not_array<const pcl::PointIndices> : noetic_compatibility::Made<const pcl::PointIndices>
{
};
template <>
struct sp_if_not_array<const pcl::PolygonMesh> : noetic_compatibility::Made<const pcl::PolygonMesh>
{
};
template <>
struct sp_if_not_array<const pcl::TextureMesh> : noetic_compatibility::Made<const pcl::TextureMesh>
{
};
}  // namespace detail
}  // namespace boost
#endif
#endif
