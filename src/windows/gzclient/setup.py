from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(packages=["gzclient", "gzclient.building", "gzclient.modelling", "gzclient.panels"], package_dir={"": "src"})
)
