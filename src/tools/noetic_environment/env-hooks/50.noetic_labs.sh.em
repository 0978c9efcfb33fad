@[if DEVELSPACE]@
_noetic_labs_here="@(CMAKE_CURRENT_SOURCE_DIR)"
_noetic_labs_add_ons=$(cd "$_noetic_labs_here/../../.." && pwd)/.python  # scripts/setup installs them at the top of the clone
@[else]@
_noetic_labs_here="$CATKIN_ENV_HOOK_WORKSPACE/share/noetic_environment"
_noetic_labs_add_ons="$_noetic_labs_here/python"
@[end if]@

# After the modules of all workspaces come names that Noetic's Python had, and the PyPI add-ons.
case ":$PYTHONPATH:" in
  *":$_noetic_labs_add_ons:"*) ;;
  *)
    PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$_noetic_labs_here/noetic_python:$_noetic_labs_add_ons"
    if [ -d "$_noetic_labs_add_ons-teaching" ]; then  # scripts/setup --teaching
      PYTHONPATH="$PYTHONPATH:$_noetic_labs_add_ons-teaching"
    fi ;;
esac
export PYTHONPATH

# ROS nodes start with `env python3`. Where that is an interpreter that knows no rospy (pyenv, conda, a closed virtual
# environment), a folder with nothing but a link to Debian's python3 goes before it; pip, python and the rest stay as they are.
case "$(command -v python3)" in
  /usr/bin/python3|/bin/python3|"$_noetic_labs_here/debian_python/python3") ;;
  *)
    if ! python3 -c 'import importlib.util as u, sys; sys.exit(not all(map(u.find_spec, ("rospy", "rospkg", "yaml"))))' 2>/dev/null; then
      PATH="$_noetic_labs_here/debian_python:$PATH"
      export PATH
    fi ;;
esac

# rosdep without a network: rules for what is supplied here and what Debian has. A choice of the user's own stays.
_noetic_labs_rosdep="$CATKIN_ENV_HOOK_WORKSPACE/share/noetic_environment/rosdep"
export ROSDEP_SOURCE_PATH="${ROSDEP_SOURCE_PATH:-$_noetic_labs_rosdep}"
export ROSDISTRO_INDEX_URL="${ROSDISTRO_INDEX_URL:-file://$_noetic_labs_rosdep/index.yaml}"

# Debian's roslib names a folder that Debian does not have, which roswtf reports as an error, as one of another name than ros.
if [ ! -d "$ROS_ROOT" ]; then
  export ROS_ROOT="$CATKIN_ENV_HOOK_WORKSPACE/share/noetic_environment/ros"
fi

@[if DEVELSPACE]@
# The clone's labs are leaves: whoever builds a workspace on the clone stands on the platform alone, so that no file of a lab
# stands in for one that is missing there. catkin finds files by the list .catkin, thus the labs are taken off it; the clone's
# own shells find them by ROS_PACKAGE_PATH.
_noetic_labs_labs=$(cd "$_noetic_labs_here/../../labs" 2>/dev/null && pwd)
_noetic_labs_list=$CATKIN_ENV_HOOK_WORKSPACE/.catkin
_noetic_labs_without() {  # LIST SEPARATOR: the list without what is below labs
  printf '%s' "$1" | tr "$2" '\n' | grep -vF "$_noetic_labs_labs/" | paste -s -d "$2" -
}
if [ -n "$_noetic_labs_labs" ]; then
  if grep -qF "$_noetic_labs_labs/" "$_noetic_labs_list" 2>/dev/null && [ -w "$CATKIN_ENV_HOOK_WORKSPACE" ]; then
    printf '%s' "$(_noetic_labs_without "$(cat "$_noetic_labs_list")" ';')" > "$_noetic_labs_list.$$" \
      && mv "$_noetic_labs_list.$$" "$_noetic_labs_list"
  fi
  ROS_PACKAGE_PATH=$(_noetic_labs_without "$ROS_PACKAGE_PATH" ':')
  if [ "${CMAKE_PREFIX_PATH%%:*}" = "$CATKIN_ENV_HOOK_WORKSPACE" ]; then
    ROS_PACKAGE_PATH="${ROS_PACKAGE_PATH:+$ROS_PACKAGE_PATH:}$_noetic_labs_labs"
  fi
  export ROS_PACKAGE_PATH
fi
unset -f _noetic_labs_without
unset _noetic_labs_labs _noetic_labs_list
@[end if]@
unset _noetic_labs_here _noetic_labs_add_ons _noetic_labs_rosdep
