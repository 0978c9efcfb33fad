# What the C++ headers of Noetic's compiler (GCC 9) included beside what they are named for, and those of GCC 12 and 14 do not: packages
# that include <memory> and use std::array compile there. From `g++ -H` of GCC 10 with its own headers, at C++14 and 17, less what
# `g++ -H` of GCC 12 or of 14 shows; <stdexcept> in <array> is from "Porting to GCC 10" (gcc.gnu.org/gcc-10/porting_to.html).
# One line each: header, ":", what comes with it, "|" and what comes with it from C++17 on. What another of them brings is left out.
set(NOETIC_STANDARD_HEADERS
  "algorithm: | array functional limits optional tuple unordered_map vector"
  "any: | exception utility"
  "array: stdexcept utility |"
  "bitset: exception typeinfo |"
  "codecvt: exception typeinfo |"
  "complex: cstdint |"
  "condition_variable: array cctype chrono cstdio cstdlib system_error |"
  "deque: exception typeinfo |"
  "functional: array cstdlib | algorithm limits optional"
  "future: chrono memory thread |"
  "iomanip: tuple |"
  "ios: cstdint |"
  "iterator: cstdint |"
  "list: exception typeinfo |"
  "locale: tuple |"
  "map: tuple | optional"
  "memory: array cstdint iterator |"
  "mutex: cctype chrono cstdio cstdlib functional memory system_error |"
  "new: exception type_traits typeinfo |"
  "optional: utility |"
  "queue: exception typeinfo |"
  "random: exception typeinfo |"
  "regex: algorithm atomic cstring iterator limits map memory |"
  "scoped_allocator: atomic functional memory |"
  "set: exception typeinfo | optional"
  "shared_mutex: condition_variable mutex |"
  "stack: exception typeinfo |"
  "stdexcept: cstdint |"
  "string: cstdint exception typeinfo |"
  "string_view: cstdint |"
  "system_error: cstdint |"
  "thread: array atomic chrono memory |"
  "tuple: array initializer_list |"
  "unordered_map: array exception limits typeinfo | optional"
  "unordered_set: array exception limits typeinfo | optional"
  "valarray: exception | algorithm"
  "variant: exception typeinfo utility |"
  "vector: exception typeinfo |")

# Leaves a file that says so already: whoever includes it would be compiled again.
function(noetic_write_if_other file text)
  set(before "")
  if(EXISTS "${file}")
    file(READ "${file}" before)
  endif()
  if(NOT before STREQUAL text)
    file(WRITE "${file}" "${text}")
  endif()
endfunction()

# For each header of the compiler one in FOLDER, which includes the compiler's. Within the library's own headers nothing is added: they are
# not complete yet. When the one that a source includes is, noetic_standard_headers brings what comes with it and with all that it included.
function(noetic_write_standard_headers folder)
  set(others "#pragma GCC system_header\n")
  foreach(line IN LISTS NOETIC_STANDARD_HEADERS)
    if(NOT line MATCHES "^([a-z_]+):([a-z_ ]*)[|]([a-z_ ]*)$")
      message(FATAL_ERROR "standard_headers.cmake: '${line}' is no 'header: names | names'.")
    endif()
    set(header ${CMAKE_MATCH_1})
    set(later "${CMAKE_MATCH_3}")
    string(REGEX MATCHALL "[a-z_]+" always "${CMAKE_MATCH_2}")
    string(REGEX MATCHALL "[a-z_]+" later "${later}")
    string(APPEND others "#if defined(NOETIC_SEEN_${header}) && !defined(NOETIC_BROUGHT_${header})\n#define NOETIC_BROUGHT_${header}\n")
    foreach(name IN LISTS always)
      string(APPEND others "#include <${name}>\n")
    endforeach()
    if(later)
      string(APPEND others "#if __cplusplus >= 201703L\n")
      foreach(name IN LISTS later)
        string(APPEND others "#include <${name}>\n")
      endforeach()
      string(APPEND others "#endif\n")
    endif()
    string(APPEND others "#endif\n")
  endforeach()
  noetic_write_if_other("${folder}/noetic_standard_headers" "${others}")
  foreach(library IN LISTS CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
    if(NOT EXISTS "${library}/forward_list")
      continue()
    endif()
    file(GLOB headers RELATIVE "${library}" "${library}/*")
    list(FILTER headers INCLUDE REGEX "^[a-z_]+$")
    foreach(header IN LISTS headers)
      if(NOT IS_DIRECTORY "${library}/${header}")
        string(CONCAT text
          "#pragma GCC system_header\n"
          "#define NOETIC_SEEN_${header}\n"
          "#ifdef NOETIC_INSIDE_THE_LIBRARY\n"
          "#include_next <${header}>\n"
          "#else\n"
          "#define NOETIC_INSIDE_THE_LIBRARY\n"
          "#include_next <${header}>\n"
          "#undef NOETIC_INSIDE_THE_LIBRARY\n"
          "#include <noetic_standard_headers>\n"
          "#endif\n")
        noetic_write_if_other("${folder}/${header}" "${text}")
      endif()
    endforeach()
  endforeach()
endfunction()
