// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_CLASS_LOADER_META_OBJECT_H
#define NOETIC_COMPATIBILITY_CLASS_LOADER_META_OBJECT_H
#include <class_loader/meta_object.hpp>
#endif
