// Handles of sensors, which have several numbers for each quantity, and of drives' modes.
#include "handles.hpp"

#include <cstring>

namespace handles
{
namespace
{

constexpr int values = 37;  // of an inertial measurement unit: 4 + 9 + 3 + 9 + 3 + 9

struct ArraysHandle : Handle
{
  PyObject* frame_id;
  double own[values];
};

struct ModeHandle : Handle
{
  int* mode;
  int own;
};

PyObject* get_frame_id(PyObject* self, void*) { return object_or_none(reinterpret_cast<ArraysHandle*>(self)->frame_id); }

void release_arrays(PyObject* self)
{
  Py_XDECREF(reinterpret_cast<ArraysHandle*>(self)->frame_id);
  release(self);
}

// -- sensors ---------------------------------------------------------------------------------------------------------------------

/// A field of several numbers: which entry of data, where in the object's own memory, how many.
struct Field
{
  const char* name;
  int index, offset, size;
};

Field imu_fields[] = { { "orientation", 0, 0, 4 },          { "orientation_covariance", 1, 4, 9 },
                       { "angular_velocity", 2, 13, 3 },    { "angular_velocity_covariance", 3, 16, 9 },
                       { "linear_acceleration", 4, 25, 3 }, { "linear_acceleration_covariance", 5, 28, 9 } };
Field wrench_fields[] = { { "force", 0, 0, 3 }, { "torque", 1, 3, 3 } };

PyObject* get_array(PyObject* self, void* closure)
{
  const Field* field = static_cast<Field*>(closure);
  const double* data = reinterpret_cast<Handle*>(self)->data[field->index];
  if (!data)
    Py_RETURN_NONE;
  PyObject* result = PyTuple_New(field->size);
  for (int i = 0; result && i < field->size; ++i)
    PyTuple_SET_ITEM(result, i, PyFloat_FromDouble(data[i]));
  return result;
}

int set_array(PyObject* self, PyObject* value, void* closure)
{
  const Field* field = static_cast<Field*>(closure);
  ArraysHandle* handle = reinterpret_cast<ArraysHandle*>(self);
  if (!value || value == Py_None)
  {
    handle->data[field->index] = nullptr;
    return 0;
  }
  PyObject* sequence = PySequence_Fast(value, "numbers are needed here");
  if (!sequence)
    return -1;
  double read[9];
  bool good = PySequence_Fast_GET_SIZE(sequence) == field->size;
  if (!good)
    PyErr_Format(PyExc_ValueError, "%s has %d numbers, not %R", field->name, field->size, value);
  for (int i = 0; good && i < field->size; ++i)
  {
    read[i] = PyFloat_AsDouble(PySequence_Fast_GET_ITEM(sequence, i));
    good = !(read[i] == -1.0 && PyErr_Occurred());
  }
  Py_DECREF(sequence);
  if (!good)
    return -1;
  if (!handle->data[field->index])
    handle->data[field->index] = handle->own + field->offset;
  std::memcpy(handle->data[field->index], read, sizeof(double) * field->size);
  return 0;
}

int init_sensor(PyObject* self, PyObject* args, PyObject* kwargs, const char* const* words, const char* format, Field* fields,
                int count)
{
  ArraysHandle* handle = reinterpret_cast<ArraysHandle*>(self);
  PyObject *name = nullptr, *frame_id = nullptr, *given[numbers] = {};
  if (!PyArg_ParseTupleAndKeywords(args, kwargs, format, const_cast<char**>(words), &name, &frame_id, &given[0], &given[1],
                                   &given[2], &given[3], &given[4], &given[5]) ||
      !named(name))
    return -1;
  if (frame_id && !named(frame_id))
    return -1;
  assign(&handle->name, name);
  PyObject* frame = frame_id ? frame_id : PyUnicode_FromString("");
  if (!frame)
    return -1;
  assign(&handle->frame_id, frame);
  if (!frame_id)
    Py_DECREF(frame);
  for (int i = 0; i < count; ++i)
  {
    handle->data[i] = nullptr;
    if (given[i] && set_array(self, given[i], &fields[i]) < 0)
      return -1;
  }
  return 0;
}

int init_imu(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "name",
                                 "frame_id",
                                 "orientation",
                                 "orientation_covariance",
                                 "angular_velocity",
                                 "angular_velocity_covariance",
                                 "linear_acceleration",
                                 "linear_acceleration_covariance",
                                 nullptr };
  return init_sensor(self, args, kwargs, words, "O|OOOOOOO", imu_fields, 6);
}

int init_wrench(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "name", "frame_id", "force", "torque", nullptr };
  return init_sensor(self, args, kwargs, words, "O|OOO", wrench_fields, 2);
}

