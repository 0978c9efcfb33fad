// Which library defines a symbol, read from the files: nothing is loaded, and nothing of theirs runs.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace compiled_plugins
{

/// Whether the file is all of a library for this machine. One that was cut off (a full disk, an interrupted build) ends the process that
/// loads it.
bool whole_library(const std::string& path);

/// Libraries (lib*.so) that define some of ``symbols`` (mangled names): in the folder of ``library``, and what nobody there does, in
/// those of LD_LIBRARY_PATH. A symbol that two of one folder define is nobody's: which one is meant cannot be known.
std::vector<std::string> definers(const std::string& library, std::set<std::string> symbols);

}  // namespace compiled_plugins
