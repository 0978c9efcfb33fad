# roslint_cpp([FILE...]), roslint_python([FILE...]), roslint_custom(COMMAND OPTIONS FILE...), roslint_add_test()
#
# The checkers are Debian's cpplint and pycodestyle. They run with `make roslint` or `make roslint_PACKAGE`, never in a build.
# Options: ROSLINT_CPP_OPTS, ROSLINT_PYTHON_OPTS; other checkers: ROSLINT_CPP_CMD, ROSLINT_PYTHON_CMD (lists).
include_guard(GLOBAL)

macro(_roslint_create_targets)  # packages that bring checkers of their own call it
  if(NOT TARGET roslint)
    add_custom_target(roslint)
  endif()
  if(NOT TARGET roslint_${PROJECT_NAME})
    add_custom_target(roslint_${PROJECT_NAME})
    add_dependencies(roslint roslint_${PROJECT_NAME})
  endif()
endmacro()

function(roslint_custom command options)
  if(NOT ARGN)
    message(WARNING "roslint: ${PROJECT_NAME} names no files for ${command}")
    return()
  endif()
  _roslint_create_targets()
  separate_arguments(options)
  add_custom_command(TARGET roslint_${PROJECT_NAME} POST_BUILD WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    COMMAND ${command} ${options} ${ARGN} VERBATIM)
endfunction()

function(roslint_cpp)
  if(NOT ARGN)
    file(GLOB_RECURSE ARGN ${PROJECT_SOURCE_DIR}/*.cpp ${PROJECT_SOURCE_DIR}/*.h ${PROJECT_SOURCE_DIR}/*.hpp)
  endif()
  if(NOT DEFINED ROSLINT_CPP_CMD)
    # ROS style, where it differs from Google's: lines of 120, braces on lines of their own, headers of C++11.
    set(ROSLINT_CPP_CMD cpplint --quiet --linelength=120
      --filter=-whitespace/braces,-build/c++11,-build/header_guard,-legal/copyright,-runtime/references,-build/include_subdir)
  endif()
  roslint_custom("${ROSLINT_CPP_CMD}" "${ROSLINT_CPP_OPTS}" ${ARGN})
endfunction()

function(roslint_python)
  if(NOT ARGN)
    file(GLOB_RECURSE ARGN ${PROJECT_SOURCE_DIR}/*.py)
  endif()
  if(NOT DEFINED ROSLINT_PYTHON_CMD)
    set(ROSLINT_PYTHON_CMD pycodestyle --max-line-length=120)
  endif()
  roslint_custom("${ROSLINT_PYTHON_CMD}" "${ROSLINT_PYTHON_OPTS}" ${ARGN})
endfunction()

function(roslint_add_test)
  if(NOT TARGET roslint_${PROJECT_NAME})
    message(WARNING "roslint: call roslint_cpp or roslint_python before roslint_add_test in ${PROJECT_NAME}")
  elseif(CATKIN_ENABLE_TESTING)
    add_test(NAME roslint_${PROJECT_NAME} COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target roslint_${PROJECT_NAME})
  endif()
endfunction()
