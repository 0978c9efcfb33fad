// Robots in both languages: a C++ twin of a robot written in Python, whose handles point at the numbers of Python's handles; and what
// Python needs to show a robot written in C++.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <hardware_interface/actuator_command_interface.h>
#include <hardware_interface/actuator_state_interface.h>
#include <hardware_interface/force_torque_sensor_interface.h>
#include <hardware_interface/imu_sensor_interface.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_mode_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/position_velocity_torque_gains_command_interface.h>
#include <hardware_interface/posvel_command_interface.h>
#include <hardware_interface/posvelacc_command_interface.h>
#include <hardware_interface/robot_hw.h>

namespace py = pybind11;
namespace hwi = hardware_interface;

namespace
{

using Addresses = std::vector<std::uintptr_t>;

/// A handle as it goes between the languages: where its state, its commands (or all that a sensor measures) are.
struct Record
{
  std::string name, frame_id;
  Addresses state, data;
};

double* at(const Addresses& addresses, std::size_t index)
{
  return index < addresses.size() ? reinterpret_cast<double*>(addresses[index]) : nullptr;
}

template <class... P>
Addresses addresses(const P*... pointers)
{
  return { reinterpret_cast<std::uintptr_t>(pointers)... };
}

// -- one pair of functions for each kind of handle: to C++ and back -----------------------------------------------------------------

template <class StateHandle>
StateHandle state_handle(const Record& record)
{
  const Addresses& s = record.state;
  const double *absolute = at(s, 3), *torque = at(s, 4);
  if (absolute && torque)
    return StateHandle(record.name, at(s, 0), at(s, 1), at(s, 2), absolute, torque);
  if (absolute)
    return StateHandle(record.name, at(s, 0), at(s, 1), at(s, 2), absolute);
  if (torque)
    return StateHandle(record.name, at(s, 0), at(s, 1), at(s, 2), torque, true);
  return StateHandle(record.name, at(s, 0), at(s, 1), at(s, 2));
}

template <class StateHandle>
Record state_record(const StateHandle& handle)
{
  return { handle.getName(),
           "",
           addresses(handle.getPositionPtr(), handle.getVelocityPtr(), handle.getEffortPtr(), handle.getAbsolutePositionPtr(),
                     handle.getTorqueSensorPtr()),
           {} };
}

template <class Handle>
struct Kind;

template <>
struct Kind<hwi::JointStateHandle>
{
  static hwi::JointStateHandle make(const Record& record) { return state_handle<hwi::JointStateHandle>(record); }
  static Record show(const hwi::JointStateHandle& handle) { return state_record(handle); }
};

template <>
struct Kind<hwi::ActuatorStateHandle>
{
  static hwi::ActuatorStateHandle make(const Record& record) { return state_handle<hwi::ActuatorStateHandle>(record); }
  static Record show(const hwi::ActuatorStateHandle& handle) { return state_record(handle); }
};

template <class Handle>
Record with(Record record, const Addresses& data)
{
  record.data = data;
  return record;
}

template <>
struct Kind<hwi::JointHandle>
{
  static hwi::JointHandle make(const Record& record)
  {
    return hwi::JointHandle(state_handle<hwi::JointStateHandle>(record), at(record.data, 0));
  }
  static Record show(const hwi::JointHandle& handle)
  {
    return with<hwi::JointHandle>(state_record<hwi::JointStateHandle>(handle), addresses(handle.getCommandPtr()));
  }
};

template <>
struct Kind<hwi::ActuatorHandle>
{
  static hwi::ActuatorHandle make(const Record& record)
  {
    return hwi::ActuatorHandle(state_handle<hwi::ActuatorStateHandle>(record), at(record.data, 0));
  }
  static Record show(const hwi::ActuatorHandle& handle)
  {
    return with<hwi::ActuatorHandle>(state_record<hwi::ActuatorStateHandle>(handle), addresses(handle.getCommandPtr()));
  }
};

template <>
struct Kind<hwi::PosVelJointHandle>
{
  static hwi::PosVelJointHandle make(const Record& record)
  {
    return hwi::PosVelJointHandle(state_handle<hwi::JointStateHandle>(record), at(record.data, 0), at(record.data, 1));
  }
  static Record show(const hwi::PosVelJointHandle& handle)
  {
    return with<hwi::PosVelJointHandle>(state_record<hwi::JointStateHandle>(handle),
                                        addresses(handle.getCommandPositionPtr(), handle.getCommandVelocityPtr()));
  }
};

template <>
struct Kind<hwi::PosVelAccJointHandle>
{
  static hwi::PosVelAccJointHandle make(const Record& record)
  {
    const Addresses& d = record.data;
    return hwi::PosVelAccJointHandle(state_handle<hwi::JointStateHandle>(record), at(d, 0), at(d, 1), at(d, 2));
  }
  static Record show(const hwi::PosVelAccJointHandle& handle)
  {
    return with<hwi::PosVelAccJointHandle>(
        state_record<hwi::JointStateHandle>(handle),
        addresses(handle.getCommandPositionPtr(), handle.getCommandVelocityPtr(), handle.getCommandAccelerationPtr()));
  }
};

template <>
struct Kind<hwi::PositionVelocityTorqueGainsJointHandle>
{
  using Handle = hwi::PositionVelocityTorqueGainsJointHandle;
  static Handle make(const Record& record)
  {
    const Addresses& d = record.data;
    return Handle(state_handle<hwi::JointStateHandle>(record), at(d, 0), at(d, 1), at(d, 2), at(d, 3), at(d, 4));
  }
  static Record show(const Handle& handle)
  {
    return with<Handle>(state_record<hwi::JointStateHandle>(handle),
                        addresses(handle.getCommandPositionPtr(), handle.getCommandVelocityPtr(), handle.getCommandEffortPtr(),
                                  handle.getCommandKpPtr(), handle.getCommandKdPtr()));
  }
};

template <>
struct Kind<hwi::ImuSensorHandle>
{
  static hwi::ImuSensorHandle make(const Record& record)
  {
    const Addresses& d = record.data;
    return hwi::ImuSensorHandle(record.name, record.frame_id, at(d, 0), at(d, 1), at(d, 2), at(d, 3), at(d, 4), at(d, 5));
  }
  static Record show(const hwi::ImuSensorHandle& handle)
  {
    return { handle.getName(),
             handle.getFrameId(),
             {},
             addresses(handle.getOrientation(), handle.getOrientationCovariance(), handle.getAngularVelocity(),
                       handle.getAngularVelocityCovariance(), handle.getLinearAcceleration(),
                       handle.getLinearAccelerationCovariance()) };
  }
};

template <>
struct Kind<hwi::ForceTorqueSensorHandle>
{
  static hwi::ForceTorqueSensorHandle make(const Record& record)
  {
    return hwi::ForceTorqueSensorHandle(record.name, record.frame_id, at(record.data, 0), at(record.data, 1));
  }
  static Record show(const hwi::ForceTorqueSensorHandle& handle)
  {
    return { handle.getName(), handle.getFrameId(), {}, addresses(handle.getForce(), handle.getTorque()) };
  }
};

template <>
struct Kind<hwi::JointModeHandle>
{
  static hwi::JointModeHandle make(const Record& record)
  {
    return hwi::JointModeHandle(record.name, reinterpret_cast<hwi::JointCommandModes*>(record.data.at(0)));
  }
  static Record show(const hwi::JointModeHandle& handle)
  {
    return { handle.getName(), "", {}, addresses(handle.getModePtr()) };
  }
};

// -- interfaces by name --------------------------------------------------------------------------------------------------------------

/// What is done with an interface that is known by the name of its type only.
struct Interface
{
  std::function<std::shared_ptr<void>(hwi::RobotHW&, std::shared_ptr<void>, const std::vector<Record>&)> fill;
  std::function<std::vector<Record>(hwi::RobotHW&)> show;
};

template <class Handle, class T>
Interface interface_of()
{
  Interface functions;
  functions.fill = [](hwi::RobotHW& robot, std::shared_ptr<void> known, const std::vector<Record>& records) {
    std::shared_ptr<T> interface = known ? std::static_pointer_cast<T>(known) : std::make_shared<T>();
    for (const Record& record : records)
      interface->registerHandle(Kind<Handle>::make(record));
    if (!known)
      robot.registerInterface(interface.get());
    return std::static_pointer_cast<void>(interface);
  };
  functions.show = [](hwi::RobotHW& robot) {
    std::vector<Record> records;
    if (T* interface = robot.get<T>())
      for (const std::string& name : interface->getNames())
        records.push_back(Kind<Handle>::show(interface->hwi::ResourceManager<Handle>::getHandle(name)));  // claims nothing
    return records;
  };
  return functions;
}

template <class Handle, class T>
std::pair<const std::string, Interface> entry()
{
  return { hwi::internal::demangledTypeName<T>(), interface_of<Handle, T>() };
}

const std::map<std::string, Interface>& interfaces()
{
  static const std::map<std::string, Interface> known = {
    entry<hwi::JointStateHandle, hwi::JointStateInterface>(),
    entry<hwi::JointHandle, hwi::PositionJointInterface>(),
    entry<hwi::JointHandle, hwi::VelocityJointInterface>(),
    entry<hwi::JointHandle, hwi::EffortJointInterface>(),
    entry<hwi::JointHandle, hwi::JointCommandInterface>(),
    entry<hwi::PosVelJointHandle, hwi::PosVelJointInterface>(),
    entry<hwi::PosVelAccJointHandle, hwi::PosVelAccJointInterface>(),
    entry<hwi::PositionVelocityTorqueGainsJointHandle, hwi::PositionVelocityTorqueGainsJointInterface>(),
    entry<hwi::JointModeHandle, hwi::JointModeInterface>(),
    entry<hwi::ActuatorStateHandle, hwi::ActuatorStateInterface>(),
    entry<hwi::ActuatorHandle, hwi::PositionActuatorInterface>(),
    entry<hwi::ActuatorHandle, hwi::VelocityActuatorInterface>(),
    entry<hwi::ActuatorHandle, hwi::EffortActuatorInterface>(),
    entry<hwi::ImuSensorHandle, hwi::ImuSensorInterface>(),
    entry<hwi::ForceTorqueSensorHandle, hwi::ForceTorqueSensorInterface>(),
  };
  return known;
}

// -- robots --------------------------------------------------------------------------------------------------------------------------

using Claims = std::vector<std::tuple<std::string, std::vector<std::string>>>;
using Info = std::tuple<std::string, std::string, Claims>;

hwi::ControllerInfo to_info(const Info& info)
{
  hwi::ControllerInfo result;
  std::tie(result.name, result.type, std::ignore) = info;
  for (const auto& claimed : std::get<2>(info))
    result.claimed_resources.emplace_back(std::get<0>(claimed),
                                          std::set<std::string>(std::get<1>(claimed).begin(), std::get<1>(claimed).end()));
  return result;
}

std::list<hwi::ControllerInfo> to_infos(const std::vector<Info>& infos)
{
  std::list<hwi::ControllerInfo> result;
  for (const Info& info : infos)
    result.push_back(to_info(info));
  return result;
}

/// A robot: one of its own, a twin that is filled; or somebody else's.
class Robot
{
public:
  Robot() : own_(std::make_unique<hwi::RobotHW>()), hw_(own_.get()) {}
  Robot(std::uintptr_t address, py::object keeper) : hw_(reinterpret_cast<hwi::RobotHW*>(address)) { keepers_.append(keeper); }

