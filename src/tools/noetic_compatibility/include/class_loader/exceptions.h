// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_CLASS_LOADER_EXCEPTIONS_H
#define NOETIC_COMPATIBILITY_CLASS_LOADER_EXCEPTIONS_H
#include <class_loader/exceptions.hpp>
#endif
