// Handles of the Python side: small objects whose numbers are C doubles at addresses that never change while the object lives, so
// that C++ handles can point at them; or views of doubles that somebody else keeps (a robot written in C++).
//
// Written with Python's own interface: an attribute of a handle is read and written in every step, and a bound property of
// pybind11 takes four times as long.

#include "handles.hpp"

#include <cstring>

namespace handles
{

struct NumbersHandle : Handle
{
  double own[numbers];
};

Handle* state_of(PyObject* self)
{
  Handle* handle = reinterpret_cast<Handle*>(self);
  return handle->state ? reinterpret_cast<Handle*>(handle->state) : handle;
}

// -- attributes ------------------------------------------------------------------------------------------------------------------

PyObject* get_number(PyObject* self, void* closure)
{
  const double* at = reinterpret_cast<Handle*>(self)->data[index_in(closure)];
  if (at)
    return PyFloat_FromDouble(*at);
  Py_RETURN_NONE;
}

/// What is not there because __init__ was not called shows as None.
PyObject* object_or_none(PyObject* object)
{
  object = object ? object : Py_None;
  Py_INCREF(object);
  return object;
}

/// Of the state, seen through a command handle.
PyObject* get_state_number(PyObject* self, void* closure)
{
  return get_number(reinterpret_cast<PyObject*>(state_of(self)), closure);
}

int set_number(PyObject* self, PyObject* value, void* closure)
{
  if (!value)
  {
    PyErr_SetString(PyExc_AttributeError, "a value of a handle cannot be deleted");
    return -1;
  }
  NumbersHandle* handle = reinterpret_cast<NumbersHandle*>(self);
  const int index = index_in(closure);
  double number;
  if (PyFloat_CheckExact(value))
    number = PyFloat_AS_DOUBLE(value);
  else
  {
    number = PyFloat_AsDouble(value);
    if (number == -1.0 && PyErr_Occurred())
      return -1;
  }
  if (!handle->data[index])
    handle->data[index] = &handle->own[index];
  *handle->data[index] = number;
  return 0;
}

/// A value that may be None: not there.
int set_optional(PyObject* self, PyObject* value, void* closure)
{
  if (value != Py_None)
    return set_number(self, value, closure);
  reinterpret_cast<Handle*>(self)->data[index_in(closure)] = nullptr;
  return 0;
}

PyObject* get_name(PyObject* self, void*) { return object_or_none(state_of(self)->name); }

PyObject* get_state(PyObject* self, void*) { return object_or_none(reinterpret_cast<Handle*>(self)->state); }

/// Addresses of the numbers, 0 for what is not there. They are good as long as the handle lives.
PyObject* get_addresses(PyObject* self, void*)
{
  PyObject* addresses = PyTuple_New(numbers);
  for (int i = 0; addresses && i < numbers; ++i)
    PyTuple_SET_ITEM(addresses, i, PyLong_FromVoidPtr(reinterpret_cast<Handle*>(self)->data[i]));
  return addresses;
}

// -- life ------------------------------------------------------------------------------------------------------------------------

void release(PyObject* self)
{
  Handle* handle = reinterpret_cast<Handle*>(self);
  Py_XDECREF(handle->name);
  Py_XDECREF(handle->state);
  Py_XDECREF(handle->keeper);
  Py_TYPE(self)->tp_free(self);
}

/// Take over (name, or state), and let go of what was there.
void assign(PyObject** to, PyObject* value)
{
  Py_INCREF(value);
  PyObject* old = *to;
  *to = value;
  Py_XDECREF(old);
}

bool named(PyObject* name)
{
  if (PyUnicode_Check(name))
    return true;
  PyErr_Format(PyExc_TypeError, "the name of a handle is a text, not %R", name);
  return false;
}

void point_at_own(Handle* handle, double* own, int count)
{
  for (int i = 0; i < count; ++i)
    handle->data[i] = &own[i];
}

/// Numbers from keyword arguments; all of them begin with 0.
int fill(NumbersHandle* handle, PyObject* const* given, int count, int optional_from)
{
  point_at_own(handle, handle->own, count);
  for (int i = 0; i < count; ++i)
  {
    handle->own[i] = 0.0;
    if (i >= optional_from && (!given[i] || given[i] == Py_None))
      handle->data[i] = nullptr;
    else if (given[i] && set_number(reinterpret_cast<PyObject*>(handle), given[i], index_of(i)) < 0)
      return -1;
  }
  return 0;
}

int init_state(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "name", "position", "velocity", "effort", "absolute_position", "torque_sensor", nullptr };
  PyObject* name = nullptr;
  PyObject* given[5] = {};
  if (!PyArg_ParseTupleAndKeywords(args, kwargs, "O|OOOOO", const_cast<char**>(words), &name, &given[0], &given[1], &given[2],
                                   &given[3], &given[4]) ||
      !named(name))
    return -1;
  assign(&reinterpret_cast<Handle*>(self)->name, name);
  return fill(reinterpret_cast<NumbersHandle*>(self), given, 5, 3);
}

