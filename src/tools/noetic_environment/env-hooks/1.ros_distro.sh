# Stands in for the hook of the same name of Debian's ros-environment, which says "Debian" and warns about any other word:
# launch files and scripts compare with the name of the distribution they were written for.
export ROS_DISTRO=noetic
