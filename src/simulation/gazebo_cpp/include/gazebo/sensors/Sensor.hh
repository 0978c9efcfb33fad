// The part that all sensors share: what it is, where it is, and when it measures.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <boost/weak_ptr.hpp>
#include <ignition/math/Pose3.hh>
#include <sdf/sdf.hh>

#include <gazebo/common/Event.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/msgs/MessageTypes.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/sensors/Noise.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/transport/TransportTypes.hh>
#include <gazebo/common/common.hh>
#include <gazebo/rendering/RenderTypes.hh>

namespace gazebo
{
namespace sensors
{

/// A sensor of a link, or of a joint (force_torque). It measures after a step, at <update_rate> of sim time, while somebody wants it: who has asked for it, while it
/// is active (<always_on> makes it so) or somebody is connected to it, or who listens to its topic. Whoever has a pointer to one removed may go on to ask it.
class GAZEBO_VISIBLE Sensor : public std::enable_shared_from_this<Sensor>
{
public:
  explicit Sensor(SensorCategory category);
  virtual ~Sensor();
  virtual void Load(const std::string& world, sdf::ElementPtr sdf);
  virtual void Load(const std::string& world);
  virtual void Init() {}
  virtual void Fini();
  void SetParent(const std::string& name, uint32_t id) { parentName = name, parentId = id; }
  void SetLink(const physics::LinkPtr& link) { link_ = link; }
  virtual void Update(bool force);  // now, if it is due or forced
  virtual void Step(int64_t now_ns);
  virtual void Restart();  // time has gone back

  std::string Name() const { return name_; }
  std::string ScopedName() const;                        // world::model::link::sensor, or ...::joint::sensor
  std::string ParentName() const { return parentName; }  // model::link
  uint32_t ParentId() const { return parentId; }
  uint32_t Id() const { return id_; }
  std::string Type() const { return type_; }
  std::string WorldName() const { return world_; }
  SensorCategory Category() const { return category_; }
  bool Visualize() const { return visualize_; }
  virtual std::string Topic() const { return topic_; }
  virtual ignition::math::Pose3d Pose() const { return pose; }  // in the link
  virtual void SetPose(const ignition::math::Pose3d& X_LS) { pose = X_LS; }
  double UpdateRate() const { return rate_; }
  virtual void SetUpdateRate(double hz);
  virtual void SetActive(bool on) { active = on; }
  virtual bool IsActive() const;
  virtual common::Time LastUpdateTime() const { return lastUpdateTime; }
  virtual common::Time LastMeasurementTime() const { return lastMeasurementTime; }
  void ResetLastUpdateTime() { Restart(); }
  event::ConnectionPtr ConnectUpdated(std::function<void()> subscriber) { return updated_.Connect(subscriber); }
  NoisePtr Noise(SensorNoiseType type) const;
  void FillMsg(msgs::Sensor& message);
  const sdf::ElementPtr Element() const { return sdf; }

protected:
  virtual void Measure() { Update(true); }
  virtual bool UpdateImpl(bool force) = 0;  // measure
  bool awaited() const { return updated_.ConnectionCount(); }
  void tell() { updated_(); }                          // that it has measured
  bool listened() const;                               // to its topic
  std::string topicOf(const std::string& end) const;   // what <topic> says, or
  std::string ownTopic(const std::string& end) const;  // what is made of its names
  ignition::math::Pose3d worldPose() const;
  ignition::math::Vector3d velocity() const;  // of the sensor's origin, world axes, m/s
  NoisePtr noiseFrom(const sdf::ElementPtr& parent, SensorNoiseType type);
  double sinceLast() const { return dt_; }  // s since the measurement before
  physics::LinkPtr link() const { return link_.lock(); }

  bool active = false;
  sdf::ElementPtr sdf;
  ignition::math::Pose3d pose;
  transport::NodePtr node;
  std::string parentName;
  uint32_t parentId = 0;
  common::Time lastUpdateTime, lastMeasurementTime;
  std::map<SensorNoiseType, NoisePtr> noises;
  std::string topic_;
  transport::PublisherPtr publisher_;  // of its topic

private:
  friend class SensorManager;
  bool due(int64_t now_ns);
  void take(int64_t now_ns);
  SensorCategory category_;
  uint32_t id_;
  std::string name_, type_, world_;
  bool visualize_ = false;
  std::atomic<bool> known_{ false };  // somebody has asked for it
  double rate_ = 0, dt_ = 0;
  int64_t period_ns_ = 0, last_ns_ = 0, late_ns_ = 0;
  boost::weak_ptr<physics::Link> link_;
  event::EventT<void()> updated_;
};

}  // namespace sensors
}  // namespace gazebo
