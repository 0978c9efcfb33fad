// What the simulator and gz tell and ask the transport.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace transport
{
GAZEBO_VISIBLE void set_world(const std::string& name);  // what "~" stands for
GAZEBO_VISIBLE bool wanted(const std::string& topic);    // somebody listens

/// Be the master at GAZEBO_MASTER_URI. \param first called once, in a thread of its own kind, when somebody asks for the first time;
/// who asks waits a little for ready(). \return what is wrong, in words, or ""
GAZEBO_VISIBLE std::string serve(const std::string& world, std::function<void()> first);
GAZEBO_VISIBLE void ready();

/// Become a client of it. \param tries s \return what is wrong, in words, or ""
GAZEBO_VISIBLE std::string join(unsigned int tries);

// For clients.
struct TopicDescription
{
  std::string type;
  std::vector<std::string> publishers, subscribers;  // host:port
};
GAZEBO_VISIBLE std::vector<std::string> topic_names();
GAZEBO_VISIBLE TopicDescription describe_topic(const std::string& topic);

/// Bytes of a message, for people. Of a type that is not known here: its fields by their numbers.
GAZEBO_VISIBLE std::string message_text(const std::string& type, const std::string& bytes, bool in_one_line);
}  // namespace transport
}  // namespace gazebo
