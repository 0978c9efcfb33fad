// Names for pointers to a class: NamePtr, NameConstPtr, NameWeakPtr ...
#pragma once

#include <memory>

#define MOVEIT_DECLARE_PTR(Name, Type)                  \
  typedef std::shared_ptr<Type> Name##Ptr;              \
  typedef std::shared_ptr<const Type> Name##ConstPtr;   \
  typedef std::weak_ptr<Type> Name##WeakPtr;            \
  typedef std::weak_ptr<const Type> Name##ConstWeakPtr; \
  typedef std::unique_ptr<Type> Name##UniquePtr;        \
  typedef std::unique_ptr<const Type> Name##ConstUniquePtr

// The same inside of the class: Type::Ptr ...
#define MOVEIT_DECLARE_PTR_MEMBER(Type)           \
  typedef std::shared_ptr<Type> Ptr;              \
  typedef std::shared_ptr<const Type> ConstPtr;   \
  typedef std::weak_ptr<Type> WeakPtr;            \
  typedef std::weak_ptr<const Type> ConstWeakPtr; \
  typedef std::unique_ptr<Type> UniquePtr;        \
  typedef std::unique_ptr<const Type> ConstUniquePtr
