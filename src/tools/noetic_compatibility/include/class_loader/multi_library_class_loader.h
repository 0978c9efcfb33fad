// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_CLASS_LOADER_MULTI_LIBRARY_CLASS_LOADER_H
#define NOETIC_COMPATIBILITY_CLASS_LOADER_MULTI_LIBRARY_CLASS_LOADER_H
#include <class_loader/multi_library_class_loader.hpp>
#endif
