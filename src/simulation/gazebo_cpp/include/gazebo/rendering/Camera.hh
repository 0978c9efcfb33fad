// A camera of a sensor: where it looks, and its newest picture. What it sees is drawn in a process beside the simulator.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <boost/enable_shared_from_this.hpp>
#include <boost/weak_ptr.hpp>
#include <ignition/math/Angle.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector2.hh>
#include <sdf/sdf.hh>

#include <gazebo/common/Event.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/rendering/Distortion.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/transport/transport.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace rendering
{

/// What was drawn for one camera; valid while it is handed over.
struct Picture
{
  const unsigned char* image = nullptr;
  std::size_t image_bytes = 0;
  const float* depth = nullptr;  // m along the axis of the camera; where nothing is, the far clip distance
  std::size_t depth_count = 0;
  ignition::math::Pose3d X_WC;  // of the camera, when it was taken
};

/// Looks along +x, with +y to the left. Its sensor takes its pictures; callbacks run in the thread of the pictures, beside the steps.
class GAZEBO_VISIBLE Camera : public boost::enable_shared_from_this<Camera>
{
  using Pose3d = ignition::math::Pose3d;
  using Vector3d = ignition::math::Vector3d;

public:
  typedef void NewFrame(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&);

  Camera(const std::string& name, ScenePtr scene, bool auto_render = true);
  virtual ~Camera();
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;
  virtual void Load(sdf::ElementPtr sdf);  // <camera>. \throws std::runtime_error a size that no picture has
  virtual void Load() {}
  virtual void Init() {}
  virtual void Fini() {}
  bool Initialized() const { return true; }
  std::string Name() const { return name_; }
  std::string ScopedName() const;
  ScenePtr GetScene() const { return scene_; }

  unsigned int ImageWidth() const { return view().width; }
  unsigned int ImageHeight() const { return view().height; }
  unsigned int TextureWidth() const { return ImageWidth(); }
  unsigned int TextureHeight() const { return ImageHeight(); }
  unsigned int ViewportWidth() const { return ImageWidth(); }
  unsigned int ViewportHeight() const { return ImageHeight(); }
  unsigned int ImageDepth() const { return bytesOf(format_); }  // bytes of a pixel
  std::string ImageFormat() const { return format_; }           // as <format> says
  std::size_t ImageByteSize() const { return ImageByteSize(ImageWidth(), ImageHeight(), format_); }
  static std::size_t ImageByteSize(unsigned int width, unsigned int height, const std::string& format);
  ignition::math::Angle HFOV() const { return ignition::math::Angle(view().hfov); }
  ignition::math::Angle VFOV() const;
  void SetHFOV(const ignition::math::Angle& angle);
  double NearClip() const { return view().near; }
  double FarClip() const { return view().far; }
  void SetClipDist(float near, float far);
  float AspectRatio() const { return static_cast<float>(ImageWidth()) / static_cast<float>(ImageHeight()); }
  void SetImageSize(unsigned int width, unsigned int height);
  void SetImageWidth(unsigned int width) { SetImageSize(width, ImageHeight()); }
  void SetImageHeight(unsigned int height) { SetImageSize(ImageWidth(), height); }
  double RenderRate() const;  // Hz, its sensor's; infinite where that measures in each step
  void SetRenderRate(double hz) { rate_ = hz; }
  float AvgFPS() const { return static_cast<float>(rate_); }
  DistortionPtr LensDistortion() const { return lens_; }

  Pose3d WorldPose() const;  // now; in a callback that of the picture
  Vector3d WorldPosition() const { return WorldPose().Pos(); }
  ignition::math::Quaterniond WorldRotation() const { return WorldPose().Rot(); }
  Vector3d Direction() const { return WorldRotation().RotateVector(Vector3d::UnitX); }
  Vector3d Up() const { return WorldRotation().RotateVector(Vector3d::UnitZ); }
  Vector3d Right() const { return WorldRotation().RotateVector(Vector3d(0, -1, 0)); }
  void SetWorldPose(const Pose3d& X_WC);  // from there it moves with its link
  void SetWorldPosition(const Vector3d& p_W) { SetWorldPose(Pose3d(p_W, WorldRotation())); }
  void SetWorldRotation(const ignition::math::Quaterniond& q) { SetWorldPose(Pose3d(WorldPosition(), q)); }
  ignition::math::Vector2i Project(const Vector3d& p_W) const;  // column, row
  void CameraToViewportRay(int column, int row, Vector3d& origin, Vector3d& direction) const;

  event::ConnectionPtr ConnectNewImageFrame(std::function<NewFrame> subscriber);
  virtual const unsigned char* ImageData(unsigned int index = 0) const;  // the newest picture; null before the first one
  void SetCaptureData(bool capture) { capture_ = capture; }
  bool CaptureData() const { return capture_; }
  void SetCaptureDataOnce() { once_ = true; }  // the next picture goes to a file
  void EnableSaveFrame(bool enable) { save_ = enable; }
  void SetSaveFramePathname(const std::string& folder);
  bool SaveFrame(const std::string& file);  // of the newest picture
  static bool SaveFrame(const unsigned char* image, unsigned int width, unsigned int height, int depth,
                        const std::string& format, const std::string& file);
  virtual void Render(bool force = false);  // a picture in the next step, whatever the rate
  virtual void PostRender() {}
  virtual void Update() {}

  // For its sensor:

  struct View
  {
    ignition::math::Pose3d X_LC;  // in its link
    double hfov = 1.047, near = 0.1, far = 100;
    unsigned int width = 320, height = 240;
  };
  View view() const;
  /// While it lives, WorldPose() and the scene's SimTime() are in this thread those of a picture.
  struct GAZEBO_VISIBLE During
  {
    During(const Camera& camera, const ignition::math::Pose3d& X_WC, int64_t time_ns);
    ~During();
    static const int64_t* Time();  // null: none lives
  };
  void Mount(const physics::LinkPtr& link, const Pose3d& X_LS);
  Pose3d MountedPose() const;  // in the world, now
  /// Outputs of the process that draws that somebody waits for.
  /// \param awaited somebody waits for the sensor's measurements
  virtual std::vector<std::string> Wanted(bool awaited) const;
  bool TakeAsked() { return asked_.exchange(false); }
  virtual void Develop(const Picture& picture);

protected:
  static unsigned int bytesOf(const std::string& format);
  bool capturing() const { return capture_ || once_; }

  sdf::ElementPtr sdf;
  std::string format_ = "R8G8B8";

private:
  void change(const std::function<void(View&)>& f);
  std::string fileName();

  std::string name_, folder_ = "/tmp";
  ScenePtr scene_;
  boost::weak_ptr<physics::Link> link_;
  DistortionPtr lens_;
  mutable std::mutex mutex_;
  View view_;
  std::vector<unsigned char> buffers_[2];  // in turn, so that what ImageData() gave stays for one picture more
  std::atomic<const unsigned char*> newest_{ nullptr };
  bool second_ = false;
  std::atomic<bool> capture_{ true }, once_{ false }, save_{ false }, asked_{ false };
  mutable std::atomic<bool> polled_{ false };
  std::atomic<double> rate_{ 0 };
  unsigned int saved_ = 0;
  event::EventT<NewFrame> frames_;
};

}  // namespace rendering
}  // namespace gazebo