extern PyTypeObject state_type;

/// "O|..." of a state and ``count`` numbers, whose words begin at words[1].
int init_command(PyObject* self, PyObject* args, PyObject* kwargs, const char* const* words, const char* format, int count)
{
  PyObject* state = nullptr;
  PyObject* given[numbers] = {};
  if (!PyArg_ParseTupleAndKeywords(args, kwargs, format, const_cast<char**>(words), &state, &given[0], &given[1], &given[2],
                                   &given[3], &given[4]))
    return -1;
  if (!PyObject_TypeCheck(state, &state_type))
  {
    PyErr_Format(PyExc_TypeError, "a joint or actuator state handle is needed here, not %R", state);
    return -1;
  }
  assign(&reinterpret_cast<Handle*>(self)->state, state);
  return fill(reinterpret_cast<NumbersHandle*>(self), given, count, count);
}

int init_joint(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "state", "command", "slope", nullptr };
  return init_command(self, args, kwargs, words, "O|OO", 2);
}

int init_pos_vel(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "state", "command_position", "command_velocity", nullptr };
  return init_command(self, args, kwargs, words, "O|OO", 2);
}

int init_pos_vel_acc(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "state", "command_position", "command_velocity", "command_acceleration", nullptr };
  return init_command(self, args, kwargs, words, "O|OOO", 3);
}

int init_gains(PyObject* self, PyObject* args, PyObject* kwargs)
{
  static const char* words[] = { "state", "command_position", "command_velocity", "command_effort", "kp", "kd", nullptr };
  return init_command(self, args, kwargs, words, "O|OOOOO", 5);
}

// -- views -----------------------------------------------------------------------------------------------------------------------

/// handle._look_at(addresses, keeper): the numbers are those at the addresses from now on, 0 for what is not there.
PyObject* look_at(PyObject* self, PyObject* args)
{
  PyObject *addresses = nullptr, *keeper = nullptr;
  if (!PyArg_ParseTuple(args, "O!O", &PyTuple_Type, &addresses, &keeper))
    return nullptr;
  Handle* handle = reinterpret_cast<Handle*>(self);
  const Py_ssize_t count = PyTuple_GET_SIZE(addresses);
  for (Py_ssize_t i = 0; i < count && i < numbers; ++i)
  {
    handle->data[i] = static_cast<double*>(PyLong_AsVoidPtr(PyTuple_GET_ITEM(addresses, i)));
    if (PyErr_Occurred())
      return nullptr;
  }
  assign(&handle->keeper, keeper);
  Py_RETURN_NONE;
}

PyObject* show(PyObject* self)
{
  PyObject* name = state_of(self)->name;
  return PyUnicode_FromFormat("%s(%R)", _PyType_Name(Py_TYPE(self)), name ? name : Py_None);
}

// -- tables ----------------------------------------------------------------------------------------------------------------------

PyMethodDef view_methods[] = { { "_look_at", look_at, METH_VARARGS, "Show the doubles at these addresses from now on." },
                               { nullptr, nullptr, 0, nullptr } };

#define NAME                                    \
  {                                             \
    "name", get_name, nullptr, nullptr, nullptr \
  }
#define ADDRESSES                                          \
  {                                                        \
    "_addresses", get_addresses, nullptr, nullptr, nullptr \
  }
#define NUMBER(word, index)                                \
  {                                                        \
    word, get_number, set_number, nullptr, index_of(index) \
  }
#define OF_STATE(word, index)                                 \
  {                                                           \
    word, get_state_number, nullptr, nullptr, index_of(index) \
  }
#define STATE                                                                                                           \
  NAME, ADDRESSES, { "state", get_state, nullptr, nullptr, nullptr }, OF_STATE("position", 0), OF_STATE("velocity", 1), \
      OF_STATE("effort", 2), OF_STATE("absolute_position", 3), OF_STATE("torque_sensor", 4)
#define END                                     \
  {                                             \
    nullptr, nullptr, nullptr, nullptr, nullptr \
  }

PyGetSetDef state_attributes[] = { NAME,
                                   ADDRESSES,
                                   NUMBER("position", 0),
                                   NUMBER("velocity", 1),
                                   NUMBER("effort", 2),
                                   { "absolute_position", get_number, set_optional, nullptr, index_of(3) },
                                   { "torque_sensor", get_number, set_optional, nullptr, index_of(4) },
                                   END };
