@[if DEVELSPACE]@
_noetic_labs_here="@(CMAKE_CURRENT_SOURCE_DIR)"
_noetic_labs_add_ons=$(cd "$_noetic_labs_here/../../.." && pwd)/.python  # scripts/setup installs them at the top of the clone
@[else]@
_noetic_labs_here="$CATKIN_ENV_HOOK_WORKSPACE/share/noetic_environment"
_noetic_labs_add_ons="$_noetic_labs_here/python"
@[end if]@

# PyPI add-ons come after the modules of all workspaces.
case ":$PYTHONPATH:" in
  *":$_noetic_labs_add_ons:"*) ;;
  *) PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$_noetic_labs_add_ons" ;;
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

# Debian's roslib names a folder that Debian does not have, which roswtf reports as an error.
if [ ! -d "$ROS_ROOT" ]; then
  export ROS_ROOT=/usr/share/roslib
fi

unset _noetic_labs_here _noetic_labs_add_ons _noetic_labs_rosdep
