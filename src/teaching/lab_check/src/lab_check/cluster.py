"""The engine for a cluster: one task of Ray for each submission, on the nodes that are fit for it."""
from __future__ import annotations

import os
import pathlib
import shutil
import socket
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Tuple, Union

from . import node, parcel
from .engines import Engine, How, Pool, outcome
from .errors import LabError
from .outcome import Result
from .spec import Spec

_LOOK = 60.0  # s that a node has to answer


class ClusterError(LabError, RuntimeError):
    """No cluster, or no node in it that can examine; one line with the cure."""


@dataclass
class Node:
    """``slots``: examinations at a time, one a core; ``busy``: numbers of those that are taken."""

    name: str
    slots: int
    busy: set
    alive: bool = True

    def take(self) -> int:
        slot = min(set(range(self.slots)) - self.busy)
        self.busy.add(slot)
        return slot


@dataclass
class Task:
    reference: Any
    node: str
    slot: int


class Cluster(Engine):
    """
    :param address: of a running cluster (``auto``: that of this machine), or ``local``: one is started here and ended again
    :param workers: the most examinations at a time; 0: one for each core of the nodes that are fit
    :param show: is given a line for each node that is unfit
    :raises ClusterError: see there
    """

    def __init__(self, spec: Spec, out: pathlib.Path, how: How, workers: int, address: str, show: Callable[[str], None]):
        self._ray = connect(address)
        self._out, self._how = out, how
        self._most = spec.limit("input")
        self._spec_parcel, self._spec_path = parcel.pack_spec(spec)
        self.running: Dict[str, Task] = {}
        self._last: Dict[str, str] = {}  # submission -> node where it was tried last
        self._here = Pool(lambda name: spec.path, out, how, 1)  # for what is too large to be sent: it is refused at once
        try:
            self._nodes = self._fit_nodes(show)
        except BaseException:
            self._ray.shutdown()
            raise
        self._wanted = workers
        self._shared = self._ray.put(self._spec_parcel)
        self._remote = self._ray.remote(num_cpus=1, max_retries=0)(node.examine_parcel)

    def _fit_nodes(self, show: Callable[[str], None]) -> Dict[str, Node]:
        ray = self._ray
        version, asked = node.platform_version(), {}
        look = ray.remote(num_cpus=0, max_retries=0)(node.faults)
        for entry in ray.nodes():
            slots = int(entry["Resources"].get("CPU", 0))
            if entry["Alive"] and slots:
                reference = look.options(scheduling_strategy=self._on(entry["NodeID"])).remote(version, self._how.unsafe)
                asked[reference] = (entry["NodeID"], entry["NodeManagerAddress"], slots)
        found: Dict[str, Node] = {}
        for reference, (identity, address, slots) in asked.items():
            try:
                name, said = ray.get(reference, timeout=_LOOK)
            except ray.exceptions.GetTimeoutError:
                name, said = address, [f"it did not answer within {_LOOK:.0f} s"]
            except ray.exceptions.RayError as error:
                name, said = address, [_reason(error) + "; there, source noetic_labs' setup.bash and type rosrun lab_check ray start"]
            if said:
                show(f"node {name} ({address}) is left out: {'; '.join(said)}")
            else:
                found[identity] = Node(name, slots, set())
        if not found:
            raise ClusterError(f"none of the cluster's {len(asked)} nodes can examine")
        return found

    def _on(self, identity: str):
        from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

        return NodeAffinitySchedulingStrategy(node_id=identity, soft=False)

    def start(self, name: str, path: pathlib.Path) -> None:
        shutil.rmtree(self._out / name, ignore_errors=True)
        try:
            submission = self._ray.put(parcel.pack(path, self._most))
        except (parcel.TooLarge, OSError):
            self._here.start(name, path)
            self.running[name] = Task(None, "", 0)
            return
        identity, slot = self._place(self._last.get(name, ""))
        work = self._remote.options(scheduling_strategy=self._on(identity))
        reference = work.remote(path.name, submission, self._shared, self._spec_path, self._how, slot)
        self.running[name] = Task(reference, identity, slot)
        self._last[name] = identity

    @property
    def workers(self) -> int:  # type: ignore[override]
        """As many as the nodes that live have room for; 1 when none does, so that :meth:`start` says so."""
        slots = max(sum(n.slots for n in self._nodes.values() if n.alive), 1)
        return min(self._wanted or slots, slots)

    def _look(self) -> None:
        """Which nodes live.

        :raises ClusterError: the head does not answer
        """
        try:
            alive = {entry["NodeID"] for entry in self._ray.nodes() if entry["Alive"]}
        except (self._ray.exceptions.RayError, RuntimeError, OSError) as error:
            raise ClusterError(f"the cluster's head does not answer any more ({_first_line(error)}); "
                               "the same command goes on from here") from None
        for identity, n in self._nodes.items():
            n.alive = identity in alive

    def _place(self, last: str) -> Tuple[str, int]:
        """A slot on the emptiest node, rather not where the submission's worker died before."""
        free = [identity for identity, n in self._nodes.items() if n.alive and len(n.busy) < n.slots]
        if not free:
            raise ClusterError("no node of the cluster is left that can examine; the same command goes on from here")
        identity = min(free, key=lambda i: (i == last, len(self._nodes[i].busy) / self._nodes[i].slots))
        return identity, self._nodes[identity].take()

    def ended(self) -> List[str]:
        self._look()
        references = {task.reference: name for name, task in self.running.items() if task.reference is not None}
        ready, _ = self._ray.wait(list(references), num_returns=len(references), timeout=0) if references else ([], [])
        return [references[reference] for reference in ready] + self._here.ended()

    def take(self, name: str) -> Union[Result, str]:
        task = self.running.pop(name)
        if task.reference is None:
            return self._here.take(name)
        n = self._nodes[task.node]
        n.busy.discard(task.slot)
        try:
            code, reports = self._ray.get(task.reference)
        except self._ray.exceptions.RayError as error:
            return f"its worker on {n.name} died: {_reason(error)}"
        parcel.unpack(reports, self._out / "_taken")
        shutil.rmtree(self._out / name, ignore_errors=True)
        (self._out / "_taken" / "out").rename(self._out / name)
        (self._out / "_taken").rmdir()
        return outcome(self._out / name, code)

    def end(self) -> None:
        self._here.end()
        try:
            for task in self.running.values():
                if task.reference is not None:
                    self._ray.cancel(task.reference, force=True)
        finally:
            self.running.clear()
            self._ray.shutdown()


