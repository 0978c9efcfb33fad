// What the files of the module _handles share.
#pragma once

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <cstdint>

namespace handles
{

constexpr int numbers = 6;  // at most, of one handle

/// What all handles begin with. data[i] is null where there is no such value, points into the object's own memory, or to that
/// of ``keeper``.
struct Handle
{
  PyObject_HEAD PyObject* name;  // of command handles: null
  PyObject* state;               // of command handles: the state handle, else null
  PyObject* keeper;              // keeps alive what data points to; may be null
  double* data[numbers];
};

inline void* index_of(int index) { return reinterpret_cast<void*>(static_cast<intptr_t>(index)); }

inline int index_in(void* closure) { return static_cast<int>(reinterpret_cast<intptr_t>(closure)); }

// Attributes and methods that several kinds have.

PyObject* object_or_none(PyObject* object);
PyObject* get_name(PyObject* self, void*);
PyObject* get_addresses(PyObject* self, void*);
PyObject* look_at(PyObject* self, PyObject* args);
extern PyMethodDef view_methods[];

/// Take over a name or a state, and let go of what was there.
void assign(PyObject** to, PyObject* value);
/// Whether it is a text; sets an error otherwise.
bool named(PyObject* name);
void release(PyObject* self);

/// Put a type into the module. \param name its last part is that in the module
bool ready(PyObject* module, PyTypeObject& type, const char* name, Py_ssize_t size, initproc init, PyGetSetDef* attributes,
           PyMethodDef* methods, PyTypeObject* base = nullptr, destructor dealloc = release);

/// Sensors and modes: sensor_handles.cpp.
bool add_sensors(PyObject* module);

}  // namespace handles
