// Which library defines a symbol, read from the files: nothing is loaded, and nothing of theirs runs.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace compiled_plugins
{

/// Libraries (lib*.so) in the folder of ``library`` that define some of ``symbols`` (mangled names). A symbol that two of them
/// define is nobody's: which one is meant cannot be known.
std::vector<std::string> definers(const std::string& library, const std::set<std::string>& symbols);

}  // namespace compiled_plugins
