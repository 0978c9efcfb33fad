#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/Exception.hh>

#include <algorithm>
#include <cctype>
#include <iostream>

namespace sdf
{
inline namespace v12
{

std::vector<std::string> split(const std::string& text, const std::string& splitter)
{
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(splitter); at != std::string::npos; at = text.find(splitter, from))
  {
    parts.push_back(text.substr(from, at - from));
    from = at + splitter.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

std::string trim(const std::string& text)
{
  const char* const space = " \t\n\r\v\f";
  const std::size_t first = text.find_first_not_of(space);
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string trim(const char* text) { return trim(std::string(text)); }

std::string lowercase(const std::string& text)
{
  std::string result = text;
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::pair<std::string, std::string> SplitName(const std::string& absolute)
{
  const std::size_t at = absolute.rfind(kSdfScopeDelimiter);
  if (at == std::string::npos)
    return { "", absolute };
  return { absolute.substr(0, at), absolute.substr(at + kSdfScopeDelimiter.size()) };
}

std::string JoinName(const std::string& scope, const std::string& local)
{
  if (scope.empty() || local.empty())
    return scope + local;
  const bool ends = scope.size() > 1 && scope.compare(scope.size() - 2, 2, kSdfScopeDelimiter) == 0;
  const bool begins = local.compare(0, 2, kSdfScopeDelimiter) == 0;
  return scope + (ends || begins ? "" : kSdfScopeDelimiter) + local;
}

std::ostream& operator<<(std::ostream& out, const Error& error)
{
  out << "Error Code " << static_cast<int>(error.code_) << ":";
  if (error.file_)
    out << " [" << *error.file_ << (error.line_ ? ":L" + std::to_string(*error.line_) : "") << "]:";
  return out << " Msg: " << error.message_;
}

void Exception::Print() const { sdferr << "EXCEPTION: " << message_ << " (" << file_ << ":" << line_ << ")\n"; }

AssertionInternalError::AssertionInternalError(const char* file, std::int64_t line, const std::string& expression,
                                               const std::string& function, const std::string& message)
  : InternalError(file, line, message + " (" + expression + " in " + function + ")")
{
}

Console::Console() : output_(&std::cerr), messages_(&std::cerr), log_(nullptr) {}

namespace
{
ConsolePtr& console()
{
  static ConsolePtr one;
  return one;
}
}  // namespace

ConsolePtr Console::Instance()
{
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (!console())
    console().reset(new Console());
  return console();
}

void Console::Clear() { console().reset(); }

void Console::ConsoleStream::Prefix(const std::string& label, const std::string& file, unsigned int line, int colour)
{
  const std::size_t slash = file.find_last_of('/');
  *this << "\033[1;" << colour << "m" << label << " [" << (slash == std::string::npos ? file : file.substr(slash + 1)) << ":"
        << line << "]\033[0m ";
}

Console::ConsoleStream& Console::ColorMsg(const std::string& label, const std::string& file, unsigned int line, int colour)
{
  messages_.Prefix(label, file, line, colour);
  return messages_;
}

Console::ConsoleStream& Console::Log(const std::string& label, const std::string& file, unsigned int line)
{
  log_.Prefix(label, file, line, 0);
  return log_;
}

}  // namespace v12
}  // namespace sdf
