# Messages of Gazebo's transport: their names and numbers are those of the original, so that .proto files of others can import them.
set(proto_folder ${PROJECT_SOURCE_DIR}/proto)
file(GLOB protos CONFIGURE_DEPENDS ${proto_folder}/*.proto)
set(sources)
set(all "")
foreach(proto ${protos})
  get_filename_component(name ${proto} NAME_WE)
  list(APPEND sources ${generated}/${name}.pb.cc)
  list(APPEND headers ${generated}/${name}.pb.h)
  # One file of all: they differ in everything but two static names.
  string(APPEND all "#define schemas schemas_${name}\n#define file_default_instances file_default_instances_${name}\n"
    "#include <gazebo/msgs/${name}.pb.cc>\n#undef schemas\n#undef file_default_instances\n")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/messages.cpp.new "${all}")
configure_file(${PROJECT_BINARY_DIR}/messages.cpp.new ${PROJECT_BINARY_DIR}/messages.cpp COPYONLY)
add_custom_command(OUTPUT ${sources} ${headers} DEPENDS ${protos}
  COMMAND protobuf::protoc --proto_path=${proto_folder} --cpp_out=${generated} ${protos})
add_library(gazebo_msgs SHARED ${PROJECT_BINARY_DIR}/messages.cpp)
set_property(SOURCE ${PROJECT_BINARY_DIR}/messages.cpp APPEND PROPERTY OBJECT_DEPENDS "${sources};${headers}")
target_compile_options(gazebo_msgs PRIVATE -O0 -w)  # generated; what it does is not counted in steps
target_include_directories(gazebo_msgs PUBLIC ${CATKIN_DEVEL_PREFIX}/include ${generated} ${Protobuf_INCLUDE_DIRS})
target_link_libraries(gazebo_msgs PUBLIC ${Protobuf_LIBRARIES})
install(DIRECTORY ${generated} DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}/gazebo FILES_MATCHING PATTERN "*.pb.h")
install(DIRECTORY proto DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}/gazebo/msgs)
foreach(proto ${protos})
  get_filename_component(name ${proto} NAME)
  configure_file(${proto} ${generated}/proto/${name} COPYONLY)
endforeach()

# MessageTypes.hh: all headers, and the pointers that callbacks take.
set(text "#pragma once\n#include <boost/shared_ptr.hpp>\n\n")
set(typedefs "")
foreach(proto ${protos})
  get_filename_component(name ${proto} NAME_WE)
  string(APPEND text "#include <gazebo/msgs/${name}.pb.h>\n")
  file(STRINGS ${proto} messages REGEX "^message ")
  foreach(message ${messages})
    string(REGEX REPLACE "^message ([A-Za-z0-9_]+).*" "\\1" message "${message}")
    string(APPEND typedefs "typedef const boost::shared_ptr<gazebo::msgs::${message} const> Const${message}Ptr;\n")
    string(APPEND in_namespace "using ::Const${message}Ptr;\ntypedef boost::shared_ptr<${message}> ${message}Ptr;\n")
  endforeach()
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/MessageTypes.hh.new
  "${text}\n${typedefs}\nnamespace gazebo\n{\nnamespace msgs\n{\n${in_namespace}}\n}\n")
configure_file(${PROJECT_BINARY_DIR}/MessageTypes.hh.new ${generated}/MessageTypes.hh COPYONLY)
install(FILES ${generated}/MessageTypes.hh DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}/gazebo/msgs)

# Upstream's include folder ends with the version, and packages with messages of their own (underwater vehicles, multicopters) look for the
# one that matches gazebo-[0-9.]+ to find these protos.
set(versioned include/gazebo-11)
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${versioned})
execute_process(COMMAND ${CMAKE_COMMAND} -E create_symlink ../gazebo ${CATKIN_DEVEL_PREFIX}/${versioned}/gazebo)
install(CODE "file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${versioned}\")
  execute_process(COMMAND ${CMAKE_COMMAND} -E create_symlink ../gazebo \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${versioned}/gazebo\")")
