"""The scene around the robot, kept up to date from topics, TF and joint states, and published for others to see."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from collections.abc import Set as AbstractSet

import motion
import rospy
import yaml
from dynamic_parameters import Server
from moveit_core import convert, scene_messages, states
from moveit_core.scene_messages import SceneEditor
from moveit_msgs.msg import AttachedCollisionObject, CollisionObject, PlanningScene, PlanningSceneWorld

from . import _execution  # type: ignore[attr-defined]  # compiled
from .parameter_tables import table
from .robot_model import RobotDescription, prepare_scene
from .state_monitor import CurrentStateMonitor

#: kinds of change, as bits
STATE, TRANSFORMS, GEOMETRY, SCENE = 1, 2, 4, 8


class SceneMonitor:
    """Keeps the planning scene. Requests work on a :meth:`copy`; nobody but this class writes into the scene itself.

    :param tf_buffer: a tf2 buffer with a listener.
    """

    def __init__(self, description: RobotDescription, tf_buffer, namespace: str = "~", dynamics: bool = False):
        self.description = description
        self.model = description.model
        self._buffer = tf_buffer
        self._ns = namespace
        self._lock = threading.RLock()
        self._scene = prepare_scene(description)
        self._acm_of_model = self._scene.acm
        self._pending = _Pending()
        self._callbacks: list[Callable[[int], None]] = []
        self._octomap_gone: Callable[[], None] = lambda: None
        options = f"{namespace}planning_scene_monitor_options/"
        self.name = rospy.get_param(options + "name", "planning_scene_monitor")
        self.states = CurrentStateMonitor(self.model, tf_buffer, rospy.get_param(options + "joint_state_topic", "joint_states"), dynamics)
        self.states.on_update(self._state_changed)
        self._subscribe(options)
        self._publishing = ScenePublisher(
            self, rospy.get_param(options + "publish_planning_scene_topic", namespace + "monitored_planning_scene")
        )
        parameters = table(_execution.scene_parameters())
        unset = {
            entry.name: True
            for entry in parameters
            if entry.type is bool  # everything is published unless told not to
            and not rospy.has_param(f"{namespace}planning_scene_monitor/{entry.name}")
        }
        self._server = Server(namespace + "planning_scene_monitor", parameters, self._reconfigure, unset)

    def _subscribe(self, options: str) -> None:
        scene_topic = rospy.get_param(options + "monitored_planning_scene_topic", "planning_scene")
        attached = rospy.get_param(options + "attached_collision_object_topic", "attached_collision_object")
        self._subscribers = [
            rospy.Subscriber(scene_topic, PlanningScene, self._on_scene, queue_size=100),
            rospy.Subscriber("planning_scene_world", PlanningSceneWorld, self._on_world, queue_size=1),
            rospy.Subscriber("collision_object", CollisionObject, self._on_object, queue_size=1024),
            rospy.Subscriber(attached, AttachedCollisionObject, self._on_attached, queue_size=1024),
        ]

    def _reconfigure(self, config, _level) -> None:
        kinds = (
            (GEOMETRY | SCENE if config["publish_geometry_updates"] else 0)
            | (STATE if config["publish_state_updates"] else 0)
            | (TRANSFORMS if config["publish_transforms_updates"] else 0)
        )
        self._publishing.configure(config["publish_planning_scene"], config["publish_planning_scene_hz"], kinds | SCENE)

    def shutdown(self) -> None:
        """Stop listening and publishing."""
        for subscriber in self._subscribers:
            subscriber.unregister()
        self.states.shutdown()
        self._publishing.shutdown()

    # --- for requests ---

    def copy(self, diff: PlanningScene | None = None) -> motion.PlanningScene:
        """A scene of the caller's own with the present state and transforms, and ``diff`` applied (whatever its
        is_diff says)."""
        with self._lock:
            self.update_transforms()
            scene = self._scene.copy()
        scene.set_state(self.with_attached(scene, self.states.state()))
        if diff is not None and not _is_empty_diff(diff):
            change = PlanningScene()
            for slot in PlanningScene.__slots__:
                setattr(change, slot, getattr(diff, slot))
            change.is_diff = True
            if not states.is_empty(change.robot_state) and not change.robot_state.is_diff:
                state = scene.state
                state.clear_attached()
                scene.set_state(state)
            SceneEditor(scene, rospy.logwarn).planning_scene(change)
        return scene

    @staticmethod
    def with_attached(scene, state: motion.RobotState) -> motion.RobotState:
        """``state`` with the bodies that are attached in ``scene``."""
        for body in scene.state.attached:
            state.attach(body)
        return state

    def wait_for_state(self, timeout: float = 1.0, since: rospy.Time | None = None) -> bool:
        """Wait up to ``timeout`` wall seconds for joint states stamped ``since`` (default: now) or later; says why when none come."""
        since = rospy.Time.now() if since is None else since
        if self.states.wait_for_current(since, timeout):
            return True
        rospy.logwarn("%s", self.states.explain(timeout, since))
        return False

    def message(self, components: int = 0) -> PlanningScene:
        """The scene as a message, with the present state; ``components``: bits of PlanningSceneComponents, 0 is all."""
        return scene_messages.scene_message(self.copy(), components)

    def on_change(self, callback: Callable[[int], None]) -> None:
        """Call ``callback(kinds)`` after every change; kinds are bits STATE, TRANSFORMS, GEOMETRY, SCENE."""
        self._callbacks.append(callback)

    def off_change(self, callback: Callable[[int], None]) -> None:
        """No longer call ``callback``."""
        if callback in self._callbacks:
            self._callbacks.remove(callback)

    def on_octomap_gone(self, callback: Callable[[], None]) -> None:
        """Call ``callback()`` when a whole scene without an octomap came: what sensors saw is to be forgotten."""
        self._octomap_gone = callback

    # --- writing ---

    def edit(self, change: Callable[[SceneEditor], bool], kinds: int, objects: AbstractSet[str] = frozenset(), whole: bool = False) -> bool:
        """Let ``change`` write into the scene, then tell everybody. ``objects`` are those of the world that it may
        touch.

        :param kinds: of change, bits STATE, TRANSFORMS, GEOMETRY, SCENE. :param whole: publish the whole scene next, not what changed.
        """
        with self._lock:
            self.update_transforms()
            self._scene.set_state(self.with_attached(self._scene, self.states.state()))
            good = change(SceneEditor(self._scene, rospy.logwarn))
            self._pending.add(kinds, objects, whole)
        self._tell(kinds)
        return good

    def apply(self, message: PlanningScene) -> bool:
        """Apply a PlanningScene message to the monitored scene."""
        if not message.is_diff:
            rospy.loginfo("a whole planning scene came: it replaces all objects and allowed collisions")
        names = {item.id for item in message.world.collision_objects} | {
            body.object.id for body in message.robot_state.attached_collision_objects
        }
        octomap = message.world.octomap.octomap
        if octomap.data:
            names.add(scene_messages.OCTOMAP)
        whole = not message.is_diff or "" in names or bool(octomap.id and not octomap.data)  # without data: it is taken away
        world = message.world.collision_objects or octomap.data or whole
        if not message.is_diff and not octomap.data:
            self._octomap_gone()
        kinds = GEOMETRY | SCENE if world else SCENE
        if not states.is_empty(message.robot_state):
            kinds |= GEOMETRY | STATE
        return self.edit(lambda editor: editor.planning_scene(message), kinds, names, whole)

    def process_object(self, message: CollisionObject) -> bool:
        """Apply one CollisionObject message."""
        return self.edit(lambda editor: editor.collision_object(message), GEOMETRY, {message.id}, whole=not message.id)

    def process_attached(self, message: AttachedCollisionObject) -> bool:
        """Apply one AttachedCollisionObject message."""
        return self.edit(lambda editor: editor.attached_object(message), GEOMETRY | STATE, {message.object.id}, whole=not message.object.id)

    def set_octomap(self, tree, pose) -> None:
        """Put the octomap ``tree``, at ``pose`` in the model frame, into the scene, or take it out (None)."""

        def change(editor) -> bool:
            self._scene.set_octomap(tree, pose)
            return True

        # Without one the whole scene is published: in a diff, no octomap means that nothing is said of it.
        self.edit(change, GEOMETRY, {scene_messages.OCTOMAP}, whole=tree is None)

    @property
    def scene_name(self) -> str:
        """The scene's name; "(noname)" until one came."""
        with self._lock:
            return self._scene.name

    def topics(self) -> list[str]:
        """What the monitor listens to."""
        return [self.states.topic, *(subscriber.resolved_name for subscriber in self._subscribers)]

    @property
    def octomap(self):
        with self._lock:
            return self._scene.octomap

    def update_transforms(self) -> None:
        """Take over the frames that TF knows and the robot does not have."""
        with self._lock:
            for frame in _frames(self._buffer):
                if frame == self._scene.frame or self.model.has_link(frame):
                    continue
                try:
                    found = self._buffer.lookup_transform(self._scene.frame, frame, rospy.Time(0))
                    self._scene.set_transform(frame, convert.pose(found.transform, f"frame '{frame}'"))
                except Exception as error:  # not connected to the robot (yet): such frames are simply not known
                    rospy.logdebug("frame '%s' is not connected to '%s': %s", frame, self._scene.frame, error)

    def _state_changed(self) -> None:
        with self._lock:
            self._pending.add(STATE, (), False)

    def _tell(self, kinds: int) -> None:
        for callback in list(self._callbacks):
            callback(kinds)

    def _on_scene(self, message: PlanningScene) -> None:
        self.apply(message)

    def _on_world(self, message: PlanningSceneWorld) -> None:
        """A world message replaces all objects and the octomap."""

        def change(editor) -> bool:
            before = list(self._scene.objects)
            self._scene.clear_objects()
            self._scene.set_octomap(None)
            good = True
            for item in message.collision_objects:
                good = editor.collision_object(item) and good
            for name in set(before) - {scene_messages.OCTOMAP}:
                self._scene.forget(name)
            return editor.octomap(message.octomap) and good

        if not message.octomap.octomap.data:
            self._octomap_gone()
        self.edit(change, GEOMETRY, whole=True)

    def _on_object(self, message: CollisionObject) -> None:
        self.process_object(message)

    def _on_attached(self, message: AttachedCollisionObject) -> None:
        self.process_attached(message)

    # --- publishing ---

    def next_message(self, full: bool, kinds: int) -> PlanningScene | None:
        """What is to be published now: the ``full`` scene, or what of ``kinds`` changed since the last call; None if nothing did."""
        with self._lock:
            pending, self._pending = self._pending, _Pending()
            if not pending.kinds & kinds and not full:
                return None
            scene = self.copy()
        if full or pending.whole:
            return scene_messages.scene_message(scene)
        return _diff_message(scene, pending, kinds)


