"""Attributes that are set on the DOM elements of a file when it is read, and kept by their clones."""

PLACE = "xacro_place"  # where the start tag stands: "file:line"
AS_READ = "xacro_as_read"  # the tag as the file has it
PLAIN_INCLUDE = "xacro_plain_include"  # an <include> without prefix
KEPT = (PLACE, AS_READ, PLAIN_INCLUDE)
CALLED = "xacro_called"  # on a document: names of macros that it calls with prefix
