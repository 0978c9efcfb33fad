// gzmsg, gzdbg, gzwarn, gzerr, gzlog: streams with a line's beginning. Warnings and errors are always shown, the others with --verbose.
#pragma once
#include <thread>                // plugins use it without including it
#include <boost/scoped_ptr.hpp>  // so do they with this one
#include <boost/thread.hpp>      // and with threads and mutexes of boost
#include <iostream>
#include <sstream>
#include <string>

#include <gazebo/common/CommonTypes.hh>

namespace gazebo
{
namespace common
{

class GAZEBO_VISIBLE Console
{
public:
  static std::ostream& Begin(const char* word, int colour, bool always, const char* file, int line);
  static void SetQuiet(bool quiet);
  static bool GetQuiet();
};

}  // namespace common
}  // namespace gazebo

#define gzdbg (gazebo::common::Console::Begin("Dbg", 36, false, __FILE__, __LINE__))
#define gzmsg (gazebo::common::Console::Begin("Msg", 32, false, nullptr, 0))
#define gzwarn (gazebo::common::Console::Begin("Wrn", 33, true, __FILE__, __LINE__))
#define gzerr (gazebo::common::Console::Begin("Err", 31, true, __FILE__, __LINE__))
#define gzlog (gazebo::common::Console::Begin("Log", 37, false, __FILE__, __LINE__))
#define gzLogInit(prefix, file)
#define gzLogDirectory() std::string()
