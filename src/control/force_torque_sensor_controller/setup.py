from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["force_torque_sensor_controller"], package_dir={"": "src"}))
