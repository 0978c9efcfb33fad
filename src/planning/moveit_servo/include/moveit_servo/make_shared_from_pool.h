// Messages from a pool of memory, for loops that make many of one kind.
#pragma once

#include <boost/make_shared.hpp>
#include <boost/pool/pool_alloc.hpp>

namespace moveit
{
namespace util
{
template <typename T>
boost::shared_ptr<T> make_shared_from_pool()
{
  return boost::allocate_shared<T>(boost::fast_pool_allocator<T>());
}
}  // namespace util
}  // namespace moveit
