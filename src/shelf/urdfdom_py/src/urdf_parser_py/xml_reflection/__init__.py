"""How classes say what they read and write; under upstream's names."""

from urdf_parser_py.xml_reflection import core
from urdf_parser_py.xml_reflection.core import Aggregate, Attribute, Child, Object, ParseError, on_error, on_error_stderr
