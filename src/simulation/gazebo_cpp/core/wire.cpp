#include "wire.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gazebo
{
namespace transport
{
namespace
{

constexpr std::size_t header_length = 8;
constexpr std::size_t most_waiting = 1 << 26;  // bytes that one slow listener may hold
constexpr std::size_t most_at_once = 1 << 20;  // bytes that are read in one turn

/// Of a header; npos if it is none.
std::size_t length_of(const char* header)
{
  char digits[header_length + 1] = {};
  std::memcpy(digits, header, header_length);
  char* end = nullptr;
  const unsigned long length = std::strtoul(digits, &end, 16);
  return end == digits + header_length && !std::strpbrk(digits, "-+xX") ? length : std::string::npos;
}

bool not_now()
{
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == EINPROGRESS || errno == ENOTCONN;
}

std::string text_of(const in_addr& address)
{
  char text[INET_ADDRSTRLEN] = {};
  inet_ntop(AF_INET, &address, text, sizeof text);
  return text;
}

/// By its number or its name.
bool resolve(const std::string& host, in_addr& address)
{
  if (inet_pton(AF_INET, host.c_str(), &address) == 1)
    return true;
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0 || !found)
    return false;
  address = reinterpret_cast<const sockaddr_in*>(found->ai_addr)->sin_addr;
  freeaddrinfo(found);
  return true;
}

}  // namespace

Frame framed(const std::string& data)
{
  char header[header_length + 9];
  std::snprintf(header, sizeof header, "%8zx", data.size());
  return std::make_shared<const std::string>(header + data);
}

Link::~Link() { close(fd_); }

bool Link::Send(const Frame& frame, std::size_t most)
{
  out_.push_back(frame);
  waiting_ += frame->size();
  bool first = false;
  // The one that is half sent has to stay, and the newest.
  while (out_.size() > 2 && (out_.size() > most + 1 || waiting_ > most_waiting))
  {
    waiting_ -= out_[1]->size();
    out_.erase(out_.begin() + 1);
    first = !dropped_;
    dropped_ = true;
  }
  return first;
}

void Link::Flush()
{
  while (!out_.empty() && !broken_)
  {
    const std::string& frame = *out_.front();
    const ssize_t sent = send(fd_, frame.data() + sent_, frame.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0)
    {
      broken_ = !not_now();
      return;
    }
    sent_ += static_cast<std::size_t>(sent);
    if (sent_ < frame.size())
      continue;
    waiting_ -= frame.size();
    sent_ = 0;
    out_.pop_front();
  }
}

void Link::Receive(const std::function<void(std::string&&)>& f)
{
  char part[65536];
  for (std::size_t taken = 0; taken < most_at_once;)
  {
    const ssize_t size = recv(fd_, part, sizeof part, MSG_DONTWAIT);
    if (size <= 0)
    {
      broken_ = size == 0 || !not_now();
      break;
    }
    in_.append(part, static_cast<std::size_t>(size));
    taken += static_cast<std::size_t>(size);
  }
  std::size_t at = 0;
  while (in_.size() - at >= header_length)
  {
    const std::size_t length = length_of(in_.data() + at);
    if (length > longest_)
    {
      broken_ = true;
      in_.clear();
      return;
    }
    if (in_.size() - at - header_length < length)
      break;
    f(in_.substr(at + header_length, length));
    at += header_length + length;
  }
  in_.erase(0, at);
}

int listen_on(unsigned int& port)
{
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof address;
  if (fd < 0 || bind(fd, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(fd, 128) != 0 ||
      getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0)
  {
    if (fd >= 0)
      close(fd);
    return -1;
  }
  port = ntohs(address.sin_port);
  return fd;
}

int connect_to(const std::string& host, unsigned int port, bool wait)
{
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  if (!resolve(host, address.sin_addr))
    return -1;
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | (wait ? 0 : SOCK_NONBLOCK), 0);
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (fd >= 0 && (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 || (!wait && errno == EINPROGRESS)))
    return fd;
  if (fd >= 0)
    close(fd);
  return -1;
}

std::string own_address()
{
  in_addr address{};
  for (const char* name : { "GAZEBO_HOSTNAME", "GAZEBO_IP" })
    if (const char* value = std::getenv(name))
      if (*value && resolve(value, address))
        return text_of(address);
  std::string found = "127.0.0.1";
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0)
    return found;
  for (const ifaddrs* each = all; each; each = each->ifa_next)
    if (each->ifa_addr && each->ifa_addr->sa_family == AF_INET && each->ifa_flags & IFF_UP && !(each->ifa_flags & IFF_LOOPBACK))
    {
      found = text_of(reinterpret_cast<const sockaddr_in*>(each->ifa_addr)->sin_addr);
      break;
    }
  freeifaddrs(all);
  return found;
}

std::string master_uri(std::string& host, unsigned int& port)
{
  host = "localhost";
  port = 11345;
  const char* value = std::getenv("GAZEBO_MASTER_URI");
  std::string uri = value ? value : "";
  if (uri.empty())
    return "";
  if (uri.compare(0, 7, "http://") == 0)
    uri.erase(0, 7);
  while (!uri.empty() && uri.back() == '/')
    uri.pop_back();
  const std::size_t colon = uri.rfind(':');
  char* end = nullptr;
  const unsigned long number = colon == std::string::npos ? 0 : std::strtoul(uri.c_str() + colon + 1, &end, 10);
  if (colon == std::string::npos || colon == 0 || *end || !number || number > 65535)
    return std::string("GAZEBO_MASTER_URI is '") + value + "', not of the form http://localhost:11345";
  host = uri.substr(0, colon);
  port = static_cast<unsigned int>(number);
  return "";
}

}  // namespace transport
}  // namespace gazebo