  std::uintptr_t address() const { return reinterpret_cast<std::uintptr_t>(hw_); }
  std::vector<std::string> names() const { return hw_->getNames(); }
  static bool knows(const std::string& type) { return interfaces().count(type) > 0; }

  void fill(const std::string& type, const std::vector<Record>& records, py::object keeper)
  {
    std::shared_ptr<void>& interface = filled_[type];
    interface = interfaces().at(type).fill(*hw_, interface, records);
    keepers_.append(keeper);
  }

  void add_manager(Robot& part, py::object keeper)
  {
    hw_->registerInterfaceManager(part.hw_);
    keepers_.append(keeper);
  }

  std::vector<Record> handles(const std::string& type) const { return interfaces().at(type).show(*hw_); }

  void read(double time, double period) { hw_->read(stamp(time), ros::Duration(period)); }
  void write(double time, double period) { hw_->write(stamp(time), ros::Duration(period)); }
  bool check_for_conflict(const std::vector<Info>& infos) const { return hw_->checkForConflict(to_infos(infos)); }
  bool prepare_switch(const std::vector<Info>& start, const std::vector<Info>& stop)
  {
    return hw_->prepareSwitch(to_infos(start), to_infos(stop));
  }
  void do_switch(const std::vector<Info>& start, const std::vector<Info>& stop)
  {
    hw_->doSwitch(to_infos(start), to_infos(stop));
  }
  int switch_result(const Info* info) const
  {
    return static_cast<int>(info ? hw_->switchResult(to_info(*info)) : hw_->switchResult());
  }

private:
  static ros::Time stamp(double time) { return ros::Time().fromNSec(std::llround(time * 1e9)); }

