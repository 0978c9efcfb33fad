// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_CLASS_LOADER_REGISTER_MACRO_H
#define NOETIC_COMPATIBILITY_CLASS_LOADER_REGISTER_MACRO_H
#include <class_loader/register_macro.hpp>
#endif
