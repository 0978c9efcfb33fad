"""The engine for a cluster: one task of Ray for each submission, on the nodes that are fit for it."""

from __future__ import annotations

import pathlib
import re
import shutil
import socket
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import TYPE_CHECKING, Any

from ..errors import LabError
from ..outcome import Result
from ..specs.spec import Spec
from . import cluster_access, cluster_node, packed_files
from .engines import Engine, How, NotBegun, Pool, outcome

if TYPE_CHECKING:
    from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

_LOOK = 60.0  # s that a node has to answer
_TAKEN = ".taken."  # before the name of a folder for reports on their way
_FETCH = 300.0  # s in which the reports of one that ended have to arrive
_SENT = 200_000  # bytes that a node is sent and sends back: Ray passes what is smaller than 100 kB in another way


class ClusterError(LabError, RuntimeError):
    """No cluster, or no node in it that can examine; one line with the cure."""


@dataclass
class Node:
    """``slots``: examinations at a time, one a core; ``busy``: numbers of those that are taken; ``given``: how many it got."""

    name: str
    slots: int
    busy: set
    alive: bool = True
    given: int = 0

    def take(self) -> int:
        slot = min(set(range(self.slots)) - self.busy)
        self.busy.add(slot)
        self.given += 1
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
        for left in out.glob(f"{_TAKEN}*"):  # by one that was killed
            shutil.rmtree(left, ignore_errors=True)
        self._most = spec.limit("input")
        self._spec_parcel, self._spec_path = packed_files.pack_spec(spec)
        self.running: dict[str, Task] = {}
        self._last: dict[str, str] = {}  # submission -> node where it was tried last
        self._here = Pool(lambda name: spec.path, out, how, 1)  # for what is too large to be sent: it is refused at once
        try:
            self._nodes = self._fit_nodes(show)
        except BaseException:
            self._ray.shutdown()
            raise
        self._wanted = workers
        self._shared = self._ray.put(self._spec_parcel)
        self._remote = self._ray.remote(num_cpus=1, max_retries=0)(cluster_node.examine_parcel)

    def _fit_nodes(self, show: Callable[[str], None]) -> dict[str, Node]:
        ray = self._ray
        version, asked = cluster_node.platform_version(), {}
        look, sent = ray.remote(num_cpus=0, max_retries=0)(cluster_node.faults), ray.put(bytes(_SENT))
        for entry in ray.nodes():
            slots = int(entry["Resources"].get("CPU", 0))
            if entry["Alive"] and slots:
                reference = look.options(scheduling_strategy=self._on(entry["NodeID"])).remote(version, self._how.unsafe, sent)
                asked[reference] = (entry["NodeID"], entry["NodeManagerAddress"], slots)
        found: dict[str, Node] = {}
        for reference, (identity, address, slots) in asked.items():
            try:
                name, said, _ = ray.get(reference, timeout=_LOOK)
            except ray.exceptions.GetTimeoutError:
                name, said = address, [f"it did not answer within {_LOOK:.0f} s"]
            except ray.exceptions.RayError as error:
                cure = "; there, source noetic_labs' setup.bash and type rosrun lab_check ray start"
                name, said = address, [_reason(error) + (cure if "No module named" in str(error) else "")]
            if said:
                show(f"node {name} ({address}) is left out: {'; '.join(said)}")
            else:
                found[identity] = Node(name, slots, set())
        if not found:
            raise ClusterError(f"none of the cluster's {len(asked)} nodes can examine")
        return found

    def _on(self, identity: str) -> NodeAffinitySchedulingStrategy:
        from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

        return NodeAffinitySchedulingStrategy(node_id=identity, soft=False)

    def start(self, name: str, path: pathlib.Path) -> None:
        """
        :raises ClusterError: no node, or no cluster, is left
        """
        shutil.rmtree(self._out / name, ignore_errors=True)
        try:
            submission = packed_files.pack(path, self._most)
        except (packed_files.TooLarge, OSError):
            self._here.start(name, path)
            self.running[name] = Task(None, "", 0)
            return
        identity, slot = self._place(self._last.get(name, ""))
        work = self._remote.options(scheduling_strategy=self._on(identity))
        try:
            reference = work.remote(path.name, self._ray.put(submission), self._shared, self._spec_path, self._how, slot)
        except self._ray.exceptions.RayError as error:
            raise ClusterError(f"the cluster takes no work any more ({_reason(error)}); the same command goes on from here") from None
        self.running[name] = Task(reference, identity, slot)
        self._last[name] = identity

    @property
    def workers(self) -> int:  # type: ignore[override]
        """As many as the nodes that live have room for; 1 when none does, so that :meth:`start` says so."""
        slots = max(sum(n.slots for n in self._nodes.values() if n.alive), 1)
        return min(self._wanted or slots, slots)

    def _look(self) -> None:
        """Which nodes live. Without a head Ray waits for it, and after a minute ends the whole process: see :class:`RemoteEngine`.

        :raises ClusterError: the head does not answer
        """
        try:
            alive = {entry["NodeID"] for entry in self._ray.nodes() if entry["Alive"]}
        except (self._ray.exceptions.RayError, RuntimeError, OSError) as error:
            raise ClusterError(
                f"the cluster's head does not answer any more ({_first_line(error)}); the same command goes on from here"
            ) from None
        for identity, n in self._nodes.items():
            n.alive = n.alive and identity in alive

    def _place(self, last: str) -> tuple[str, int]:
        """A slot on the emptiest node, rather not where the submission's worker died before."""
        free = [identity for identity, n in self._nodes.items() if n.alive and len(n.busy) < n.slots]
        if not free:
            raise ClusterError("no node of the cluster is left that can examine; the same command goes on from here")
        identity = min(free, key=lambda i: (i == last, len(self._nodes[i].busy) / self._nodes[i].slots, self._nodes[i].given))
        return identity, self._nodes[identity].take()

    def ended(self) -> list[str]:
        self._look()
        references = {task.reference: name for name, task in self.running.items() if task.reference is not None}
        ready, _ = self._ray.wait(list(references), num_returns=len(references), timeout=0) if references else ([], [])
        return [references[reference] for reference in ready] + self._here.ended()

    def take(self, name: str) -> Result | str:
        task = self.running.pop(name)
        if task.reference is None:
            return self._here.take(name)
        n = self._nodes[task.node]
        n.busy.discard(task.slot)
        try:
            code, reports = self._ray.get(task.reference, timeout=_FETCH)
        except self._ray.exceptions.RayTaskError as error:
            return f"the checker itself failed on {n.name}: {_reason(error)}"
        except self._ray.exceptions.TaskUnschedulableError:
            n.alive = False
            return NotBegun(f"the node {n.name} was gone before it began")
        except self._ray.exceptions.RayError as error:
            n.alive = n.alive and not isinstance(error, self._ray.exceptions.NodeDiedError)
            return f"its worker on {n.name} died: {_reason(error)}" if n.alive else f"the node {n.name} on which it was examined is gone"
        self._out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=_TAKEN, dir=self._out) as folder:
            packed_files.unpack(reports, pathlib.Path(folder))
            shutil.rmtree(self._out / name, ignore_errors=True)
            pathlib.Path(folder, "out").rename(self._out / name)
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