class _Pending:
    """What changed since the last message."""

    def __init__(self) -> None:
        self.kinds = 0
        self.objects: set[str] = set()
        self.whole = False

    def add(self, kinds: int, objects, whole: bool) -> None:
        self.kinds |= kinds
        self.objects.update(objects)
        self.whole = self.whole or whole


def _diff_message(scene, pending: _Pending, kinds: int) -> PlanningScene:
    message = PlanningScene(name=scene.name, robot_model_name=scene.model.name, is_diff=True)
    wanted = pending.kinds & kinds
    message.robot_state.is_diff = True
    if wanted & (STATE | GEOMETRY):
        message.robot_state = states.robot_state_message(scene.state)
        message.robot_state.is_diff = False  # the attached bodies in it are all there are
    if wanted & TRANSFORMS:
        message.fixed_frame_transforms = scene_messages.transform_messages(scene)
    if wanted & SCENE:
        message.allowed_collision_matrix = scene_messages.acm_message(scene.acm)
        message.object_colors = scene_messages.colour_messages(scene)
    if wanted & GEOMETRY:
        attached = {body.id for body in scene.state.attached}
        for name in sorted(pending.objects - {scene_messages.OCTOMAP}):
            if name in scene.objects:
                message.world.collision_objects.append(scene_messages.object_message(scene, name))
            elif name not in attached:
                gone = CollisionObject(id=name, operation=CollisionObject.REMOVE)
                gone.header.frame_id = scene.frame
                message.world.collision_objects.append(gone)
        if scene_messages.OCTOMAP in pending.objects:
            message.world.octomap = scene_messages.octomap_message(scene)
    return message


