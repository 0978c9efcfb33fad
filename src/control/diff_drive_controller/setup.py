from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["diff_drive_controller"], package_dir={"": "src"}))
