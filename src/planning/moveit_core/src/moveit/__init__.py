"""Where Noetic has its compiled bindings, ``moveit.core``: they are not supplied, and whoever imports them reads what to use."""

__path__ = __import__("pkgutil").extend_path(__path__, __name__)  # a package of that name elsewhere is found as well
