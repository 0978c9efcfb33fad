// A call of an action from a thread: waits for the server, then for the result, and ends early when the display goes.
#pragma once

#include <actionlib/client/simple_action_client.h>
#include <ros/names.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "jobs.hpp"

namespace moveit_rviz_plugin {

template <typename Action>
class ActionCall {
 public:
  using Client = actionlib::SimpleActionClient<Action>;
  using Goal = typename Action::_action_goal_type::_goal_type;

  // The client that has the result. Null: `why` says why there is none. `hint`: what might help when nobody serves it.
  std::shared_ptr<Client> run(const Jobs& jobs, const std::string& name, const Goal& goal, const std::string& hint,
                              std::string& why) {
    const std::shared_ptr<Client> client = get(name);
    if (!wait(jobs, *client, [&client]() { return client->isServerConnected(); })) {
      why = "nobody serves the action " + ros::names::resolve(name) + ": " + hint;
      return nullptr;
    }
    client->sendGoal(goal);
    if (!wait(jobs, *client, [&client]() { return client->getState().isDone(); })) {
      why = ros::names::resolve(name) + " went away";
      return nullptr;
    }
    if (!client->getResult()) {
      why = ros::names::resolve(name) + " gave no result";
      return nullptr;
    }
    return client;
  }

  void cancel() {
    const std::lock_guard<std::mutex> lock(lock_);
    if (client_ && client_->isServerConnected()) client_->cancelAllGoals();
  }

  // The next call looks for its server anew.
  void reset() {
    const std::lock_guard<std::mutex> lock(lock_);
    client_.reset();
  }

 private:
  static constexpr double PATIENCE = 5.0;  // s without a server

  std::shared_ptr<Client> get(const std::string& name) {
    const std::lock_guard<std::mutex> lock(lock_);
    if (!client_ || name_ != name) client_ = std::make_shared<Client>(name, true);
    name_ = name;
    return client_;
  }

  static bool wait(const Jobs& jobs, Client& client, const std::function<bool()>& met) {
    ros::WallTime alone = ros::WallTime::now();
    while (!met()) {
      if (jobs.ending() || !ros::ok()) return false;
      if (client.isServerConnected()) alone = ros::WallTime::now();
      if ((ros::WallTime::now() - alone).toSec() > PATIENCE) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }

  std::mutex lock_;
  std::shared_ptr<Client> client_;
  std::string name_;
};

}  // namespace moveit_rviz_plugin
