// What the simulator itself publishes and takes on topics of the transport.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo
{
namespace physics
{

class Topics
{
public:
  explicit Topics(const std::string& world);
  void Publish(World& world);  // after a step
  void TellOf(Model& model);   // that is new
  void AddFilter(const std::string& topic, const std::vector<std::string>& collisions);
  void RemoveFilter(const std::string& topic);

private:
  void publishContacts(World& world);
  void publishPoses(World& world, const common::Time& now);
  void publishStats(World& world, const common::Time& now);
  void whilePaused();
  void respond(const msgs::Request& request, const google::protobuf::Message* message);
  void onFactory(ConstFactoryPtr& message);
  void onControl(ConstWorldControlPtr& message);
  void onRequest(ConstRequestPtr& message);

  struct Filter
  {
    std::vector<std::string> collisions;
    transport::PublisherPtr publisher;
    std::string topic;
  };
  transport::NodePtr node_;
  transport::PublisherPtr contacts_, poses_, local_poses_, stats_, models_, responses_;
  transport::SubscriberPtr factory_, control_, request_;
  std::map<std::string, Filter> filters_;
  common::Time last_poses_, last_stats_;
};

/// A model's file as text, by its path or by a URI as model://table; empty, and told, where there is none.
std::string model_file(const std::string& file);

}  // namespace physics
}  // namespace gazebo
