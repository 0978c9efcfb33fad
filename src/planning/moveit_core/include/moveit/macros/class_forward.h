// Announces a class and the names of pointers to it.
#pragma once

#include <moveit/macros/declare_ptr.h>

#define MOVEIT_CLASS_FORWARD(C) \
  class C;                      \
  MOVEIT_DECLARE_PTR(C, C)

#define MOVEIT_STRUCT_FORWARD(C) \
  struct C;                      \
  MOVEIT_DECLARE_PTR(C, C)
