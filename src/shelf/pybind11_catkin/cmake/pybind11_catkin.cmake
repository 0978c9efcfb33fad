# pybind11_add_module(...) and all that pybind11's own package gives, which is Debian's;
# pybind_add_module(NAME SOURCE...): a module linked with catkin_LIBRARIES that Python finds in the devel space;
# PYTHON_LIBRARIES and PYTHON_INCLUDE_DIRS, as pybind11 gave them in Noetic.
set(Python_EXECUTABLE ${PYTHON_EXECUTABLE})  # the one that catkin took
find_package(Python REQUIRED COMPONENTS Interpreter Development)
cmake_policy(PUSH)
cmake_policy(VERSION 3.10)  # pybind11's functions keep the policies of this place; packages of Noetic ask for those of CMake 3.0
find_package(pybind11 REQUIRED)
cmake_policy(POP)
set(PYTHON_LIBRARIES ${Python_LIBRARIES})
set(PYTHON_INCLUDE_DIRS ${Python_INCLUDE_DIRS})
list(APPEND pybind11_catkin_INCLUDE_DIRS ${PYTHON_INCLUDE_DIRS})

macro(pybind_add_module target)
  pybind11_add_module(${target} ${ARGN})
  target_link_libraries(${target} PRIVATE ${catkin_LIBRARIES})
  set_target_properties(${target} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION})
endmacro()
