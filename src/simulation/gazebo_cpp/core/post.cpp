// Messages are handed on by one thread, in the order in which they were published.
#include "post.hpp"

namespace gazebo
{
namespace transport
{

constexpr std::size_t longest_queue = 100000;

Post& Post::Get()
{
  static Post* one = new Post;
  return *one;
}

std::shared_ptr<Topic> Post::Find(const std::string& name)
{
  auto& found = topics[name];
  if (!found)
    found = std::make_shared<Topic>(), found->name = name;
  return found;
}

void Post::Spread(Topic& topic, const Parcel& parcel)
{
  topic.last = parcel;
  for (const auto& subscription : topic.subscriptions)
    if (queue_.size() < longest_queue)
      Send(subscription, parcel);
}

void Post::Send(const std::shared_ptr<Subscription>& to, const Parcel& parcel)
{
  if (!running_)
  {
    running_ = true;
    std::thread([this] { deliver(); }).detach();
  }
  queue_.push_back({ to, parcel });
  ++sent_;
  changed.notify_all();
}

void Post::deliver()
{
  thread_ = std::this_thread::get_id();
  while (true)
  {
    Delivery next;
    {
      std::unique_lock<std::mutex> lock(mutex);
      changed.wait(lock, [&] { return !queue_.empty(); });
      next = std::move(queue_.front());
      queue_.pop_front();
    }
    handOver(next);
    ++done_;
    const std::lock_guard<std::mutex> lock(mutex);
    changed.notify_all();
  }
}

void Post::handOver(const Delivery& next)
{
  const std::lock_guard<std::mutex> lock(next.to->running);
  if (!next.to->on)
    return;
  const internal::Running running(next.to->owner, "callback of a topic");
  try
  {
    next.to->callback(next.parcel);
  }
  catch (const std::exception& error)
  {
    next.to->on = false;
    internal::Failed(next.to->owner, ("callback of " + next.to->topic).c_str(), error.what());
  }
  catch (...)
  {
    next.to->on = false;
    internal::Failed(next.to->owner, ("callback of " + next.to->topic).c_str(), nullptr);
  }
}

}  // namespace transport
}  // namespace gazebo
