"""URDF as Python objects: :mod:`urdf_parser_py.urdf`."""