class ScenePublisher:
    """Publishes the monitored scene in a thread of its own: the whole one first, then diffs, at most at a given
    rate."""

    def __init__(self, monitor: SceneMonitor, topic: str):
        self._monitor = monitor
        self._publisher = rospy.Publisher(topic, PlanningScene, queue_size=100)
        self._topic = rospy.resolve_name(topic)
        self._enabled = False
        self._period = 0.5
        self._kinds = GEOMETRY | SCENE
        self._full = True
        self._wake = threading.Event()
        self._stop = False
        self._thread = threading.Thread(target=self._run, name="scene publisher", daemon=True)
        self._thread.start()

    def configure(self, enabled: bool, rate: float, kinds: int) -> None:
        """Publish if ``enabled``, at most ``rate`` times a s, which ``kinds`` of change."""
        if enabled and not self._enabled:
            self._full = True
            rospy.loginfo("Publishing maintained planning scene on '%s'", self._topic)
        self._enabled, self._period, self._kinds = enabled, 1.0 / rate, kinds
        self._wake.set()

    def shutdown(self) -> None:
        self._stop = True
        self._wake.set()
        self._thread.join(2.0)

    def _run(self) -> None:
        while not self._stop and not rospy.is_shutdown():
            started = time.monotonic()
            if self._enabled:
                try:
                    message = self._monitor.next_message(self._full, self._kinds)
                    if message is not None:
                        self._full = False
                        self._publisher.publish(message)
                except rospy.ROSException:
                    return  # shutting down
                except (motion.MotionError, ValueError) as error:
                    rospy.logerr_throttle(10, f"the planning scene cannot be published: {error}")
            self._wake.wait(max(0.01, self._period - (time.monotonic() - started)))
            self._wake.clear()


def _frames(buffer) -> list[str]:
    """Names of all frames that TF knows."""
    text = buffer.all_frames_as_yaml()
    try:
        frames = yaml.load(text, Loader=yaml.BaseLoader)  # all are texts: a frame may be called "1" or "on"
    except yaml.YAMLError:
        return []
    if not isinstance(frames, dict):
        return []
    return sorted({*frames, *(entry["parent"] for entry in frames.values() if isinstance(entry, dict) and "parent" in entry)})


def _is_empty_diff(message: PlanningScene) -> bool:
    return states.is_empty(message.robot_state) and not (
        message.world.collision_objects
        or message.world.octomap.octomap.id
        or message.allowed_collision_matrix.entry_names
        or message.link_padding
        or message.link_scale
        or message.fixed_frame_transforms
        or message.object_colors
    )
