// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_CLASS_LOADER_CLASS_LOADER_H
#define NOETIC_COMPATIBILITY_CLASS_LOADER_CLASS_LOADER_H
#include <class_loader/class_loader.hpp>
#endif
