#pragma once
#include <list>
#include <string>

#include <gazebo/common/SingletonT.hh>
#include <gazebo/util/system.hh>

namespace gazebo
{
namespace common
{

/// Where files are looked for, from the environment.
class GAZEBO_VISIBLE SystemPaths : public SingletonT<SystemPaths>
{
public:
  std::string GetLogPath() const;
  const std::list<std::string>& GetGazeboPaths() { return gazebo_; }
  const std::list<std::string>& GetPluginPaths() { return plugins_; }
  const std::list<std::string>& GetModelPaths() { return models_; }
  const std::string& TmpPath() const { return tmp_; }
  const std::string& TmpInstancePath() const { return tmp_; }
  std::string FindFileURI(const std::string& uri);
  std::string FindFile(const std::string& filename, bool search_local_path = true);
  void AddGazeboPaths(const std::string& path) { add(gazebo_, path); }
  void AddPluginPaths(const std::string& path) { add(plugins_, path); }
  void AddModelPaths(const std::string& path) { add(models_, path); }
  void ClearGazeboPaths() { gazebo_.clear(); }
  void ClearPluginPaths() { plugins_.clear(); }
  void ClearModelPaths() { models_.clear(); }

private:
  friend class SingletonT<SystemPaths>;
  SystemPaths();
  static void add(std::list<std::string>& list, const std::string& paths);
  std::list<std::string> gazebo_, plugins_, models_;
  std::string tmp_;
};

}  // namespace common
}  // namespace gazebo