PyGetSetDef joint_attributes[] = { STATE, NUMBER("command", 0), NUMBER("slope", 1), END };
PyGetSetDef pos_vel_attributes[] = { STATE, NUMBER("command_position", 0), NUMBER("command_velocity", 1), END };
PyGetSetDef pos_vel_acc_attributes[] = { NUMBER("command_acceleration", 2), END };
PyGetSetDef gains_attributes[] = { NUMBER("command_effort", 2), NUMBER("kp", 3), NUMBER("kd", 4), END };

// Looking an attribute up in the tables takes longer than reading the number. Those of the control loop are told by their names,
// which are one object each (interned) wherever they are written out in a program.

PyObject *word_position, *word_velocity, *word_effort, *word_command, *word_state;

PyObject* get_of_state(PyObject* self, PyObject* name)
{
  if (name == word_position)
    return get_number(self, index_of(0));
  if (name == word_velocity)
    return get_number(self, index_of(1));
  return PyObject_GenericGetAttr(self, name);
}

int set_of_state(PyObject* self, PyObject* name, PyObject* value)
{
  if (name == word_position)
    return set_number(self, value, index_of(0));
  if (name == word_velocity)
    return set_number(self, value, index_of(1));
  if (name == word_effort)
    return set_number(self, value, index_of(2));
  return PyObject_GenericSetAttr(self, name, value);
}

PyObject* get_of_joint(PyObject* self, PyObject* name)
{
  if (name == word_command)
    return get_number(self, index_of(0));
  if (name == word_state)
    return get_state(self, nullptr);
  if (name == word_position)
    return get_state_number(self, index_of(0));
  if (name == word_velocity)
    return get_state_number(self, index_of(1));
  return PyObject_GenericGetAttr(self, name);
}

int set_of_joint(PyObject* self, PyObject* name, PyObject* value)
{
  if (name == word_command)
    return set_number(self, value, index_of(0));
  return PyObject_GenericSetAttr(self, name, value);
}

PyTypeObject state_type = { PyVarObject_HEAD_INIT(nullptr, 0) };
PyTypeObject joint_type = { PyVarObject_HEAD_INIT(nullptr, 0) };
PyTypeObject pos_vel_type = { PyVarObject_HEAD_INIT(nullptr, 0) };
PyTypeObject pos_vel_acc_type = { PyVarObject_HEAD_INIT(nullptr, 0) };
PyTypeObject gains_type = { PyVarObject_HEAD_INIT(nullptr, 0) };

bool ready(PyObject* module, PyTypeObject& type, const char* name, Py_ssize_t size, initproc init, PyGetSetDef* attributes,
           PyMethodDef* methods, PyTypeObject* base, destructor dealloc)
{
  type.tp_name = name;
  type.tp_basicsize = size;
  type.tp_flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE;
  if (!type.tp_new)
    type.tp_new = PyType_GenericNew;
  type.tp_init = init;
  type.tp_dealloc = dealloc;
  type.tp_getset = attributes;
  type.tp_methods = methods;
  type.tp_repr = show;
  type.tp_base = base;
  return PyType_Ready(&type) == 0 &&
         PyModule_AddObjectRef(module, std::strrchr(name, '.') + 1, reinterpret_cast<PyObject*>(&type)) == 0;
}

PyModuleDef definition = {
  PyModuleDef_HEAD_INIT, "_handles", "Handles whose numbers C++ can point at.", -1, nullptr, nullptr, nullptr, nullptr, nullptr
};

}  // namespace handles

using namespace handles;

PyMODINIT_FUNC PyInit__handles()
{
  PyObject* module = PyModule_Create(&definition);
  const Py_ssize_t size = sizeof(NumbersHandle);
  word_position = PyUnicode_InternFromString("position");
  word_velocity = PyUnicode_InternFromString("velocity");
  word_effort = PyUnicode_InternFromString("effort");
  word_command = PyUnicode_InternFromString("command");
  word_state = PyUnicode_InternFromString("state");
  state_type.tp_getattro = get_of_state;
  state_type.tp_setattro = set_of_state;
  joint_type.tp_getattro = get_of_joint;
  joint_type.tp_setattro = set_of_joint;
  if (module &&
      ready(module, state_type, "hardware_interface.JointStateHandle", size, init_state, state_attributes, view_methods) &&
      ready(module, joint_type, "hardware_interface.JointHandle", size, init_joint, joint_attributes, view_methods) &&
      ready(module, pos_vel_type, "hardware_interface.PosVelJointHandle", size, init_pos_vel, pos_vel_attributes,
            view_methods) &&
      ready(module, pos_vel_acc_type, "hardware_interface.PosVelAccJointHandle", size, init_pos_vel_acc, pos_vel_acc_attributes,
            nullptr, &pos_vel_type) &&
      ready(module, gains_type, "hardware_interface.PositionVelocityTorqueGainsJointHandle", size, init_gains, gains_attributes,
            nullptr, &pos_vel_type) &&
      add_sensors(module))
    return module;
  Py_XDECREF(module);
  return nullptr;
}
