"""KDL trees from URDF: :mod:`kdl_parser_py.urdf`."""
