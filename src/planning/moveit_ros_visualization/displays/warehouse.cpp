#include "warehouse.hpp"

#include <ros/param.h>
#include <sqlite3.h>

#include <algorithm>
#include <boost/filesystem.hpp>
#include <cstdlib>

namespace moveit_rviz_plugin {
namespace {
constexpr int PATIENCE = 10000;  // ms that another node may hold the file

std::string parameter(const std::string& name) {
  std::string key, text;
  if (ros::param::search(name, key)) ros::param::get(key, text);
  return text;
}

std::string rosHome() {
  if (const char* home = std::getenv("ROS_HOME")) return home;
  const char* home = std::getenv("HOME");
  return std::string(home ? home : "/tmp") + "/.ros";
}

std::string fileOf(std::string path) {
  if (path.compare(0, 2, "~/") == 0 && std::getenv("HOME")) path = std::getenv("HOME") + path.substr(1);
  if (boost::filesystem::path(path).has_extension() && !boost::filesystem::is_directory(path)) return path;
  return path + "/warehouse.sqlite";
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
}  // namespace

// One SQL statement; its values are bound in order.
class Warehouse::Statement {
 public:
  Statement(Warehouse& warehouse, const std::string& text) : warehouse_(warehouse) {
    if (sqlite3_prepare_v2(warehouse.base_, text.c_str(), -1, &statement_, nullptr) != SQLITE_OK) throw warehouse.unusable();
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement& bind(const std::string& text) {
    sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(const std::vector<uint8_t>& data) {
    sqlite3_bind_blob(statement_, ++bound_, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    return *this;
  }
  // " AND column = ?" for each, bound by the next function; `or_nobody`: also what was kept without an owner.
  static std::string where(const Owners& owners, bool or_nobody = false) {
    std::string text;
    for (const auto& owner : owners)
      if (!owner.second.empty()) text += " AND " + owner.first + (or_nobody ? " IN (?, '')" : " = ?");
    return text;
  }
  // Those of an owner before those of nobody.
  static std::string order(const Owners& owners) {
    std::string text;
    for (const auto& owner : owners) text += (text.empty() ? " ORDER BY " : ", ") + owner.first + " = ''";
    return text;
  }
  Statement& bind(const Owners& owners) {
    for (const auto& owner : owners)
      if (!owner.second.empty()) bind(owner.second);
    return *this;
  }
  bool step() {
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) throw warehouse_.unusable();
    return result == SQLITE_ROW;
  }
  std::string text() {
    const auto* found = reinterpret_cast<const char*>(sqlite3_column_text(statement_, 0));
    return found ? found : "";
  }
  std::vector<uint8_t> data() {
    const auto* found = static_cast<const uint8_t*>(sqlite3_column_blob(statement_, 0));
    return found ? std::vector<uint8_t>(found, found + sqlite3_column_bytes(statement_, 0)) : std::vector<uint8_t>();
  }

 private:
  Warehouse& warehouse_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

std::string Warehouse::fileFor(const std::string& host) {
  if (host.find('/') != std::string::npos || endsWith(host, ".sqlite") || endsWith(host, ".db")) return fileOf(host);
  std::string plugin = parameter("warehouse_plugin");
  std::transform(plugin.begin(), plugin.end(), plugin.begin(), ::tolower);
  const std::string named = parameter("warehouse_host");
  if (plugin.find("sqlite") != std::string::npos && !named.empty()) return fileOf(named);
  const std::string running = parameter("warehouse_file");
  return running.empty() ? rosHome() + "/warehouse.sqlite" : running;
}

Warehouse::Warehouse(const std::string& file) : file_(file) {
  boost::system::error_code error;
  boost::filesystem::create_directories(boost::filesystem::path(file).parent_path(), error);
  const bool open = sqlite3_open(file.c_str(), &base_) == SQLITE_OK;
  try {
    if (!open) throw unusable();
    sqlite3_busy_timeout(base_, PATIENCE);
    makeTables();
  } catch (const std::runtime_error&) {
    sqlite3_close(base_);
    throw;
  }
}

Warehouse::~Warehouse() { sqlite3_close(base_); }

std::runtime_error Warehouse::unusable() const {
  return std::runtime_error("the database file '" + file_ + "' cannot be used: " + sqlite3_errmsg(base_));
}

// Those of moveit_ros_warehouse.
void Warehouse::makeTables() {
  for (const char* columns : {"states (name TEXT, robot TEXT, data BLOB, PRIMARY KEY (name, robot))",
                              "scenes (name TEXT, data BLOB, PRIMARY KEY (name))",
                              "constraints (name TEXT, robot TEXT, planning_group TEXT, data BLOB, "
                              "PRIMARY KEY (name, robot, planning_group))",
                              "requests (name TEXT, scene TEXT, data BLOB, PRIMARY KEY (name, scene))",
                              "results (name TEXT, scene TEXT, data BLOB, PRIMARY KEY (name, scene))"})
    Statement(*this, std::string("CREATE TABLE IF NOT EXISTS ") + columns).step();
}

std::vector<std::string> Warehouse::names(const std::string& table, const Owners& owners) {
  const std::lock_guard<std::mutex> lock(lock_);
  Statement statement(*this,
                      "SELECT DISTINCT name FROM " + table + " WHERE 1" + Statement::where(owners, true) + " ORDER BY name");
  statement.bind(owners);
  std::vector<std::string> found;
  while (statement.step()) found.push_back(statement.text());
  return found;
}

void Warehouse::write(const std::string& table, const std::string& name, const std::vector<uint8_t>& data,
                      const Owners& owners) {
  if (name.empty()) throw std::runtime_error("nothing can be kept without a name");
  const std::lock_guard<std::mutex> lock(lock_);
  std::string columns = "name", marks = "?";
  for (const auto& owner : owners) {
    columns += ", " + owner.first;
    marks += ", ?";
  }
  Statement statement(*this, "INSERT OR REPLACE INTO " + table + " (" + columns + ", data) VALUES (" + marks + ", ?)");
  statement.bind(name);
  for (const auto& owner : owners) statement.bind(owner.second);
  statement.bind(data).step();
}

std::vector<uint8_t> Warehouse::read(const std::string& table, const std::string& name, const Owners& owners) {
  const std::lock_guard<std::mutex> lock(lock_);
  Statement statement(*this, "SELECT data FROM " + table + " WHERE name = ?" + Statement::where(owners, true) +
                                 Statement::order(owners) + " LIMIT 1");
  statement.bind(name).bind(owners);
  if (!statement.step()) throw std::runtime_error("there is no '" + name + "' among the " + table + " in '" + file_ + "'");
  return statement.data();
}

void Warehouse::remove(const std::string& table, const std::string& name, const Owners& owners) {
  const std::lock_guard<std::mutex> lock(lock_);
  Statement statement(*this, "DELETE FROM " + table + " WHERE name = ?" + Statement::where(owners));
  statement.bind(name).bind(owners).step();
}

void Warehouse::clear(const std::string& table, const Owners& owners) {
  const std::lock_guard<std::mutex> lock(lock_);
  Statement statement(*this, "DELETE FROM " + table + " WHERE 1" + Statement::where(owners));
  statement.bind(owners).step();
}

void Warehouse::rename(const std::string& table, const std::string& from, const std::string& to, const Owners& owners) {
  if (to.empty()) throw std::runtime_error("nothing can be kept without a name");
  const std::lock_guard<std::mutex> lock(lock_);
  Statement statement(*this, "UPDATE OR REPLACE " + table + " SET name = ? WHERE name = ?" + Statement::where(owners));
  statement.bind(to).bind(from).bind(owners).step();
}

}  // namespace moveit_rviz_plugin