def bring_token() -> None:
    """Where this user has a token, ``ray start --head`` asks for it, but neither ``ray.init`` nor Ray's other commands bring it
    by themselves: here they do. Before Ray is imported; who has set RAY_AUTH_MODE is heard."""
    if (pathlib.Path.home() / ".ray" / "auth_token").exists():
        os.environ.setdefault("RAY_AUTH_MODE", "token")


def connect(address: str):
    """Ray, connected.

    :raises ClusterError: it is not installed, or nobody answers
    """
    bring_token()
    try:
        import ray
    except ImportError:
        raise ClusterError("--address needs Ray, which is not there: scripts/setup --teaching, then source devel/setup.bash") from None
    import logging

    quiet = {"log_to_driver": False, "logging_level": logging.ERROR}
    # Ray notes the command line, and fails on a submission's name in it that is no UTF-8.
    ray._private.utils.get_entrypoint_name = lambda: "lab_check grade"
    try:
        if address == "local":
            ray.init(address="local", include_dashboard=False, **quiet)
        else:
            if address != "auto":
                address = address if ":" in address else f"{address}:6379"
                _knock(address)  # Ray itself would go on asking for minutes
            ray.init(address=address, **quiet)
    except Exception as error:  # Ray raises bare ones, too, such as of a node that does not start within 30 s
        raise ClusterError(f"no Ray cluster answers at '{address}' ({_first_line(error)}); start one: rosrun lab_check ray start --head, "
                           "and on each other machine rosrun lab_check ray start --address HOST:6379") from None
    return ray


def _knock(address: str) -> None:
    """
    :raises OSError: nobody listens there
    :raises ValueError: it has no port
    """
    host, _, port = address.rpartition("://")[2].rpartition(":")
    socket.create_connection((host, int(port)), timeout=5.0).close()


def _reason(error: BaseException) -> str:
    """The last line of Ray's text that says something; its traces are of no use to a teacher."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    return (lines[-1] if type(error).__name__.startswith("RayTaskError") else lines[0] if lines else type(error).__name__)[:300]


def _first_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0][:200]
