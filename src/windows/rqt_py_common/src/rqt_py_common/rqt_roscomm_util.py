"""Packages, files and parameters, for plugins about launch files."""

import os

import rosgraph
import rospkg
from genmsg import resource_name


class RqtRoscommUtil:
    """A name space, as others import it."""

    @staticmethod
    def load_parameters(config, caller_id):
        """Set the parameters of ``config``, a ``ROSLaunchConfig``, on its master, after clearing those that it clears.

        :param caller_id: name of the node that asks
        :raises RLException: the master refuses one.
        """
        from roslaunch import RLException
        from roslaunch.launch import _unify_clear_params

        server = config.master.get()
        clear = [name for name in _unify_clear_params(config.clear_params) if server.hasParam(caller_id, name)[2]]
        for what, calls in (
            ("clear", [("deleteParam", name) for name in clear]),
            ("set", [("setParam", p.key, p.value) for p in config.params.values()]),
        ):
            multi = config.master.get_multi()
            for method, *arguments in calls:
                getattr(multi, method)(caller_id, *arguments)
            for (code, message, _), (_, name, *_) in zip(multi() if calls else (), calls):
                if code != 1:
                    raise RLException(f"Failed to {what} parameter {name}: {message}")

    @staticmethod
    def iterate_packages(subdir):
        """(package, folder) of each package with a sub-folder of that name.

        :raises ValueError: no name.
        """
        if not subdir:
            raise ValueError(f"Invalid package subdir = {subdir}")
        rospack = rospkg.RosPack()
        for package in rospack.list():
            folder = os.path.join(rospack.get_path(package), subdir)
            if os.path.isdir(folder):
                yield package, folder

    @staticmethod
    def list_files(package, subdir, file_extension=".launch"):
        """``package/file`` of all files that end with ``file_extension`` in the folder ``subdir`` of ``package``, sorted; none when
        there is no such folder.

        :raises rospkg.ResourceNotFound: no such package.
        """
        folder = os.path.join(rospkg.RosPack().get_path(package), subdir)
        names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
        return [
            resource_name(package, name) for name in names if name.endswith(file_extension) and os.path.isfile(os.path.join(folder, name))
        ]

    @staticmethod
    def is_roscore_running():
        return rosgraph.is_master_online()
