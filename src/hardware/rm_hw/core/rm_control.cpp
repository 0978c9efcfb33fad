// What controllers of the package rm_common's interfaces find in this robot, beside the standard ones.
//
// Their headers are not here: a robot is asked for an interface by the name of its C++ type, and hands it out as a bare pointer. So
// these types have the names, the members in their order and the bases of those in rm_common; the methods of the handles are compiled
// into whoever calls them.
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include <hardware_interface/imu_sensor_interface.h>
#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/robot_hw.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace tf2_ros
{
class Buffer;
}

namespace rm_control
{

/// The frames of the robot: a controller (robot_state_controller) adds the one handle.
struct RobotStateHandle
{
  std::string getName() const { return name; }
  std::string name;
  tf2_ros::Buffer* buffer = nullptr;
};
class RobotStateInterface
  : public hardware_interface::HardwareResourceManager<RobotStateHandle, hardware_interface::DontClaimResources>
{
};

/// What calibration needs of a motor.
struct ActuatorExtraHandle
{
  std::string getName() const { return name; }
  std::string name;
  bool *halted = nullptr, *need_calibration = nullptr, *calibrated = nullptr, *calibration_reading = nullptr;
  double *position = nullptr, *offset = nullptr;
};
class ActuatorExtraInterface
  : public hardware_interface::HardwareResourceManager<ActuatorExtraHandle, hardware_interface::ClaimResources>
{
};

/// An IMU with the time of its sample.
struct RmImuSensorHandle : hardware_interface::ImuSensorHandle
{
  RmImuSensorHandle() = default;
  RmImuSensorHandle(const hardware_interface::ImuSensorHandle& imu, ros::Time* stamp) : ImuSensorHandle(imu), time_stamp(stamp)
  {
  }
  ros::Time* time_stamp = nullptr;
};
class RmImuSensorInterface
  : public hardware_interface::HardwareResourceManager<RmImuSensorHandle, hardware_interface::DontClaimResources>
{
};

/// Pins of a computer that has some; here there are none.
struct GpioHandle
{
  std::string getName() const { return name; }
  std::string name;
  int type = 0;
  bool* value = nullptr;
};
struct GpioStateHandle : GpioHandle
{
};
struct GpioCommandHandle : GpioHandle
{
};
class GpioStateInterface
  : public hardware_interface::HardwareResourceManager<GpioStateHandle, hardware_interface::DontClaimResources>
{
};
class GpioCommandInterface
  : public hardware_interface::HardwareResourceManager<GpioCommandHandle, hardware_interface::ClaimResources>
{
};

}  // namespace rm_control

namespace
{

namespace py = pybind11;

/// A motor's numbers in memory that does not move.
struct Motor
{
  bool halted = true, need_calibration = false, calibrated = false, calibration_reading = false;
  double position = 0.0, offset = 0.0;  // rad
};

struct Stamp
{
  void set(double seconds) { time = ros::Time().fromNSec(static_cast<std::uint64_t>(seconds * 1e9)); }
  ros::Time time;
};

class Interfaces
{
public:
  Interfaces()
  {
    robot_.registerInterface(&frames_);
    robot_.registerInterface(&motors_);
    robot_.registerInterface(&imus_);
    robot_.registerInterface(&pins_);
    robot_.registerInterface(&pin_commands_);
  }

  std::uintptr_t address() const { return reinterpret_cast<std::uintptr_t>(&robot_); }

  /// \return what the handle shows, to be kept up to date
  std::shared_ptr<Motor> add_motor(const std::string& name)
  {
    const auto motor = std::make_shared<Motor>();
    kept_.push_back(motor);
    rm_control::ActuatorExtraHandle handle;
    handle.name = name;
    handle.halted = &motor->halted;
    handle.need_calibration = &motor->need_calibration;
    handle.calibrated = &motor->calibrated;
    handle.calibration_reading = &motor->calibration_reading;
    handle.position = &motor->position;
    handle.offset = &motor->offset;
    motors_.registerHandle(handle);
    return motor;
  }

  /// \param data where orientation, its covariance, angular velocity, ..., linear acceleration, ... are
  std::shared_ptr<Stamp> add_imu(const std::string& name, const std::string& frame_id, const std::vector<std::uintptr_t>& data)
  {
    const auto stamp = std::make_shared<Stamp>();
    kept_.push_back(stamp);
    const auto at = [&](std::size_t i) { return reinterpret_cast<double*>(data.at(i)); };
    imus_.registerHandle(
        { hardware_interface::ImuSensorHandle(name, frame_id, at(0), at(1), at(2), at(3), at(4), at(5)), &stamp->time });
    return stamp;
  }

private:
  hardware_interface::RobotHW robot_;
  rm_control::RobotStateInterface frames_;
  rm_control::ActuatorExtraInterface motors_;
  rm_control::RmImuSensorInterface imus_;
  rm_control::GpioStateInterface pins_;
  rm_control::GpioCommandInterface pin_commands_;
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace

PYBIND11_MODULE(_rm_control, module)
{
  module.doc() = "Interfaces of rm_common for compiled controllers.";
  py::class_<Motor, std::shared_ptr<Motor>>(module, "Motor")
      .def_readwrite("halted", &Motor::halted)
      .def_readwrite("need_calibration", &Motor::need_calibration)
      .def_readwrite("calibrated", &Motor::calibrated)
      .def_readwrite("calibration_reading", &Motor::calibration_reading)
      .def_readwrite("position", &Motor::position)
      .def_readwrite("offset", &Motor::offset);
  py::class_<Stamp, std::shared_ptr<Stamp>>(module, "Stamp").def("set", &Stamp::set, py::arg("seconds"));
  py::class_<Interfaces>(module, "Interfaces")
      .def(py::init<>())
      .def_property_readonly("address", &Interfaces::address)
      .def("add_motor", &Interfaces::add_motor, py::arg("name"))
      .def("add_imu", &Interfaces::add_imu, py::arg("name"), py::arg("frame_id"), py::arg("data"));
}
