// A program beside the simulator: hears what is on topics of Gazebo's transport, and says a number to the plugins.
#include <gazebo/gazebo_client.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/transport/transport.hh>

#include <cstdlib>
#include <cstring>
#include <iostream>

void on_stats(ConstWorldStatisticsPtr& message)
{
  std::cout << "stats " << message->iterations() << (message->paused() ? " paused" : "") << std::endl;
}

void on_go(ConstIntPtr& message) { std::cout << "go " << message->data() << std::endl; }

int main(int argc, char** argv)
{
  if (!gazebo::client::setup(argc, argv))
    return 3;
  gazebo::transport::NodePtr node(new gazebo::transport::Node());
  node->Init();
  if (argc > 2 && !std::strcmp(argv[1], "say"))
  {
    const gazebo::transport::PublisherPtr publisher = node->Advertise<gazebo::msgs::Int>("~/go");
    publisher->WaitForConnection();
    gazebo::msgs::Int message;
    message.set_data(std::atoi(argv[2]));
    publisher->Publish(message);
    return gazebo::client::shutdown() ? 0 : 4;
  }
  const gazebo::transport::SubscriberPtr stats = node->Subscribe("~/world_stats", on_stats);
  const gazebo::transport::SubscriberPtr go = node->Subscribe("~/go", on_go, true);
  std::cout << "listening" << std::endl;
  while (true)
    gazebo::common::Time::MSleep(10);
}
