from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["moveit_setup_assistant", "moveit_setup_assistant.screens"], package_dir={"": "src"}))
