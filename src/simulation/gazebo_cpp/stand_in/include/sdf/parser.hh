#pragma once
#include <string>

#include <sdf/Error.hh>
#include <sdf/SDFImpl.hh>

namespace sdf
{
inline namespace v12
{

/// An empty document that knows what the format describes.
bool SDFORMAT_VISIBLE init(SDFPtr sdf);
SDFPtr SDFORMAT_VISIBLE readFile(const std::string& file);
SDFPtr SDFORMAT_VISIBLE readFile(const std::string& file, Errors& errors);
bool SDFORMAT_VISIBLE readFile(const std::string& file, SDFPtr sdf, Errors& errors);
bool SDFORMAT_VISIBLE readFile(const std::string& file, SDFPtr sdf);
bool SDFORMAT_VISIBLE readString(const std::string& text, SDFPtr sdf, Errors& errors);
bool SDFORMAT_VISIBLE readString(const std::string& text, SDFPtr sdf);
/// Into an element that is described: the first in the text that has its name.
bool SDFORMAT_VISIBLE readString(const std::string& text, ElementPtr element, Errors& errors);
bool SDFORMAT_VISIBLE readString(const std::string& text, ElementPtr element);
/// Describes an element by its name in the format, as "plugin" or "link.sdf".
bool SDFORMAT_VISIBLE initFile(const std::string& name, ElementPtr element);
bool SDFORMAT_VISIBLE initFile(const std::string& name, SDFPtr sdf);

}  // namespace v12
}  // namespace sdf
