#include "topics.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include <gazebo/common/common.hh>

#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

namespace
{

constexpr double pose_period = 1.0 / 60, stats_period = 0.2;  // s of the wall's clock

bool among(const std::vector<std::string>& names, const Collision& collision)
{
  return std::find(names.begin(), names.end(), collision.GetScopedName()) != names.end();
}

}  // namespace

Topics::Topics(const std::string& world) : node_(new transport::Node)
{
  node_->Init(world);
  contacts_ = node_->Advertise<msgs::Contacts>("~/physics/contacts");
  poses_ = node_->Advertise<msgs::PosesStamped>("~/pose/info");
  local_poses_ = node_->Advertise<msgs::PosesStamped>("~/pose/local/info");
  stats_ = node_->Advertise<msgs::WorldStatistics>("~/world_stats");
  models_ = node_->Advertise<msgs::Model>("~/model/info");
  responses_ = node_->Advertise<msgs::Response>("~/response");
  factory_ = node_->Subscribe("~/factory", &Topics::onFactory, this);
  control_ = node_->Subscribe("~/world_control", &Topics::onControl, this);
  request_ = node_->Subscribe("~/request", &Topics::onRequest, this);
  std::thread([this] { whilePaused(); }).detach();
}

/// No step publishes then, and who asks is to see that it is paused.
void Topics::whilePaused()
{
  while (true)
  {
    std::this_thread::sleep_for(std::chrono::duration<double>(stats_period));
    const WorldPtr world = Mirror::Get().GetWorld();
    if (!world || !world->IsPaused() ||
        !(stats_->HasConnections() || poses_->HasConnections() || local_poses_->HasConnections()))
      continue;
    const boost::recursive_mutex::scoped_lock lock(step_mutex());
    const common::Time now = common::Time::GetWallTime();
    publishPoses(*world, now);
    publishStats(*world, now);
  }
}

void Topics::AddFilter(const std::string& topic, const std::vector<std::string>& collisions)
{
  filters_[topic] = { collisions, node_->Advertise<msgs::Contacts>(topic), topic };
}

void Topics::RemoveFilter(const std::string& topic) { filters_.erase(topic); }

void Topics::publishContacts(World& world)
{
  const bool all = contacts_->HasConnections();
  const bool some =
      std::any_of(filters_.begin(), filters_.end(), [](const auto& f) { return f.second.publisher->HasConnections(); });
  if (!all && !some)
    return;
  const std::vector<Contact*>& contacts = world.Physics()->GetContactManager()->GetContacts();
  const auto send = [&](const transport::PublisherPtr& publisher, const std::vector<std::string>* names) {
    msgs::Contacts message;
    msgs::Set(message.mutable_time(), world.SimTime());
    for (const Contact* contact : contacts)
      if (!names || among(*names, *contact->collision1) || among(*names, *contact->collision2))
        contact->FillMsg(*message.add_contact());
    publisher->Publish(message);
  };
  if (all)
    send(contacts_, nullptr);
  for (const auto& filter : filters_)
    if (filter.second.publisher->HasConnections())
      send(filter.second.publisher, &filter.second.collisions);
}

void Topics::publishPoses(World& world, const common::Time& now)
{
  if ((now - last_poses_).Double() < pose_period || !(poses_->HasConnections() || local_poses_->HasConnections()))
    return;
  last_poses_ = now;
  msgs::PosesStamped message;
  msgs::Set(message.mutable_time(), world.SimTime());
  const auto add = [&](const Entity& entity) {
    msgs::Pose& pose = *message.add_pose();
    pose.set_name(entity.GetScopedName());
    pose.set_id(entity.GetId());
    msgs::Set(&pose, entity.RelativePose());
  };
  for (const ModelPtr& model : world.Models())
  {
    add(*model);
    for (const LinkPtr& link : model->GetLinks())
      add(*link);
  }
  poses_->Publish(message);
  local_poses_->Publish(message);
}

