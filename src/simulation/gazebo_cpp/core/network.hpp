// Topics between processes, as the original has them: a master at GAZEBO_MASTER_URI knows who publishes what; subscribers connect to the
// publishers themselves. One thread does all of it and waits for nobody; without serve() or join() there is none.
#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/msgs/msgs.hh>

#include "master.hpp"
#include "post.hpp"
#include "wire.hpp"

struct pollfd;

namespace gazebo
{
namespace transport
{

/// \return whether the data is a whole message
template <typename M>
bool ReadMessage(M& message, const std::string& data)
{
  return message.ParsePartialFromString(data) && message.IsInitialized();
}

class Network
{
public:
  static Network& Get();  // left where it is at the end

  /// Be the master. \param first called once, in the thread of the network, when another process asks for the first time; it is not
  /// answered before Ready(), or a few seconds. \return why not, in words, or ""
  std::string Serve(const std::string& world, unsigned int port, std::function<void()> first);
  void Ready();

  /// Become a client of a master. \param tries seconds that it may take to be there. \return why not, in words, or ""
  std::string Join(const std::string& host, unsigned int port, unsigned int tries);

  bool Running() const { return running_; }
  bool Client() const { return running_ && !serves_; }
  void Refresh(const std::string& topic);  // this process has begun or ended to publish or to hear it
  void Send(const std::shared_ptr<Topic>& topic, const MessagePtr& message, std::size_t most);  // to who listens, soon
  void Leave();  // when all that was sent is with the system, or after 2 s

  std::list<msgs::Publish> Publishers();
  std::list<std::string> Spaces(const std::chrono::duration<double>& patience);
  /// What the master answers to one of the kind that gz has. \return false after a few seconds
  bool Ask(const std::string& request, const std::string& data, const std::string& answer, google::protobuf::Message& message);

private:
  using Clock = std::chrono::steady_clock;
  enum class Kind
  {
    to_master,
    of_master,
    listener,
    source
  };
  struct Connection
  {
    Kind kind;
    std::unique_ptr<Link> link;
    std::shared_ptr<Topic> topic;                      // of a listener, when it has said which; of a source
    msgs::Publish publisher;                           // of a source
    Clock::time_point end = Clock::time_point::max();  // of a source that is no longer announced
  };
  struct Outgoing
  {
    std::shared_ptr<Topic> topic;
    MessagePtr message;
    std::size_t most;
  };

  void start();
  void run();
  void wake();
  int collect(std::vector<pollfd>& fds, std::vector<int>& ids);  // \return ms to wait at most
  void handle(const std::vector<pollfd>& fds, const std::vector<int>& ids);
  void accept(int fd, Kind kind);
  void add(int fd, Kind kind, std::size_t longest);
  void drop(int id);
  void greet();
  void handOut();
  void onFrame(int id, std::string&& data);
  void onSubscriber(Connection& connection, const msgs::Packet& packet);
  void onPacket(const msgs::Packet& packet);  // of the master
  void onPublisher(const msgs::Publish& publisher);
  void onUnadvertised(const msgs::Publish& publisher);
  void tellMaster(const std::string& type, const google::protobuf::Message& message);
  bool own(const msgs::Publish& publisher) const { return publisher.host() == address_ && publisher.port() == port_; }
  void refresh(const std::string& topic);

  std::mutex mutex_;  // of all that follows, but for the outbox; before that of the Post
  std::condition_variable changed_;
  std::atomic<bool> running_{ false }, serves_{ false };
  bool closed_ = false;
  int wake_ = -1, listens_ = -1, master_listens_ = -1;
  std::string address_;
  unsigned int port_ = 0;
  std::unique_ptr<Master> master_;
  std::function<void()> first_;
  bool ready_ = false;
  std::map<int, Clock::time_point> held_;  // clients of the master that wait to be greeted
  int next_ = 1;                           // 0 is this process, to its own master
  int to_master_ = -1;
  std::map<int, Connection> connections_;
  struct Announced
  {
    std::string type;
    bool published = false, heard = false, latching = false;
  };
  std::map<std::string, Announced> announced_;
  std::list<msgs::Publish> publishers_;
  std::list<std::string> spaces_;
  bool greeted_ = false;                        // by the master
  std::map<std::string, std::string> answers_;  // of the master, by the type of the packet
  std::vector<std::string> reports_;            // lines for the user, said when nothing is locked

  std::mutex outbox_mutex_;
  std::deque<Outgoing> outbox_;
  std::atomic<bool> woken_{ false };
};

}  // namespace transport
}  // namespace gazebo
