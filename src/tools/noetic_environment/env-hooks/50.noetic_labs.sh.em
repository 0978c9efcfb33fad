# Debian's ROS tools start with `env python3`: the workspace's virtual environment (Debian's Python, system packages
# visible) has to come first on PATH. Scripts that catkin gave a fixed interpreter find its modules through PYTHONPATH.
_noetic_labs_venv="@(CMAKE_CURRENT_SOURCE_DIR)/../../../.venv"
_noetic_labs_venv=$(cd "$_noetic_labs_venv" 2>/dev/null && pwd)
if [ -n "$_noetic_labs_venv" ]; then
  case ":$PATH:" in
    *":$_noetic_labs_venv/bin:"*) ;;
    *) PATH="$CATKIN_ENV_HOOK_WORKSPACE/bin:$_noetic_labs_venv/bin:$PATH" ;;
  esac
  for _noetic_labs_site in "$_noetic_labs_venv"/lib/python3.*/site-packages; do
    case ":$PYTHONPATH:" in
      *":$_noetic_labs_site:"*) ;;
      *) PYTHONPATH="$PYTHONPATH:$_noetic_labs_site" ;;
    esac
  done
  export PATH PYTHONPATH
fi
unset _noetic_labs_venv _noetic_labs_site