void Topics::TellOf(Model& model)
{
  if (!models_->HasConnections())
    return;
  msgs::Model message;
  model.FillMsg(message);
  models_->Publish(message);
}

void Topics::Publish(World& world)
{
  publishContacts(world);
  const common::Time now = common::Time::GetWallTime();
  publishPoses(world, now);
  publishStats(world, now);
}

void Topics::publishStats(World& world, const common::Time& now)
{
  if ((now - last_stats_).Double() < stats_period || !stats_->HasConnections())
    return;
  last_stats_ = now;
  msgs::WorldStatistics message;
  msgs::Set(message.mutable_sim_time(), world.SimTime());
  msgs::Set(message.mutable_real_time(), world.RealTime());
  msgs::Set(message.mutable_pause_time(), world.PauseTime());
  message.set_iterations(world.Iterations());
  message.set_paused(world.IsPaused());
  message.set_model_count(static_cast<int>(world.ModelCount()));
  stats_->Publish(message);
}

std::string model_file(const std::string& file)
{
  if (file.find("://") != std::string::npos)
    return "<sdf version='1.6'><include><uri>" + file + "</uri></include></sdf>";
  std::ifstream in(common::SystemPaths::Instance()->FindFile(file));
  if (!in)
    refused("no file " + file + " of a model that is to be inserted");
  std::ostringstream text;
  text << in.rdbuf();
  return in ? text.str() : "";
}

void Topics::onFactory(ConstFactoryPtr& message)
{
  std::vector<double> pose;
  if (message->has_pose())
  {
    const auto& p = message->pose().position();
    const auto& q = message->pose().orientation();
    pose = { p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w() };
  }
  if (!message->has_sdf() && !message->has_sdf_filename())
    return refused("~/factory: only models as sdf or sdf_filename can be inserted");
  const std::string text = message->has_sdf() ? message->sdf() : model_file(message->sdf_filename());
  if (Mirror::Get().host.insert && !text.empty())
    Mirror::Get().host.insert(text, pose);
}

void Topics::onControl(ConstWorldControlPtr& message)
{
  const WorldPtr world = Mirror::Get().GetWorld();
  if (message->has_pause())
    world->SetPaused(message->pause());
  if (message->has_step())
    world->Step(1);
  if (message->has_multi_step())
    world->Step(message->multi_step());
  if (message->has_seed())
    world->Physics()->SetSeed(message->seed());
  if (!message->has_reset())
    return;
  if (message->reset().time_only())
    world->ResetTime();
  else if (message->reset().model_only())
    world->ResetEntities(Base::MODEL);
  else
    world->Reset();
}

void Topics::respond(const msgs::Request& request, const google::protobuf::Message* message)
{
  msgs::Response response;
  response.set_id(request.id());
  response.set_request(request.request());
  response.set_response(message ? "success" : "nonexistent");
  if (message)
  {
    response.set_type(message->GetTypeName());
    response.set_serialized_data(message->SerializeAsString());
  }
  responses_->Publish(response);
}

void Topics::onRequest(ConstRequestPtr& message)
{
  const WorldPtr world = Mirror::Get().GetWorld();
  const std::string& what = message->request();
  if (what == "entity_delete")
  {
    world->RemoveModel(message->data());
    return respond(*message, message.get());
  }
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  msgs::Model_V list;
  msgs::Model model;
  msgs::Link link;
  const BasePtr found = what == "entity_info" ? world->BaseByName(message->data()) : BasePtr();
  if (what == "entity_list")
  {
    for (const ModelPtr& each : world->Models())
      each->FillMsg(*list.add_models());
    respond(*message, &list);
  }
  else if (const ModelPtr known = what == "entity_info" ? world->ModelByName(message->data()) : ModelPtr())
  {
    known->FillMsg(model);
    respond(*message, &model);
  }
  else if (const LinkPtr part = boost::dynamic_pointer_cast<Link>(found))
  {
    part->FillMsg(link);
    respond(*message, &link);
  }
  else if (what == "entity_info")
    respond(*message, nullptr);
}

}  // namespace physics
}  // namespace gazebo