def connect(address: str) -> ModuleType:
    """Ray, connected to ``address``: "local", "auto", HOST or HOST:PORT.

    :raises ClusterError: it is not installed, nobody answers, or there is no token for it
    """
    try:
        where = address if address in ("local", "auto") else _knock(address)
    except (OSError, ValueError) as error:  # Ray itself would go on asking for minutes
        raise _nobody(address, error) from None
    if address != "local" and not cluster_access.agree(where):
        raise ClusterError(
            f"the cluster at '{address}' asks for a token, and {cluster_access.token_file()} is not it: "
            "copy that file from the machine of its head"
        )
    try:
        import ray
    except ImportError:
        raise ClusterError("--address needs Ray, which is not there: scripts/setup --teaching, then source devel/setup.bash") from None
    import logging

    quiet: dict[str, Any] = {"log_to_driver": False, "logging_level": logging.ERROR}
    # Ray notes the command line, and fails on a submission's name in it that is no UTF-8. It would print the log of each node that died.
    ray._private.utils.get_entrypoint_name = lambda: "lab_check grade"
    ray._private.worker.print_to_stdstream = lambda *_, **__: None
    try:
        if address == "local":
            ray.init(address="local", include_dashboard=False, **quiet)
        else:
            ray.init(address=where, **quiet)
    except Exception as error:  # Ray raises bare ones, too, such as of a node that does not start within 30 s
        raise _nobody(address, error) from None
    return ray


def _nobody(address: str, error: BaseException) -> ClusterError:
    return ClusterError(
        f"no Ray cluster answers at '{address}' ({_first_line(error)}); start one: rosrun lab_check ray start --head, "
        "and on each other machine rosrun lab_check ray start --address HOST:6379"
    )


def _knock(address: str) -> str:
    """The address, with a port.

    :raises OSError: nobody listens there
    :raises ValueError: its port is no number
    """
    address = address if ":" in address else f"{address}:6379"
    host, _, port = address.rpartition("://")[2].rpartition(":")
    socket.create_connection((host, int(port)), timeout=5.0).close()
    return address


# What Ray adds to its errors: colours, and advice to whoever develops with it.
_ADVICE = re.compile(
    r"\x1b\[[0-9;]*m|To see information about where this ObjectRef [^\n]*?`ray\.init\(\)`\."
    r"|Check cluster logs \([^)]*\)[^\n]*?failure\."
)


def _reason(error: BaseException) -> str:
    """All that Ray says, in one line; of an error inside a task that error, without the trace."""
    cause = getattr(error, "cause", None)
    cause = error if cause is None else cause
    text = " ".join(_ADVICE.sub("", str(cause)).split())
    return f"{type(cause).__name__}: {text}"[:800]


def _first_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0][:200]
