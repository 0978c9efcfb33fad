from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=["lab_check", "lab_check.checks", "lab_check.report"],
        package_dir={"": "src"},
        package_data={"lab_check": ["spec_schema.json", "sweep_schema.json"]},
    )
)