  std::unique_ptr<hwi::RobotHW> own_;
  hwi::RobotHW* hw_;
  std::map<std::string, std::shared_ptr<void>> filled_;
  py::list keepers_;
};

}  // namespace

PYBIND11_MODULE(_robots, module)
{
  module.doc() = "Robots in both languages.";
  using released = py::call_guard<py::gil_scoped_release>;
  py::class_<Record>(module, "Record")
      .def(py::init<std::string, std::string, Addresses, Addresses>(), py::arg("name"), py::arg("frame_id"), py::arg("state"),
           py::arg("data"))
      .def_readonly("name", &Record::name)
      .def_readonly("frame_id", &Record::frame_id)
      .def_readonly("state", &Record::state)
      .def_readonly("data", &Record::data);
  py::class_<Robot>(module, "Robot")
      .def(py::init<>())
      .def(py::init<std::uintptr_t, py::object>(), py::arg("address"), py::arg("keeper"))
      .def_property_readonly("address", &Robot::address)
      .def("names", &Robot::names)
      .def_static("knows", &Robot::knows, py::arg("type"))
      .def("fill", &Robot::fill, py::arg("type"), py::arg("records"), py::arg("keeper"))
      .def("add_manager", &Robot::add_manager, py::arg("part"), py::arg("keeper"))
      .def("handles", &Robot::handles, py::arg("type"))
      .def("read", &Robot::read, py::arg("time"), py::arg("period"), released())
      .def("write", &Robot::write, py::arg("time"), py::arg("period"), released())
      .def("check_for_conflict", &Robot::check_for_conflict, py::arg("infos"), released())
      .def("prepare_switch", &Robot::prepare_switch, py::arg("start"), py::arg("stop"), released())
      .def("do_switch", &Robot::do_switch, py::arg("start"), py::arg("stop"))
      .def(
          "switch_result",
          [](const Robot& robot, const py::object& info) {
            if (info.is_none())
              return robot.switch_result(nullptr);
            const Info converted = info.cast<Info>();
            return robot.switch_result(&converted);
          },
          py::arg("info"));
}
