# A package's nodes include headers that its messages, services and dynamic parameters become. Many a package does not say so by
# add_dependencies: on a machine of many cores its first build fails, and so does each that compiles before it generates. Here
# headers come first, the package's own and those of packages of one catkin_make.

# At the end of this directory, when all its targets are known.
function(noetic_messages_first)
  if(CMAKE_VERSION VERSION_LESS 3.19)
    return()
  endif()
  get_property(asked DIRECTORY PROPERTY NOETIC_MESSAGES_FIRST)
  if(NOT asked)
    set_property(DIRECTORY PROPERTY NOETIC_MESSAGES_FIRST TRUE)
    cmake_language(EVAL CODE "cmake_language(DEFER CALL _noetic_messages_first)")
  endif()
endfunction()

# Runs in the scope of the directory: catkin's list of what others generate is a variable of it.
function(_noetic_messages_first)
  set(generated)
  foreach(target IN LISTS ${PROJECT_NAME}_EXPORTED_TARGETS catkin_EXPORTED_TARGETS)
    if(NOT TARGET ${target})
      continue()
    endif()
    get_target_property(type ${target} TYPE)
    get_target_property(needed ${target} MANUALLY_ADDED_DEPENDENCIES)
    # What a package compiles for its generators, or gives to others beside headers, waits for nothing.
    _noetic_is_compiled(compiled ${target} ${needed})
    if(type STREQUAL "UTILITY" AND NOT compiled)
      list(APPEND generated ${target})
    endif()
  endforeach()
  if(generated)
    list(REMOVE_DUPLICATES generated)
    _noetic_wait_below("${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}" ${generated})
  endif()
endfunction()

# _noetic_is_compiled(RESULT TARGET...): whether one of these targets is made by a compiler.
function(_noetic_is_compiled result)
  set(${result} FALSE PARENT_SCOPE)
  foreach(target IN LISTS ARGN)
    if(TARGET ${target})
      get_target_property(type ${target} TYPE)
      get_target_property(imported ${target} IMPORTED)
      if(type MATCHES "EXECUTABLE|LIBRARY" AND NOT type STREQUAL "INTERFACE_LIBRARY" AND NOT imported)
        set(${result} TRUE PARENT_SCOPE)
      endif()
    endif()
  endforeach()
endfunction()

# _noetic_wait_below(PACKAGE FOLDER TARGET...): what is compiled in this folder of the package, and below, waits for these targets.
function(_noetic_wait_below package folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    _noetic_is_compiled(compiled ${target})
    if(compiled)
      add_dependencies(${target} ${ARGN})
    endif()
  endforeach()
  get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    string(FIND "${below}/" "${package}/" at)
    if(at EQUAL 0)  # googletest's sources are elsewhere
      _noetic_wait_below("${package}" "${below}" ${ARGN})
    endif()
  endforeach()
endfunction()