// -- modes -----------------------------------------------------------------------------------------------------------------------

int init_mode(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "name", "mode", nullptr };
  PyObject* name = nullptr;
  ModeHandle* handle = reinterpret_cast<ModeHandle*>(self);
  handle->own = -1;
  handle->mode = &handle->own;
  if (!PyArg_ParseTupleAndKeywords(args, kwargs, "O|i", const_cast<char**>(words), &name, &handle->own) || !named(name))
    return -1;
  assign(&handle->name, name);
  return 0;
}

PyObject* get_mode(PyObject* self, void*) { return PyLong_FromLong(*reinterpret_cast<ModeHandle*>(self)->mode); }

int set_mode(PyObject* self, PyObject* value, void*)
{
  const long mode = value ? PyLong_AsLong(value) : -1;
  if (!value || (mode == -1 && PyErr_Occurred()))
    return -1;
  *reinterpret_cast<ModeHandle*>(self)->mode = static_cast<int>(mode);
  return 0;
}

PyObject* get_mode_address(PyObject* self, void*) { return PyLong_FromVoidPtr(reinterpret_cast<ModeHandle*>(self)->mode); }

PyObject* look_at_mode(PyObject* self, PyObject* args)
{
  PyObject *address = nullptr, *keeper = nullptr;
  if (!PyArg_ParseTuple(args, "OO", &address, &keeper))
    return nullptr;
  void* at = PyLong_AsVoidPtr(address);
  if (!at)
    return PyErr_Occurred() ? nullptr : PyErr_Format(PyExc_ValueError, "there is no mode at address 0");
  reinterpret_cast<ModeHandle*>(self)->mode = static_cast<int*>(at);
  assign(&reinterpret_cast<Handle*>(self)->keeper, keeper);
  Py_RETURN_NONE;
}

#define NAME                                    \
  {                                             \
    "name", get_name, nullptr, nullptr, nullptr \
  }
#define ADDRESSES                                          \
  {                                                        \
    "_addresses", get_addresses, nullptr, nullptr, nullptr \
  }
#define ARRAY(field)                                  \
  {                                                   \
    field.name, get_array, set_array, nullptr, &field \
  }
#define FRAME                                           \
  {                                                     \
    "frame_id", get_frame_id, nullptr, nullptr, nullptr \
  }
#define END                                     \
  {                                             \
    nullptr, nullptr, nullptr, nullptr, nullptr \
  }

PyMethodDef mode_methods[] = { { "_look_at", look_at_mode, METH_VARARGS, "Show the mode at this address from now on." },
                               { nullptr, nullptr, 0, nullptr } };
PyGetSetDef imu_attributes[] = { NAME,
                                 FRAME,
                                 ADDRESSES,
                                 ARRAY(imu_fields[0]),
                                 ARRAY(imu_fields[1]),
                                 ARRAY(imu_fields[2]),
                                 ARRAY(imu_fields[3]),
                                 ARRAY(imu_fields[4]),
                                 ARRAY(imu_fields[5]),
                                 END };
PyGetSetDef wrench_attributes[] = { NAME, FRAME, ADDRESSES, ARRAY(wrench_fields[0]), ARRAY(wrench_fields[1]), END };
PyGetSetDef mode_attributes[] = {
  NAME, { "_address", get_mode_address, nullptr, nullptr, nullptr }, { "_mode", get_mode, set_mode, nullptr, nullptr }, END
};

PyTypeObject imu_type = { PyVarObject_HEAD_INIT(nullptr, 0) };
PyTypeObject wrench_type = { PyVarObject_HEAD_INIT(nullptr, 0) };
PyTypeObject mode_type = { PyVarObject_HEAD_INIT(nullptr, 0) };

PyObject* new_mode(PyTypeObject* type, PyObject*, PyObject*)
{
  ModeHandle* handle = reinterpret_cast<ModeHandle*>(type->tp_alloc(type, 0));
  if (handle)
    handle->mode = &handle->own;
  return reinterpret_cast<PyObject*>(handle);
}

}  // namespace

bool add_sensors(PyObject* module)
{
  mode_type.tp_new = new_mode;
  return ready(module, imu_type, "hardware_interface.ImuSensorHandle", sizeof(ArraysHandle), init_imu, imu_attributes,
               view_methods, nullptr, release_arrays) &&
         ready(module, wrench_type, "hardware_interface.ForceTorqueSensorHandle", sizeof(ArraysHandle), init_wrench,
               wrench_attributes, view_methods, nullptr, release_arrays) &&
         ready(module, mode_type, "hardware_interface._handles.JointModeHandle", sizeof(ModeHandle), init_mode, mode_attributes,
               mode_methods);
}

}  // namespace handles
