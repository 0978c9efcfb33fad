#pragma once
#include <atomic>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// What sensors with cameras share. A picture is asked for after the step in which it is due, while the sensor is active (<always_on>,
/// SetActive()) or somebody listens to its topic, and somebody looks: is connected to new frames, asks for image data or for measurements.
/// It comes from the process that draws: later, in the thread of the pictures; in lock-step before the step ends.
class GAZEBO_VISIBLE PictureSensor : public Sensor
{
public:
  PictureSensor();
  ~PictureSensor() override;
  using Sensor::Load;
  void Fini() override;
  bool IsActive() const override;
  void Update(bool force) override;  // a picture in the next step, whatever the rate
  void Step(int64_t now_ns) override;
  void Restart() override;
  void SetUpdateRate(double hz) override;
  common::Time LastUpdateTime() const override { return LastMeasurementTime(); }
  common::Time LastMeasurementTime() const override;  // of the newest picture

  /// For the simulator: the picture of a camera, by the number that it was asked for with. Not in the thread of the steps.
  static void Arrived(int number, int64_t time_ns, rendering::Picture picture);
  /// While it lives, no callback of a picture runs in another thread. Waits for one that blocks no longer than a few seconds.
  class GAZEBO_VISIBLE Still
  {
  public:
    Still();
    ~Still();
    Still(const Still&) = delete;
    Still& operator=(const Still&) = delete;

  private:
    bool held_;
  };

protected:
  void Measure() override;
  bool UpdateImpl(bool) override { return false; }
  void addCamera(const rendering::CameraPtr& camera, const sdf::ElementPtr& element);
  rendering::CameraPtr camera(std::size_t index) const;
  std::size_t cameraCount() const { return cameras_.size(); }
  virtual void publish(int64_t time_ns) = 0;  // all pictures of that time have come

private:
  struct Taken
  {
    std::size_t camera;
    int64_t time_ns;
    ignition::math::Pose3d X_WC;
  };
  void take(bool awaited);
  bool ask(std::size_t index, const std::vector<std::string>& outputs);
  bool forget(std::size_t index, int64_t time_ns, ignition::math::Pose3d* X_WC = nullptr);
  void arrived(std::size_t index, int64_t time_ns, rendering::Picture& picture);
  void finish(int64_t time_ns);

  std::vector<rendering::CameraPtr> cameras_;
  std::vector<int> numbers_;
  std::atomic<bool> asked_{ false }, ended_{ false };
  std::atomic<int64_t> measured_ns_{ 0 };
  int64_t told_ns_ = -1;
  std::mutex mutex_;
  std::deque<Taken> taken_;  // pictures on their way
};

/// The picture of a camera as a message.
GAZEBO_VISIBLE void fill(const rendering::Camera& camera, msgs::Image& message);

}  // namespace sensors
}  // namespace gazebo
