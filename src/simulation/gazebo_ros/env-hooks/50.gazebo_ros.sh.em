# gazebo, gzserver, gzclient and gz as commands of the shell

@[if DEVELSPACE]@
_gazebo_ros_bin="@(CMAKE_CURRENT_SOURCE_DIR)/bin"
@[else]@
if [ -z "$CATKIN_ENV_HOOK_WORKSPACE" ]; then
  CATKIN_ENV_HOOK_WORKSPACE="@(CMAKE_INSTALL_PREFIX)"
fi
_gazebo_ros_bin="$CATKIN_ENV_HOOK_WORKSPACE/share/gazebo_ros/bin"
@[end if]@
case ":$PATH:" in
  *":$_gazebo_ros_bin:"*) ;;
  *) export PATH="$_gazebo_ros_bin:$PATH" ;;
esac
unset _gazebo_ros_bin
