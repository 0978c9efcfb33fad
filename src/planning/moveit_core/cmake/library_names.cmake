# library_names(library name...): files lib<name>.so for those who link upstream's libraries one by one. Each is a link to the one
# library that has all of it, in the devel space as when installed.
function(library_names library)
  foreach(name ${ARGN})
    set(link ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION}/lib${name}.so)
    file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION})
    if(NOT IS_SYMLINK ${link})
      execute_process(COMMAND ${CMAKE_COMMAND} -E create_symlink lib${library}.so ${link})
    endif()
    install(FILES ${link} DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  endforeach()
endfunction()
