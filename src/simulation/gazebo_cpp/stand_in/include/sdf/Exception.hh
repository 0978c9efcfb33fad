#pragma once
#include <cstdint>
#include <ostream>
#include <sstream>
#include <string>

#include <sdf/Types.hh>

#define sdfthrow(message)                                          \
  {                                                                \
    std::ostringstream sdfthrow_text;                              \
    sdfthrow_text << message << std::endl << std::flush;           \
    throw sdf::Exception(__FILE__, __LINE__, sdfthrow_text.str()); \
  }

namespace sdf
{
inline namespace v12
{

class SDFORMAT_VISIBLE Exception
{
public:
  Exception() = default;
  Exception(const char* file, std::int64_t line, std::string message) : file_(file), line_(line), message_(std::move(message))
  {
  }
  virtual ~Exception() = default;
  std::string GetErrorFile() const { return file_; }
  std::string GetErrorStr() const { return message_; }
  void Print() const;
  friend std::ostream& operator<<(std::ostream& out, const Exception& error) { return out << error.message_; }

private:
  std::string file_;
  std::int64_t line_ = 0;
  std::string message_;
};

class SDFORMAT_VISIBLE InternalError : public Exception
{
public:
  using Exception::Exception;
};

class SDFORMAT_VISIBLE AssertionInternalError : public InternalError
{
public:
  AssertionInternalError(const char* file, std::int64_t line, const std::string& expression, const std::string& function,
                         const std::string& message = "");
};

}  // namespace v12
}  // namespace sdf
