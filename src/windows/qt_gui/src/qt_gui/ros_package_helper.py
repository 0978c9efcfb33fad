"""Facts of a ROS package, for the help of its plugins."""

import xml.etree.ElementTree as ET

import rospkg


def get_package_path(name):
    """The folder of a package.

    :raises rospkg.ResourceNotFound: there is none of that name.
    """
    return rospkg.RosPack().get_path(name)


def package_facts(name, path=None):
    """``version``, ``description``, ``maintainer``, ``url`` as far as the package.xml of the package ``name`` has them.

    :param path: the package's folder; None: it is looked for
    """
    try:
        root = ET.parse(f"{path or get_package_path(name)}/package.xml").getroot()
    except (rospkg.ResourceNotFound, OSError, ET.ParseError):
        return {}
    urls = [(element.get("type", "website") != "website", (element.text or "").strip()) for element in root.findall("url")]
    described = root.find("description")
    return {
        "version": (root.findtext("version") or "").strip(),
        "description": "" if described is None else " ".join("".join(described.itertext()).split())[:500],
        "maintainer": (root.findtext("maintainer") or "").strip(),
        "url": min(urls)[1] if urls else "",
    }
