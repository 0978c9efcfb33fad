"""The step loop: what is called when, and how other threads get at the world."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from contextlib import AbstractContextManager, nullcontext
from typing import Any

import rospy
from node_signals.rates import Spaced
from ode_sim.description import model as d
from ode_sim.errors import Unavailable

from gazebo_ros.callbacks import CallbackList, Connection
from gazebo_ros.delivery import Delivery
from gazebo_ros.driving import Drivers
from gazebo_ros.plugin_host import PluginHost, PluginInstance
from gazebo_ros.running_plugins import ResolvedModel, RunningPlugins
from gazebo_ros.server_view import ServerView
from gazebo_ros.throttle import Throttle

_NS = 1_000_000_000
_SLEEPERS = rospy.rostime.get_rostime_cond()  # who sleeps in sim time in this process waits on it
_A_MOMENT = 0.001  # wall s
_WALL_RATE = 1000.0  # wall Hz; uncapped, subscribers get at most one message per wall millisecond


class Stopped(Unavailable):
    """The simulator is shutting down; the call was not made."""


class WallLimit:
    """Lets through at most one message per wall millisecond while the simulation runs as fast as it can.

    In real time every step is let through: that is what Gazebo does, and what a subscriber can follow.
    """

    def __init__(self, server: Server):
        self._server = server
        self._gate = Spaced(_WALL_RATE)

    def due(self) -> bool:
        return self._server.throttled or self._gate.due(time.monotonic_ns())


class Server:
    """One simulated world, stepped in one thread.

    ``world``
        ``ode_sim.World``. Only the physics thread may touch it: step callbacks, ``load``, ``reset`` and ``shutdown`` of
        plugins, and functions given to :meth:`call`.
    ``description``
        ``ode_sim.description.World`` it was made from
    ``finder``
        ``ode_sim.description.ResourceFinder`` with the search paths of the environment and of ROS packages
    ``lockstep``
        physics waits for every sensor (``--lockstep``): a camera must not drop a frame
    ``delivery``
        in lock-step: what subscribers have not taken yet, which physics waits for, too
    ``plugins``
        those of the world and of its models, with their sensors
    ``ros_time``
        let ``rospy.Time.now()`` of this process be :meth:`now` (off when /use_sim_time is false)
    """

    def __init__(
        self,
        world,
        description: d.World,
        finder,
        host: PluginHost,
        *,
        paused: bool = False,
        lockstep: bool = False,
        delivery: Delivery | None = None,
        iterations: int = 0,
        ros_time: bool = True,
    ):
        self.world = world
        self.description = description
        self.finder = finder
        self.lockstep = lockstep
        self._delivery = delivery
        self._drivers = Drivers()
        self.first_view: d.Pose | None = None  # X_WE of the window's eye, where the world file says it
        self.throttle = Throttle(world.physics.real_time_update_rate)
        self.paused = paused
        self.started = CallbackList()  # called once, when all plugins are loaded, before the first step
        self.stepped = CallbackList()  # called when a run of steps begins or ends: pause, unpause, end of a request
        self.starting = CallbackList()  # called once, before plugins are loaded
        self.went_back = CallbackList()  # called when time has gone back: resets, a saved moment
        self.plugins = RunningPlugins(host, description.name, lambda owner: ServerView(self, owner), self._disconnect)
        self._ros_time = ros_time
        self._iterations_left = iterations or None
        self._requested_steps = 0
        self._request: Future | None = None
        self._stopping = False
        self._ended = False
        # Held while the world is changed; compiled plugins' threads take it, too.
        self.between_steps: AbstractContextManager[Any] = nullcontext()
        self._calls: queue.SimpleQueue = queue.SimpleQueue()
        self._thread: int | None = None
        self._before = CallbackList()
        self._after = CallbackList()
        self._wake_limit = WallLimit(self)
        self.now_ns = 0  # as now(), read at every step
        self._set_now()
        self.stepped.connect(self._wake_sleepers)
        world.before_step.append(self._begin_step)
        world.after_step.append(self._end_step)

    # ------------------------------------------------------------------------------------------ for plugins

    def now(self) -> rospy.Time:
        """Sim time of the current step (of the last one, between steps)."""
        return self._now

    def before_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f()`` in every step before collision and dynamics, after sim time has advanced."""
        return self._before.connect(f)

    def after_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f()`` in every step when poses, velocities and contacts are those at :meth:`now`."""
        return self._after.connect(f)

    def call(self, f: Callable[[], Any]) -> Any:
        """Run ``f()`` in the physics thread between two steps, also while paused, and return its result.

        An exception of ``f`` is raised here. From the physics thread itself ``f`` runs at once.

        :raises Stopped: the simulator is shutting down
        """
        if threading.get_ident() == self._thread:
            return f()
        future: Future = Future()
        self._calls.put((f, future))
        if self._ended:  # the loop has emptied the queue for the last time
            self._refuse_calls()
        return future.result()

    @property
    def throttled(self) -> bool:
        """Steps are paced by wall time, not taken as fast as possible."""
        return self.throttle.paced and not self._requested_steps

    # ------------------------------------------------------------------------------------------ the loop

    def run(self) -> None:
        """Load the plugins of the world file, then step until :meth:`stop` or until ``iterations`` are done."""
        self._thread = threading.get_ident()
        try:
            self.starting.call()
            self.plugins.load(self.description.plugins, self.world.models.values())
            self.started.call()
            self.throttle.restart()
            while not self._stopping:
                self._turn()
        finally:
            self._shutdown()

    def stop(self) -> None:  # any thread
        """End :meth:`run` after the current step."""
        self._stopping = True
        self._calls.put((_nothing, Future()))  # wakes the loop

    def _turn(self) -> None:
        """One step, or one piece of waiting for it."""
        if not self._calls.empty():  # first: a subscriber that is waited for may be waiting for an answer
            self._run_call(*self._calls.get())
        elif self._delivery is not None and self._delivery.pending:
            self._delivery.wait(_A_MOMENT)
        elif self._requested_steps:
            self._step()
            self._requested_steps -= 1
            if not self._requested_steps:
                self.stepped.call()
        elif self._request is not None:
            if self._delivery is None or self._delivery.taken():
                self._finish_request()
            else:
                time.sleep(_A_MOMENT)
        elif self.paused:
            self._run_call(*self._calls.get())
        else:
            throttle = self.throttle
            if throttle.rate != self.world.physics.real_time_update_rate:
                throttle.rate = self.world.physics.real_time_update_rate
            delay = throttle.delay()
            if delay > 0.0:
                try:
                    call = self._calls.get(timeout=delay)
                except queue.Empty:
                    return
                self._run_call(*call)
            else:
                throttle.stepped()
                self._step()

    def _step(self) -> None:
        world = self.world
        world.step(1)
        if world.messages:
            for line in world.messages:
                rospy.logwarn("%s", line)
            world.messages.clear()
        if self._iterations_left is not None:
            self._iterations_left -= 1
            if not self._iterations_left:
                rospy.loginfo("%d iterations done: the simulator ends", world.iterations)
                self._stopping = True

    def _begin_step(self, world) -> None:
        self._set_now()
        self._before.call()

    def _end_step(self, world) -> None:
        sensors = self.plugins.sensors
        if sensors:
            now_ns = world.time_ns
            for sensor in sensors:
                sensor.update(now_ns)
        self._after.call()

    def _set_now(self) -> None:
        now = _new_time()  # rospy.Time(...) and its checks would cost a tenth of a step
        self.now_ns = self.world.time_ns
        now.secs, now.nsecs = divmod(self.now_ns, _NS)
        self._now = now
        if self._ros_time:  # what rospy does with a message of /clock
            rospy.rostime._rostime_current = now
            if _SLEEPERS._waiters and self._wake_limit.due():
                self._wake_sleepers()

    @staticmethod
    def _wake_sleepers() -> None:
        with _SLEEPERS:
            _SLEEPERS.notify_all()

    def _run_call(self, f: Callable[[], Any], future: Future) -> None:
        try:
            with self.between_steps:
                result = f()
            future.set_result(result)
        except Exception as error:  # raised again in the thread that called
            future.set_exception(error)

    def _refuse_calls(self) -> None:
        while True:
            try:
                _, future = self._calls.get_nowait()
            except queue.Empty:
                return
            future.set_exception(Stopped("the simulator is shutting down"))

    # ------------------------------------------------------------------------------------------ pause, step, reset

    def pause(self) -> None:
        """Physics thread."""
        self.paused = True
        self.stepped.call()

    def unpause(self) -> None:
        """Physics thread."""
        self.paused = False
        self.throttle.restart()
        self.stepped.call()

    def request_steps(self, count: int) -> Future:
        """Take ``count`` steps as fast as possible though paused. Physics thread.

        :returns: done when the last step is and, in lock-step, what it published is with the subscribers; cancelled by a second
            request's refusal or the end of the simulator
        :raises ValueError: not paused, or a request is still running
        """
        if not self.paused:
            raise ValueError("the simulation is running; pause it first (pause_physics)")
        if self._request is not None:
            raise ValueError("another step request is still running")
        if count < 1:
            raise ValueError("steps must be at least 1")
        self._requested_steps = count
        self._request = Future()
        return self._request

    def _finish_request(self) -> None:
        request, self._request = self._request, None
        if request is not None:
            request.set_result(None)

    def reset_world(self) -> None:
        """Model poses back to the initial ones, velocities zero; time and the angles within models stay. Physics thread."""
        self.world.reset_poses()
        self.plugins.reset(of_world=False)

    def reset_simulation(self) -> None:
        """Time and all poses back to the start. Physics thread."""
        self.world.reset()
        self._time_went_back()

    def reset_time(self) -> None:
        """Time back to 0, all else as it is. Physics thread."""
        self.world.reset_time()
        self._time_went_back()

    def set_time(self, time_ns: int) -> None:
        """Another time; no plugin is reset. Physics thread.

        :param time_ns: the time that it is then
        """
        self.world.set_time(time_ns)
        self._time_jumped()

    def _time_jumped(self) -> None:
        self._set_now()
        self.throttle.restart()
        for sensor in self.plugins.sensors:
            sensor.reset()

    def _time_went_back(self) -> None:
        self._time_jumped()
        self.plugins.reset(of_world=True)
        self.went_back.call()

    def restore(self, snapshot) -> None:
        """Back to ``snapshot``, a saved moment, paused. Plugins and sensors are told as by a reset. Physics thread.

        :raises ValueError: the world has other models by now
        """
        self.world.restore(snapshot)
        self.paused = True
        self._time_went_back()
        self.stepped.call()

    # ------------------------------------------------------------------------------------------ models

    def spawn(self, model: d.Model, resolved: ResolvedModel):
        """Put ``model`` into the world and start its plugins, ``resolved``. Physics thread.

        :returns: ``ode_sim.ModelHandle``
        """
        handle = self.world.spawn(model)
        self.report_problems(f"model {model.name}")
        self.plugins.start(handle, resolved)
        return handle

    def report_problems(self, what: str) -> None:
        """Log what the world noticed while it was built. Physics thread."""
        log_problems(self.world.problems, what)
        self.world.problems.clear()

    def remove(self, name: str) -> None:
        """Shut the plugins of the model ``name`` down and take it out of the world. Physics thread."""
        self.plugins.end(name)
        self.world.remove(name)

    def _disconnect(self, instance: PluginInstance) -> None:
        self._before.disconnect_owner(instance)
        self._after.disconnect_owner(instance)
        self.stepped.disconnect_owner(instance)
        self._drivers.ended(instance)

    def _shutdown(self) -> None:
        self._ended = True
        if self._request is not None:
            self._request.set_exception(Stopped("the simulator is shutting down"))
        self._refuse_calls()
        self.plugins.end_all()


def log_problems(problems: Iterable[d.Problem], what: str) -> None:
    """One line for each of ``problems``, begun with ``what``; what upstream says nothing of goes to debug."""
    logs = {"error": rospy.logerr, "note": rospy.logdebug}
    for problem in problems:
        log = logs.get(problem.severity, rospy.logwarn)
        log("%s: %s", what, problem)


def _new_time() -> rospy.Time:
    return rospy.Time.__new__(rospy.Time)


def _nothing() -> None:
    """Put into the call queue to wake the loop."""
