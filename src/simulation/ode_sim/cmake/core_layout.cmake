# A number for how a world lies in memory: of the text of the core's headers. gazebo_cpp reads worlds where ode_sim has put them, and
# each module says with which headers it was built.
file(GLOB core_headers ${CMAKE_CURRENT_LIST_DIR}/../core/*.hpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${core_headers})  # another number when one of them changes
set(core_layout)
foreach(header ${core_headers})
  file(SHA256 ${header} hash)
  string(APPEND core_layout ${hash})
endforeach()
string(SHA256 core_layout "${core_layout}")
set_property(SOURCE core/module.cpp APPEND PROPERTY COMPILE_DEFINITIONS ODE_SIM_LAYOUT="${core_layout}")
