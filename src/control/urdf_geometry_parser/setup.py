from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["urdf_geometry_parser"], package_dir={"": "src"}))
