"""rosmon: launch files run by a process monitor with a terminal interface.

``cli`` and ``launch_file`` say what is to run, ``process`` runs one node, ``monitor`` all of them;
``terminal`` and ``plain`` show it to a person and to a log, ``ros_interface`` to other nodes.
"""


class RosmonError(Exception):
    """The launch cannot go on; one line: what, where, what to do."""
