// What a library lacks, found out before it is loaded: a function that is missing when it is called ends the process.
#include <compiled_plugins/guard.h>
#include "elf_symbols.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cxxabi.h>
#include <cstdlib>
#include <dlfcn.h>
#include <memory>
#include <set>
#include <spawn.h>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace compiled_plugins
{
namespace
{

std::string readable(const std::string& symbol)
{
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), std::free);
  return status == 0 && name ? name.get() : symbol;
}

/// What ``ldd -r`` prints: it resolves all symbols and runs nothing of the library.
std::string resolved(const std::string& library)
{
  int ends[2];
  if (pipe(ends) != 0)
    return "";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  const char* words[] = { "ldd", "-r", library.c_str(), nullptr };
  pid_t child = -1;
  const int failed = posix_spawnp(&child, "ldd", &actions, nullptr, const_cast<char**>(words), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part;
  ssize_t size;
  while (!failed && ((size = read(ends[0], part.data(), part.size())) > 0 || (size < 0 && errno == EINTR)))
    if (size > 0)
      text.append(part.data(), size);
  close(ends[0]);
  if (!failed)
    waitpid(child, nullptr, 0);
  return text;
}

/// What upstream's simulator has loaded of the system's ROS libraries: gazebo_ros, gazebo_ros_control and gazebo_plugins link them.
const char* const of_the_simulator[] = { "liburdf.so",         "libtf.so",
                                         "libtf2_ros.so",      "libtf2.so",
                                         "libactionlib.so",    "libdynamic_reconfigure_config_init_mutex.so",
                                         "libnodeletlib.so",   "libimage_transport.so",
                                         "libcv_bridge.so",    "libcamera_info_manager.so",
                                         "libpolled_camera.so" };

/// Those of them that define some of ``symbols``.
std::vector<std::string> of_the_system(const std::set<std::string>& symbols)
{
  std::vector<std::string> names;
  for (const char* name : of_the_simulator)
    if (void* const handle = symbols.empty() ? nullptr : dlopen(name, RTLD_LAZY))
    {
      if (std::any_of(symbols.begin(), symbols.end(), [&](const std::string& symbol) { return dlsym(handle, symbol.c_str()); }))
        names.push_back(name);
      dlclose(handle);
    }
  return names;
}

/// Removes from ``missing`` what one of the libraries defines, and loads it for all.
void take(const std::string& library, const std::vector<std::string>& others, std::set<std::string>& missing)
{
  for (const std::string& neighbour : others)
  {
    if (missing.empty() || !dlopen(neighbour.c_str(), RTLD_LAZY | RTLD_GLOBAL))
      continue;
    std::fprintf(stderr,
                 "[WARN] the library %s calls what %s defines and does not link it; it is loaded with it. Name it in "
                 "target_link_libraries of its CMakeLists.txt\n",
                 library.c_str(), neighbour.c_str());
    for (auto symbol = missing.begin(); symbol != missing.end();)
      symbol = dlsym(RTLD_DEFAULT, symbol->c_str()) ? missing.erase(symbol) : std::next(symbol);
  }
}

/// Upstream's loaders bind late and share what they load: a plugin that forgot to link a library (of its own package, or control_toolbox
/// or urdf, which the simulator has) finds there what another one brought.
void supply(const std::string& library, std::set<std::string>& missing)
{
  take(library, definers(library, missing), missing);
  take(library, of_the_system(missing), missing);
}

}  // namespace

std::string why_not(const std::string& library)
{
  if (access(library.c_str(), R_OK) != 0)
    return "the library " + library + " does not exist or cannot be read; is its package built?";
  if (!whole_library(library))
    return "the file " + library + " is no library, or not all of one; build its package anew";
  std::istringstream lines(resolved(library));
  std::set<std::string> missing;
  std::vector<std::string> absent;
  for (std::string line; std::getline(lines, line);)
  {
    const std::string undefined = "undefined symbol: ";
    const std::size_t symbol = line.find(undefined);
    const std::size_t not_found = line.find(" => not found");
    if (symbol != std::string::npos)
    {
      std::string name = line.substr(symbol + undefined.size());
      name = name.substr(0, name.find_first_of(" \t,"));
      if (!dlsym(RTLD_DEFAULT, name.c_str()))
        missing.insert(name);
    }
    else if (not_found != std::string::npos)
    {
      const std::string name = line.substr(line.find_first_not_of(" \t"), not_found - line.find_first_not_of(" \t"));
      if (!dlopen(name.c_str(), RTLD_NOLOAD | RTLD_LAZY))
        absent.push_back(name);
    }
  }
  std::string names;
  for (const std::string& name : absent)
    names += (names.empty() ? "" : ", ") + name;
  if (!absent.empty())
    return "the library " + library + " needs " + names + ", which " + (absent.size() == 1 ? "is" : "are") + " not found";
  supply(library, missing);
  std::set<std::string> symbols;
  for (const std::string& name : missing)
    symbols.insert(readable(name));
  if (symbols.empty())
    return "";
  return "the library " + library + " lacks the symbol " + *symbols.begin() +
         (symbols.size() > 1 ? " and " + std::to_string(symbols.size() - 1) + " more" : "") +
         "; link what defines it in its CMakeLists.txt (target_link_libraries), or build the package anew";
}

}  // namespace compiled_plugins
