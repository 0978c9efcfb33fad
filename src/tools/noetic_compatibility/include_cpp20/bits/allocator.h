// C++20 took std::allocator<T>::rebind away, of which Debian 12's ROS headers (ros/serialization.h, every message) are made. Noetic's
// compiler has it in -std=c++2a as well: there std::allocator is that of C++17, and so it is here. What its header includes comes first,
// as C++20 wants it.
#pragma once
#pragma GCC system_header
#if __cplusplus > 201703L
#include <bits/c++allocator.h>
#include <bits/memoryfwd.h>
#include <type_traits>
#pragma push_macro("__cplusplus")
#undef __cplusplus
#define __cplusplus 201703L
#include_next <bits/allocator.h>
#pragma pop_macro("__cplusplus")
#else
#include_next <bits/allocator.h>
#endif
