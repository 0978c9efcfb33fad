# Packages that name gazebo_dev or gazebo_ros have the variables of find_package(gazebo), too.
find_package(gazebo QUIET PATHS "${CMAKE_CURRENT_LIST_DIR}/../../gazebo/cmake")
