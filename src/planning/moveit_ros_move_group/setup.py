from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["moveit_ros_move_group", "moveit_ros_move_group.capabilities"], package_dir={"": "src"}))
