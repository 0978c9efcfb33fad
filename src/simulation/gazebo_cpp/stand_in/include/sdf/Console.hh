#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>

#include <sdf/Types.hh>

#define sdferr (sdf::Console::Instance()->ColorMsg("Error", __FILE__, __LINE__, 31))
#define sdfwarn (sdf::Console::Instance()->ColorMsg("Warning", __FILE__, __LINE__, 33))
#define sdfmsg (sdf::Console::Instance()->ColorMsg("Msg", __FILE__, __LINE__, 32))
#define sdfdbg (sdf::Console::Instance()->Log("Dbg", __FILE__, __LINE__))

namespace sdf
{
inline namespace v12
{

class Console;
typedef std::shared_ptr<Console> ConsolePtr;

/// Where the library says what is wrong: the error output, and not at all while it is quiet.
class SDFORMAT_VISIBLE Console
{
public:
  class SDFORMAT_VISIBLE ConsoleStream
  {
  public:
    explicit ConsoleStream(std::ostream* stream) : stream_(stream) {}
    template <class T>
    ConsoleStream& operator<<(const T& value)
    {
      if (stream_)
        *stream_ << value;
      return *this;
    }
    ConsoleStream& operator<<(std::ostream& (*manipulator)(std::ostream&))
    {
      if (stream_)
        *stream_ << manipulator;
      return *this;
    }
    void Prefix(const std::string& label, const std::string& file, unsigned int line, int colour);
    void SetStream(std::ostream* stream) { stream_ = stream; }
    std::ostream* GetStream() { return stream_; }

  private:
    std::ostream* stream_;
  };

  virtual ~Console() = default;
  static ConsolePtr Instance();
  static void Clear();
  void SetQuiet(bool quiet) { messages_.SetStream(quiet ? nullptr : output_); }
  ConsoleStream& ColorMsg(const std::string& label, const std::string& file, unsigned int line, int colour);
  ConsoleStream& Log(const std::string& label, const std::string& file, unsigned int line);
  ConsoleStream& GetMsgStream() { return messages_; }
  ConsoleStream& GetLogStream() { return log_; }

private:
  Console();

  std::ostream* output_;
  ConsoleStream messages_, log_;
};

}  // namespace v12
}  // namespace sdf
