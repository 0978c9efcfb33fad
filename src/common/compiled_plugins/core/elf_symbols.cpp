#include "elf_symbols.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <elf.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <link.h>
#include <map>
#include <sstream>

namespace fs = std::filesystem;

namespace compiled_plugins
{
namespace
{

/// A record at an offset of a file; false if the file ends before.
template <class T>
bool at(const std::string& file, std::size_t offset, T& record)
{
  if (offset > file.size() || file.size() - offset < sizeof(T))
    return false;
  std::memcpy(&record, file.data() + offset, sizeof(T));
  return true;
}

/// Those of ``symbols`` that the table of one section of ``file`` defines.
void look_up(const std::string& file, const ElfW(Shdr) & table, const ElfW(Shdr) & names, const std::set<std::string>& symbols,
             std::set<std::string>& found)
{
  if (names.sh_size > file.size() || names.sh_offset > file.size() - names.sh_size)
    return;
  ElfW(Sym) symbol;
  for (std::size_t offset = 0; offset + sizeof(symbol) <= table.sh_size && at(file, table.sh_offset + offset, symbol);
       offset += sizeof(symbol))
  {
    if (symbol.st_shndx == SHN_UNDEF || symbol.st_name >= names.sh_size)
      continue;
    const char* const name = file.data() + names.sh_offset + symbol.st_name;
    const std::string text(name, strnlen(name, names.sh_size - symbol.st_name));
    if (symbols.count(text))
      found.insert(text);
  }
}

std::string content(const fs::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

/// False if it is no library of this machine's kind.
bool read_header(const std::string& file, ElfW(Ehdr) & header)
{
  return at(file, 0, header) && std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
         header.e_ident[EI_CLASS] == (sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32);
}

/// Those of ``symbols`` that a library defines for others; none of what is no library of this machine's kind.
std::set<std::string> defined(const fs::path& path, const std::set<std::string>& symbols)
{
  std::set<std::string> found;
  const std::string file = content(path);
  ElfW(Ehdr) header;
  if (!read_header(file, header))
    return found;
  const auto section = [&](std::size_t index, ElfW(Shdr) & record) {
    return index < header.e_shnum && at(file, header.e_shoff + index * header.e_shentsize, record);
  };
  ElfW(Shdr) table, names;
  for (std::size_t index = 0; section(index, table); ++index)
    if (table.sh_type == SHT_DYNSYM && section(table.sh_link, names))
      look_up(file, table, names, symbols, found);
  return found;
}

/// That of the library, then those that the loader searches: of the sourced workspaces.
std::vector<std::string> folders(const std::string& library)
{
  std::vector<std::string> all{ fs::path(library).parent_path().lexically_normal().string() };
  const char* const path = std::getenv("LD_LIBRARY_PATH");
  std::istringstream rest(path ? path : "");
  for (std::string folder; std::getline(rest, folder, ':');)
  {
    folder = fs::path(folder).lexically_normal().string();
    if (!folder.empty() && std::find(all.begin(), all.end(), folder) == all.end())
      all.push_back(folder);
  }
  return all;
}

}  // namespace

bool whole_library(const std::string& path)
{
  const std::string file = content(path);
  ElfW(Ehdr) header;
  if (!read_header(file, header) || header.e_type != ET_DYN)
    return false;
  ElfW(Phdr) segment;
  for (std::size_t index = 0; index < header.e_phnum; ++index)
    if (!at(file, header.e_phoff + index * header.e_phentsize, segment) || segment.p_offset > file.size() ||
        segment.p_filesz > file.size() - segment.p_offset)
      return false;
  return header.e_phnum > 0;
}

std::vector<std::string> definers(const std::string& library, std::set<std::string> symbols)
{
  std::vector<std::string> libraries;
  const fs::path own = fs::path(library).filename();
  for (const std::string& folder : folders(library))
  {
    if (symbols.empty())
      break;
    std::error_code error;
    std::map<std::string, std::vector<std::string>> whose;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".so" && entry.path().filename() != own)
        for (const std::string& symbol : defined(entry.path(), symbols))
          whose[symbol].push_back(entry.path().string());
    std::set<std::string> sorted;
    for (const auto& [symbol, those] : whose)
    {
      symbols.erase(symbol);
      if (those.size() == 1)
        sorted.insert(those.front());
    }
    libraries.insert(libraries.end(), sorted.begin(), sorted.end());
  }
  return libraries;
}

}  // namespace compiled_plugins
