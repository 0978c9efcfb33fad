"""Expectations by kind; each is a :class:`lab_check.checks.base.Check`."""

from __future__ import annotations

import importlib.util
from typing import Any

from .base import Check, Context


class PythonCheck(Check):
    """A function of the teacher: ``f(context, **arguments)`` returns True, False, or (passed, sentence)."""

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        path = self.context.spec_folder / self.wanted["file"]
        spec = importlib.util.spec_from_file_location("lab_check_teacher", path)
        assert spec is not None and spec.loader is not None  # the file was looked for when the spec was read
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        answer = getattr(module, self.wanted["function"])(self.context, **self.wanted.get("arguments", {}))
        passed, reason = answer if isinstance(answer, tuple) else (answer, "as asked" if answer else "not as asked")
        return bool(passed), str(reason), {}


def make(kind: str, wanted: Any, context: Context) -> Check:
    """The check for an expectation of ``kind`` with the value ``wanted``, which the spec gives it, in a task's ``context``."""
    from . import files, graph, listening, motion, programs

    kinds = {
        "file": files.FileCheck,
        "urdf": files.UrdfCheck,
        "node": graph.NodeCheck,
        "topic": graph.TopicCheck,
        "service": graph.ServiceCheck,
        "param": graph.ParamCheck,
        "tf": graph.TfCheck,
        "controllers": graph.ControllersCheck,
        "no_errors": programs.NoErrorsCheck,
        "exit": programs.ExitCheck,
        "answer": programs.AnswerCheck,
        "joint": motion.JointCheck,
        "still": motion.StillCheck,
        "moved": motion.MovedCheck,
        "path": motion.PathCheck,
        "distance": motion.DistanceCheck,
        "odometry": listening.OdometryCheck,
        "energy": listening.EnergyCheck,
        "image": listening.ImageCheck,
        "no_collision": motion.NoCollisionCheck,
        "real_time_factor": motion.RealTimeFactorCheck,
        "python": PythonCheck,
    }
    return kinds[kind](wanted, context)
