// Times, lines on the terminal, events, PID, paths.
#include <gazebo/common/common.hh>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <iomanip>
#include <thread>
#include <unistd.h>

#include <compiled_plugins/guard.h>

namespace gazebo
{
namespace internal
{
namespace
{
thread_local const char* current = nullptr;
std::function<void(bool, const std::string&)>& reporter()
{
  static auto* one = new std::function<void(bool, const std::string&)>;
  return *one;
}
}  // namespace

void SetReporter(std::function<void(bool, const std::string&)> f) { reporter() = std::move(f); }

void Report(bool error, const std::string& line)
{
  if (reporter())
    reporter()(error, line);
  else
    std::cerr << (error ? "\033[31m[ERROR] " : "\033[33m[WARN] ") << line << "\033[0m" << std::endl;
}

const char* CurrentPlugin() { return current; }

Running::Running(const char* who, const char* what) : before_(current)
{
  static_assert(sizeof(compiled_plugins::Call) <= sizeof call_, "room for the guard");
  current = who;
  new (call_) compiled_plugins::Call(who, what);
}

Running::~Running()
{
  reinterpret_cast<compiled_plugins::Call*>(call_)->~Call();
  current = before_;
}

void Failed(const char* who, const char* what, const char* reason)
{
  std::string text = reason ? reason : "something that is no std::exception";
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.pop_back();
  Report(true, std::string(who ? who : "a callback of no plugin") + ": its " + what + " threw: " + text +
                   ". It is not called any more; the simulation goes on");
}

}  // namespace internal

void printVersion() { std::cout << GAZEBO_VERSION_HEADER << std::flush; }

namespace common
{

// -- Time ---------------------------------------------------------------------------------------------------------------------------

const Time Time::Zero = Time(0, 0);
const Time Time::Second = Time(1, 0);
const Time Time::Hour = Time(3600, 0);

namespace
{

int64_t nanoseconds(const Time& time) { return time.sec * static_cast<int64_t>(Time::nsInSec) + time.nsec; }

Time from_nanoseconds(int64_t ns)
{
  return Time(static_cast<int32_t>(ns / Time::nsInSec), static_cast<int32_t>(ns % Time::nsInSec));
}

}  // namespace

Time::Time(const timeval& time) : Time(static_cast<int32_t>(time.tv_sec), static_cast<int32_t>(time.tv_usec * 1000)) {}
Time::Time(const timespec& time) : Time(static_cast<int32_t>(time.tv_sec), static_cast<int32_t>(time.tv_nsec)) {}
Time::Time(int32_t seconds, int32_t ns) { Set(seconds, ns); }
Time::Time(double seconds) { Set(seconds); }

void Time::Set(int32_t seconds, int32_t ns)
{
  sec = seconds + ns / nsInSec;
  nsec = ns % nsInSec;
  if (sec < 0 && nsec > 0)
    ++sec, nsec -= nsInSec;
  else if (sec > 0 && nsec < 0)
    --sec, nsec += nsInSec;
}

void Time::Set(double seconds)
{
  const double whole = std::trunc(seconds);
  Set(static_cast<int32_t>(whole), static_cast<int32_t>(std::lrint((seconds - whole) * 1e9)));
}

const Time& Time::GetWallTime()
{
  static thread_local Time now;
  now.SetToWallTime();
  return now;
}

const std::string& Time::GetWallTimeAsISOString()
{
  static thread_local std::string text;
  const std::time_t now = std::time(nullptr);
  char buffer[40];
  std::tm parts;
  std::strftime(buffer, sizeof buffer, "%Y-%m-%dT%H:%M:%S", localtime_r(&now, &parts));
  return text = buffer;
}

void Time::SetToWallTime()
{
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  *this = Time(now);
}

std::string Time::FormattedString(FormatOption start, FormatOption end) const
{
  const int64_t ms = nanoseconds(*this) / nsInMs;
  const int64_t parts[] = { ms / 86400000, ms / 3600000 % 24, ms / 60000 % 60, ms / 1000 % 60, ms % 1000 };
  std::ostringstream text;
  text << std::setfill('0');
  for (int i = start; i <= end; ++i)
    text << (i == start          ? ""
             : i == MILLISECONDS ? "."
             : i == HOURS        ? " "
                                 : ":")
         << std::setw(i == MILLISECONDS ? 3 : 2) << parts[i];
  return text.str();
}

Time Time::Sleep(const Time& time)
{
  const Time before = GetWallTime();
  std::this_thread::sleep_for(std::chrono::nanoseconds(nanoseconds(time)));
  return GetWallTime() - before;
}
Time Time::MSleep(unsigned int milliseconds) { return Sleep(Time(milliseconds * 1e-3)); }
Time Time::NSleep(unsigned int ns) { return Sleep(from_nanoseconds(ns)); }

Time Time::operator+(const Time& other) const { return from_nanoseconds(nanoseconds(*this) + nanoseconds(other)); }
Time Time::operator-(const Time& other) const { return from_nanoseconds(nanoseconds(*this) - nanoseconds(other)); }
Time Time::operator*(const Time& other) const { return Time(Double() * other.Double()); }
Time Time::operator/(const Time& other) const { return Time(Double() / other.Double()); }

std::ostream& operator<<(std::ostream& out, const Time& time) { return out << time.sec << " " << time.nsec; }
std::istream& operator>>(std::istream& in, Time& time) { return in >> time.sec >> time.nsec; }

// -- Console, Exception -------------------------------------------------------------------------------------------------------------

namespace
{
bool quiet = true;
}

void Console::SetQuiet(bool on) { quiet = on; }
bool Console::GetQuiet() { return quiet; }

std::ostream& Console::Begin(const char* word, int colour, bool always, const char* file, int line)
{
  static std::ostream* nowhere = new std::ostream(nullptr);
  if (!always && quiet)
    return *nowhere;
  std::cerr << "\033[1;" << colour << "m[" << word << "] ";
  if (file)
  {
    const std::string path = file;
    std::cerr << "[" << path.substr(path.find_last_of('/') + 1) << ":" << line << "] ";
  }
  return std::cerr << "\033[0m";
}

Exception::Exception(const char* file, int64_t line, std::string message) : file_(file), text_(std::move(message)), line_(line)
{
}

// -- PID ----------------------------------------------------------------------------------------------------------------------------

void PID::Init(double p, double i, double d, double imax, double imin, double cmdMax, double cmdMin)
{
  p_ = p, i_ = i, d_ = d, imax_ = imax, imin_ = imin, cmd_max_ = cmdMax, cmd_min_ = cmdMin;
  Reset();
}

void PID::Reset() { p_error_ = last_p_error_ = i_error_ = d_error_ = cmd_ = 0; }

double PID::Update(double error, Time dt)
{
  p_error_ = error;
  if (dt == Time::Zero || !std::isfinite(error))
    return 0;
  const double seconds = dt.Double();
  i_error_ += seconds * error;
  double i_term = i_ * i_error_;
  if (i_term > imax_ || i_term < imin_)
  {
    i_term = i_term > imax_ ? imax_ : imin_;
    i_error_ = i_term / i_;
  }
  d_error_ = (error - last_p_error_) / seconds;
  last_p_error_ = error;
  cmd_ = -p_ * error - i_term - d_ * d_error_;
  if (cmd_max_ >= cmd_min_)
    cmd_ = std::min(std::max(cmd_, cmd_min_), cmd_max_);
  return cmd_;
}

// -- SystemPaths --------------------------------------------------------------------------------------------------------------------

namespace
{

std::string variable(const char* name)
{
  const char* value = std::getenv(name);
  return value ? value : "";
}

bool exists(const std::string& path) { return access(path.c_str(), F_OK) == 0; }

}  // namespace

SystemPaths::SystemPaths() : tmp_(variable("TMPDIR").empty() ? "/tmp" : variable("TMPDIR"))
{
  add(gazebo_, variable("GAZEBO_RESOURCE_PATH"));
  add(plugins_, variable("GAZEBO_PLUGIN_PATH"));
  add(models_, variable("GAZEBO_MODEL_PATH"));
}

void SystemPaths::add(std::list<std::string>& list, const std::string& paths)
{
  std::istringstream parts(paths);
  for (std::string path; std::getline(parts, path, ':');)
    if (!path.empty() && std::find(list.begin(), list.end(), path) == list.end())
      list.push_back(path);
}

std::string SystemPaths::GetLogPath() const { return variable("HOME") + "/.gazebo"; }

std::string SystemPaths::FindFileURI(const std::string& uri)
{
  const std::size_t scheme = uri.find("://");
  if (scheme == std::string::npos)
    return FindFile(uri);
  const std::string rest = uri.substr(scheme + 3);
  if (uri.compare(0, scheme, "model") == 0)
    for (const std::string& path : models_)
      if (exists(path + "/" + rest))
        return path + "/" + rest;
  return FindFile(rest);
}

std::string SystemPaths::FindFile(const std::string& filename, bool search_local_path)
{
  if (filename.find("://") != std::string::npos)
    return FindFileURI(filename);
  if (filename.empty() || (filename[0] == '/' && exists(filename)))
    return filename;
  if (search_local_path && exists(filename))
    return filename;
  for (const auto* list : { &gazebo_, &models_ })
    for (const std::string& path : *list)
      if (exists(path + "/" + filename))
        return path + "/" + filename;
  return "";
}

}  // namespace common

// -- Events -------------------------------------------------------------------------------------------------------------------------

namespace event
{
// Never destroyed: plugins end after static objects.
#define GZ_EVENT(name, type) EventT<type>& Events::name = *new EventT<type>;
GZ_EVENT(pause, void(bool))
GZ_EVENT(step, void())
GZ_EVENT(stop, void())
GZ_EVENT(sigInt, void())
GZ_EVENT(worldCreated, void(std::string))
GZ_EVENT(entityCreated, void(std::string))
GZ_EVENT(setSelectedEntity, void(std::string, std::string))
GZ_EVENT(addEntity, void(std::string))
GZ_EVENT(deleteEntity, void(std::string))
GZ_EVENT(worldUpdateBegin, void(const common::UpdateInfo&))
GZ_EVENT(beforePhysicsUpdate, void(const common::UpdateInfo&))
GZ_EVENT(worldUpdateEnd, void())
GZ_EVENT(worldReset, void())
GZ_EVENT(timeReset, void())
GZ_EVENT(preRender, void())
GZ_EVENT(preRenderEnded, void())
GZ_EVENT(render, void())
GZ_EVENT(postRender, void())
GZ_EVENT(diagTimerStart, void(std::string))
GZ_EVENT(diagTimerStop, void(std::string))
GZ_EVENT(removeSensor, void(std::string))
}  // namespace event
}  // namespace gazebo
