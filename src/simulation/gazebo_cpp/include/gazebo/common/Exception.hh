#pragma once
#include <exception>
#include <iostream>
#include <sstream>
#include <string>

#include <gazebo/util/system.hh>

#define gzthrow(msg)                                                        \
  {                                                                         \
    std::ostringstream throwStream;                                         \
    throwStream << msg << std::endl << std::flush;                          \
    throw gazebo::common::Exception(__FILE__, __LINE__, throwStream.str()); \
  }

namespace gazebo
{
namespace common
{

class GAZEBO_VISIBLE Exception : public std::exception
{
public:
  Exception() = default;
  Exception(const char* file, int64_t line, std::string message);
  ~Exception() override = default;
  std::string GetErrorFile() const { return file_; }
  std::string GetErrorStr() const { return text_; }
  void Print() const { std::cerr << file_ << ":" << line_ << ": " << text_ << std::endl; }
  const char* what() const noexcept override { return text_.c_str(); }
  friend std::ostream& operator<<(std::ostream& out, const Exception& error)
  {
    return out << error.file_ << ":" << error.line_ << ": " << error.text_;
  }

private:
  std::string file_, text_;
  int64_t line_ = 0;
};

class GAZEBO_VISIBLE InternalError : public Exception
{
public:
  InternalError() = default;
  InternalError(const char* file, int64_t line, const std::string& message) : Exception(file, line, message) {}
};

class GAZEBO_VISIBLE AssertionInternalError : public InternalError
{
public:
  AssertionInternalError(const char* file, int64_t line, const std::string& expression, const std::string& function,
                         const std::string& message = "")
    : InternalError(file, line, "assertion (" + expression + ") failed in " + function + ": " + message)
  {
  }
};

}  // namespace common
}  // namespace gazebo
