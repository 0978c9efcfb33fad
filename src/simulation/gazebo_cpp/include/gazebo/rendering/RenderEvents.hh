#pragma once
#include <string>

#include <gazebo/common/Event.hh>

namespace gazebo
{
namespace rendering
{

class GAZEBO_VISIBLE Events
{
public:
  static event::EventT<void(const std::string&)>& createScene;  // when the first camera comes
  static event::EventT<void(const std::string&)>& removeScene;
  template <typename T>
  static event::ConnectionPtr ConnectCreateScene(T subscriber)
  {
    return createScene.Connect(subscriber);
  }
  template <typename T>
  static event::ConnectionPtr ConnectRemoveScene(T subscriber)
  {
    return removeScene.Connect(subscriber);
  }
};

}  // namespace rendering
}  // namespace gazebo
