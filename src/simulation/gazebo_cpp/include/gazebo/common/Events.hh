#pragma once
#include <string>

#include <sdf/sdf.hh>

#include <gazebo/common/Console.hh>
#include <gazebo/common/Event.hh>
#include <gazebo/common/UpdateInfo.hh>

namespace gazebo
{
namespace event
{

class GAZEBO_VISIBLE Events
{
public:
#define GZ_EVENT(name, Name, type)                 \
  static EventT<type>& name;                       \
  template <typename T>                            \
  static ConnectionPtr Connect##Name(T subscriber) \
  {                                                \
    return name.Connect(subscriber);               \
  }                                                \
  static void Disconnect##Name(ConnectionPtr connection) { name.Disconnect(connection); }

  GZ_EVENT(pause, Pause, void(bool))
  GZ_EVENT(step, Step, void())
  GZ_EVENT(stop, Stop, void())
  GZ_EVENT(sigInt, SigInt, void())
  GZ_EVENT(worldCreated, WorldCreated, void(std::string))
  GZ_EVENT(entityCreated, CreateEntity, void(std::string))
  GZ_EVENT(setSelectedEntity, SetSelectedEntity, void(std::string, std::string))
  GZ_EVENT(addEntity, AddEntity, void(std::string))
  GZ_EVENT(deleteEntity, DeleteEntity, void(std::string))
  GZ_EVENT(worldUpdateBegin, WorldUpdateBegin, void(const common::UpdateInfo&))
  GZ_EVENT(beforePhysicsUpdate, BeforePhysicsUpdate, void(const common::UpdateInfo&))
  GZ_EVENT(worldUpdateEnd, WorldUpdateEnd, void())
  GZ_EVENT(worldReset, WorldReset, void())
  GZ_EVENT(timeReset, TimeReset, void())
  GZ_EVENT(preRender, PreRender, void())
  GZ_EVENT(preRenderEnded, PreRenderEnded, void())
  GZ_EVENT(render, Render, void())
  GZ_EVENT(postRender, PostRender, void())
  GZ_EVENT(diagTimerStart, DiagTimerStart, void(std::string))
  GZ_EVENT(diagTimerStop, DiagTimerStop, void(std::string))
  GZ_EVENT(removeSensor, RemoveSensor, void(std::string))
#undef GZ_EVENT
};

}  // namespace event
}  // namespace gazebo
