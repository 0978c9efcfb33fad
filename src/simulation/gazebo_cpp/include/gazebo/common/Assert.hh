#pragma once
#include <boost/assert.hpp>
#define GZ_ASSERT(expression, message) BOOST_ASSERT_MSG(expression, message)
