#pragma once
#include <optional>
#include <ostream>
#include <string>

#include <sdf/Types.hh>

namespace sdf
{
inline namespace v12
{

enum class ErrorCode
{
  NONE = 0,
  FILE_READ,
  DUPLICATE_NAME,
  RESERVED_NAME,
  ATTRIBUTE_MISSING,
  ATTRIBUTE_INVALID,
  ATTRIBUTE_DEPRECATED,
  ATTRIBUTE_INCORRECT_TYPE,
  ELEMENT_MISSING,
  ELEMENT_INVALID,
  ELEMENT_DEPRECATED,
  ELEMENT_INCORRECT_TYPE,
  URI_INVALID,
  URI_LOOKUP,
  DIRECTORY_NONEXISTANT,
  STRING_READ = 28,
};

class SDFORMAT_VISIBLE Error
{
public:
  Error() = default;
  Error(ErrorCode code, const std::string& message) : code_(code), message_(message) {}
  Error(ErrorCode code, const std::string& message, const std::string& file) : Error(code, message) { file_ = file; }
  Error(ErrorCode code, const std::string& message, const std::string& file, int line) : Error(code, message, file)
  {
    line_ = line;
  }
  ErrorCode Code() const { return code_; }
  std::string Message() const { return message_; }
  std::optional<std::string> FilePath() const { return file_; }
  void SetFilePath(const std::string& file) { file_ = file; }
  std::optional<int> LineNumber() const { return line_; }
  void SetLineNumber(int line) { line_ = line; }
  explicit operator bool() const { return code_ != ErrorCode::NONE; }
  bool operator==(bool value) const { return static_cast<bool>(*this) == value; }
  friend SDFORMAT_VISIBLE std::ostream& operator<<(std::ostream& out, const Error& error);

private:
  ErrorCode code_ = ErrorCode::NONE;
  std::string message_;
  std::optional<std::string> file_;
  std::optional<int> line_;
};

}  // namespace v12
}  // namespace sdf
