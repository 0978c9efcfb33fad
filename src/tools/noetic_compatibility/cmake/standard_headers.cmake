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

# What a header of this name is to say.
function(noetic_standard_header header result)
  string(CONCAT text
    "#pragma GCC system_header\n"
    "#ifdef NOETIC_STANDARD_INSIDE\n"
    "#include_next <${header}>\n"
    "#else\n"
    "#define NOETIC_STANDARD_INSIDE\n"
    "#include_next <${header}>\n"
    "#undef NOETIC_STANDARD_INSIDE\n")
  set(line "${NOETIC_STANDARD_HEADERS}")
  list(FILTER line INCLUDE REGEX "^${header}:")
  if(line MATCHES ":([a-z_ ]*)[|]([a-z_ ]*)$")
    set(later "${CMAKE_MATCH_2}")
    string(REGEX MATCHALL "[a-z_]+" always "${CMAKE_MATCH_1}")
    string(REGEX MATCHALL "[a-z_]+" later "${later}")
    string(APPEND text "#ifndef NOETIC_STANDARD_${header}\n#define NOETIC_STANDARD_${header}\n")
    foreach(name IN LISTS always)
      string(APPEND text "#include <${name}>\n")
    endforeach()
    if(later)
      string(APPEND text "#if __cplusplus >= 201703L\n")
      foreach(name IN LISTS later)
        string(APPEND text "#include <${name}>\n")
      endforeach()
      string(APPEND text "#endif\n")
    endif()
    string(APPEND text "#endif\n")
  endif()
  set(${result} "${text}#endif\n" PARENT_SCOPE)
endfunction()

# For each header of the compiler one in FOLDER, which includes the compiler's and then the others. Within the library's own headers nothing
# is added: they are not complete yet. The first that a source includes brings the others; so those that bring nothing have one as well
# (<forward_list> includes <tuple> before it is complete).
function(noetic_write_standard_headers folder)
  foreach(library IN LISTS CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
    if(NOT EXISTS "${library}/forward_list")
      continue()
    endif()
    file(GLOB headers RELATIVE "${library}" "${library}/*")
    list(FILTER headers INCLUDE REGEX "^[a-z_]+$")
    foreach(header IN LISTS headers)
      if(IS_DIRECTORY "${library}/${header}")
        continue()
      endif()
      noetic_standard_header("${header}" text)
      set(before "")
      if(EXISTS "${folder}/${header}")
        file(READ "${folder}/${header}" before)
      endif()
      if(NOT before STREQUAL text)  # whoever includes it would be compiled again
        file(WRITE "${folder}/${header}" "${text}")
      endif()
    endforeach()
  endforeach()
endfunction()
