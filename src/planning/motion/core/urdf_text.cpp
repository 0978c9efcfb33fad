#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "model_builder.hpp"

namespace motion
{
namespace
{
// urdfdom says what is wrong on the console only, each fault twice (what it is, then in which link): hold its mouth and keep that.
class Listener : public console_bridge::OutputHandler
{
public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override
  {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      return;
    if (first.empty())
      first = text.substr(0, 200);
    const std::size_t link = text.find(" element for Link [");
    if (text.compare(0, 16, "Could not parse ") != 0 || link == std::string::npos)
    {
      reason = text.substr(0, 200);
      return;
    }
    if (faults.size() < 20)
      faults.push_back("link '" + text.substr(link + 19, text.size() - link - 20) + "': its <" + text.substr(16, link - 16) +
                       "> is at fault (" + reason + "); nothing behind it in this link is read");
  }
  std::string first, reason;
  std::vector<std::string> faults;
};
}  // namespace

urdf::ModelInterfaceSharedPtr parseUrdf(const std::string& text, std::vector<std::string>& faults)
{
  static std::mutex one_at_a_time;
  std::lock_guard<std::mutex> lock(one_at_a_time);
  Listener listener;
  console_bridge::OutputHandler* before = console_bridge::getOutputHandler();
  console_bridge::useOutputHandler(&listener);
  urdf::ModelInterfaceSharedPtr urdf;
  std::string thrown;
  try
  {
    urdf = urdf::parseURDF(text);
  }
  catch (const std::exception& error)
  {
    thrown = error.what();
  }
  console_bridge::useOutputHandler(before);
  if (!urdf)
  {
    std::string why = !thrown.empty() ? thrown : !listener.first.empty() ? listener.first : "it is not a robot description";
    for (char& c : why)
      if (c == '\n')
        c = ' ';
    throw ModelError("the URDF cannot be read: " + why);
  }
  if (!urdf->getRoot())
    throw ModelError("the URDF '" + urdf->getName() + "' has no root link");
  faults.insert(faults.end(), listener.faults.begin(), listener.faults.end());
  return urdf;
}
}  // namespace motion
