#pragma once
#include <functional>
#include <memory>
#include <string>

#include <sdf/Element.hh>

namespace sdf
{
inline namespace v12
{

class SDF;
typedef std::shared_ptr<SDF> SDFPtr;

/// A file as it stands, in folders of addURIPath and of SDF_PATH, and where the callback finds it.
std::string SDFORMAT_VISIBLE findFile(const std::string& name, bool local = true, bool callback = false);
void SDFORMAT_VISIBLE addURIPath(const std::string& uri, const std::string& path);
void SDFORMAT_VISIBLE setFindCallback(std::function<std::string(const std::string&)> callback);

/// A document.
class SDFORMAT_VISIBLE SDF
{
public:
  SDF();
  ~SDF() = default;
  void PrintValues() const;
  void Write(const std::string& file);
  std::string ToString() const;
  void SetFromString(const std::string& text);
  void Clear();
  ElementPtr Root() const { return root_; }
  void Root(const ElementPtr root) { root_ = root; }
  std::string FilePath() const { return path_; }
  void SetFilePath(const std::string& path) { path_ = path; }
  void SetOriginalVersion(const std::string& version) { version_ = version; }
  const std::string& OriginalVersion() const { return version_; }
  static std::string Version() { return version(); }
  static void Version(const std::string& value) { version() = value; }
  static ElementPtr WrapInRoot(const ElementPtr& element);

private:
  static std::string& version();

  ElementPtr root_;
  std::string path_, version_;
};

}  // namespace v12
}  // namespace sdf
