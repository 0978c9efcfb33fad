// Scenes, queries and states by name, in the SQLite file of the package moveit_ros_warehouse; no server is needed.
#pragma once

#include <ros/serialization.h>

#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

struct sqlite3;

namespace moveit_rviz_plugin {

class Warehouse {
 public:
  using Owners = std::map<std::string, std::string>;  // column ("robot", "scene", "planning_group"): value

  // `host`: a path, or anything else for the file of this ROS system: that of a running warehouse, or ~/.ros/warehouse.sqlite.
  static std::string fileFor(const std::string& host);

  // All throw std::runtime_error with one line. The file is made where there is none.
  explicit Warehouse(const std::string& file);
  ~Warehouse();
  Warehouse(const Warehouse&) = delete;
  Warehouse& operator=(const Warehouse&) = delete;

  const std::string& file() const { return file_; }
  // names() and load() also find what other nodes have kept without an owner.
  std::vector<std::string> names(const std::string& table, const Owners& owners = {});
  void remove(const std::string& table, const std::string& name, const Owners& owners = {});
  void clear(const std::string& table, const Owners& owners = {});
  void rename(const std::string& table, const std::string& from, const std::string& to, const Owners& owners = {});

  template <typename Message>
  void save(const std::string& table, const std::string& name, const Message& message, const Owners& owners = {}) {
    std::vector<uint8_t> data(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(data.data(), static_cast<uint32_t>(data.size()));
    ros::serialization::serialize(stream, message);
    write(table, name, data, owners);
  }
  template <typename Message>
  Message load(const std::string& table, const std::string& name, const Owners& owners = {}) {
    std::vector<uint8_t> data = read(table, name, owners);
    Message message;
    try {
      ros::serialization::IStream stream(data.data(), static_cast<uint32_t>(data.size()));
      ros::serialization::deserialize(stream, message);
    } catch (const ros::serialization::StreamOverrunException&) {
      throw std::runtime_error("'" + name + "' in '" + file_ + "' is damaged");
    }
    return message;
  }

 private:
  class Statement;
  void write(const std::string& table, const std::string& name, const std::vector<uint8_t>& data, const Owners& owners);
  std::vector<uint8_t> read(const std::string& table, const std::string& name, const Owners& owners);
  std::runtime_error unusable() const;
  void makeTables();

  std::string file_;
  std::mutex lock_;
  sqlite3* base_ = nullptr;
};

}  // namespace moveit_rviz_plugin
