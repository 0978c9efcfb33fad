// The connections of Gazebo's transport between processes: who is at which address, and frames on TCP.
#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <string>

namespace gazebo
{
namespace transport
{

/// A frame: the length of the data as 8 hexadecimal digits, blanks in front of them, and the data.
using Frame = std::shared_ptr<const std::string>;
Frame framed(const std::string& data);

/// A TCP connection that nobody ever waits for. Sending may be called in any thread, one at a time; the rest in one.
class Link
{
public:
  static constexpr std::size_t small = 1 << 20, large = 1 << 28;  // bytes of the longest frame that is taken

  /// \param fd of a socket, which is closed with it; it may still be connecting
  Link(int fd, std::size_t longest) : fd_(fd), longest_(longest) {}
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  int Fd() const { return fd_; }
  bool Broken() const { return broken_; }
  bool HasToSend() const { return !out_.empty(); }

  /// \param most how many frames may wait; beyond them, and beyond what memory is for, the oldest are dropped
  /// \return one was dropped, for the first time
  bool Send(const Frame& frame, std::size_t most = 100000);
  void Flush();  // sends what the other side takes now

  /// Calls f(data) for each frame that is there by now. Broken() afterwards: the other side has closed it, or sends no frames.
  void Receive(const std::function<void(std::string&&)>& f);

private:
  int fd_;
  std::size_t longest_;
  bool broken_ = false, dropped_ = false;
  std::deque<Frame> out_;
  std::size_t sent_ = 0, waiting_ = 0;  // bytes: of the first frame, of all
  std::string in_;
};

/// \return the socket, -1 if the port is taken; port: 0 for any free one, and the one taken afterwards
int listen_on(unsigned int& port);

/// \return the socket, -1 if there is no such host; wait: until it is connected, or refused (-1)
int connect_to(const std::string& host, unsigned int port, bool wait);

/// The address of this machine for others: GAZEBO_HOSTNAME, GAZEBO_IP, that of its first network, or 127.0.0.1.
std::string own_address();

/// GAZEBO_MASTER_URI. \return what is wrong with it, in words; host and port are the usual ones then
std::string master_uri(std::string& host, unsigned int& port);

}  // namespace transport
}  // namespace gazebo
