# Packages that say -Werror are free of the warnings of Noetic's compiler (GCC 9), not of those that later ones have learnt or that this
# system's newer libraries cause: such a warning stays one. From the changes of GCC 10 to 14 ("C family" and "C++" of each
# gcc.gnu.org/gcc-N/changes.html): what -Wall, -Wextra or nothing turns on. The last line is what depends on the optimizer, which every
# release changes, and on the libraries.
set(NOETIC_WARNINGS_10 zero-length-bounds comma-subscript volatile)
set(NOETIC_WARNINGS_11 range-loop-construct deprecated-enum-enum-conversion deprecated-enum-float-conversion mismatched-new-delete
  mismatched-dealloc array-parameter vla-parameter stringop-overread sizeof-array-div exceptions)
set(NOETIC_WARNINGS_12 dangling-pointer use-after-free infinite-recursion array-compare interference-size missing-requires address)
set(NOETIC_WARNINGS_13 overloaded-virtual dangling-reference self-move redundant-move pessimizing-move xor-used-as-pow)
set(NOETIC_WARNINGS_14 template-id-cdtor calloc-transposed-args alloc-size)
set(NOETIC_WARNINGS_OF_EACH maybe-uninitialized array-bounds stringop-overflow stringop-truncation restrict nonnull free-nonheap-object
  format-overflow format-truncation deprecated-declarations deprecated-copy)

# For the targets of this directory and of those below. GCC 14 made errors of what C let pass with a warning, too.
function(noetic_keep_newer_warnings)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(names ${NOETIC_WARNINGS_OF_EACH})
    foreach(version 10 11 12 13 14)
      if(NOT CMAKE_CXX_COMPILER_VERSION VERSION_LESS ${version})
        list(APPEND names ${NOETIC_WARNINGS_${version}})
      endif()
    endforeach()
    foreach(name IN LISTS names)
      add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:-Wno-error=${name}>")
    endforeach()
  endif()
  if(CMAKE_C_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_C_COMPILER_VERSION VERSION_LESS 14)
    add_compile_options("$<$<COMPILE_LANGUAGE:C>:-fpermissive>")
  endif()
endfunction()
