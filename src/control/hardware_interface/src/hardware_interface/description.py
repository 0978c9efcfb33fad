"""The robot description: one reading of its text for limits, transmissions and geometry."""

from __future__ import annotations

from functools import lru_cache
from xml.etree import ElementTree

import lenient_xml


@lru_cache(maxsize=4)  # of every robot its hardware and each of its controllers ask
def description_root(urdf: str) -> ElementTree.Element:
    """The root element of ``urdf``, a text. The same text gives the same element: nobody may change it.

    Read as by TinyXML, which Gazebo and ros_control read with: blank lines before the XML declaration do no harm, nor does a bare ``&``.

    :raises ElementTree.ParseError: the text is no XML
    """
    return lenient_xml.fromstring(urdf)
