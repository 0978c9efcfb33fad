// What cameras see of the world.
#pragma once
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <boost/weak_ptr.hpp>

#include <gazebo/common/Time.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/util/system.hh>
#include <gazebo/common/common.hh>
#include <gazebo/rendering/Visual.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace rendering
{

class GAZEBO_VISIBLE Scene
{
public:
  explicit Scene(const std::string& name) : name_(name) {}
  virtual ~Scene();
  std::string Name() const { return name_; }
  common::Time SimTime() const;  // in a callback of a picture, its time
  VisualPtr WorldVisual() const { return VisualPtr(); }
  VisualPtr GetVisual(const std::string& name) const;  // model, model::link or model::link::visual; null: there is none
  VisualPtr GetVisual(uint32_t id) const;
  uint32_t VisualCount() const;
  void AddVisual(VisualPtr visual);
  void RemoveVisual(VisualPtr visual);
  uint32_t CameraCount() const { return static_cast<uint32_t>(cameras().size()); }
  CameraPtr GetCamera(uint32_t index) const;
  CameraPtr GetCamera(const std::string& name) const;

  void Add(const CameraPtr& camera);  // for its sensor

private:
  std::vector<CameraPtr> cameras() const;
  std::string name_;
  mutable std::mutex mutex_;
  std::vector<boost::weak_ptr<Camera>> cameras_;
};

}  // namespace rendering
}  // namespace gazebo
