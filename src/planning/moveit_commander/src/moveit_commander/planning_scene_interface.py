"""What stands around the robot: objects of move_group's planning scene."""

from __future__ import annotations

import time
from collections.abc import Sequence

import motion
import rospy
from geometry_msgs.msg import Pose
from moveit_core import convert
from moveit_msgs.msg import (
    AllowedCollisionEntry,
    AllowedCollisionMatrix,
    AttachedCollisionObject,
    CollisionObject,
    PlanningScene,
    PlanningSceneComponents,
)
from moveit_msgs.srv import ApplyPlanningScene, GetPlanningScene
from rosgraph.names import ns_join
from shape_msgs.msg import Plane, SolidPrimitive

from . import conversions
from .exception import MoveItCommanderException
from .roscpp_initializer import ensure_node
from .session import publish


class PlanningSceneInterface:
    """Adds, attaches, removes and lists objects.

    :param synchronous: changes have happened when a method returns; otherwise they are sent as topics and happen later.
    :param ns: namespace of move_group; "" is the node's own.
    """

    def __init__(self, ns: str = "", synchronous: bool = True):
        ensure_node()
        self._ns = ns
        self._synchronous = synchronous
        self._get = rospy.ServiceProxy(self._name("get_planning_scene"), GetPlanningScene)
        self._apply_planning_scene_diff = rospy.ServiceProxy(self._name("apply_planning_scene"), ApplyPlanningScene)
        for service in (self._get, self._apply_planning_scene_diff):
            self._wait(service.resolved_name)
        if not synchronous:
            self._pub_co = rospy.Publisher(self._name("collision_object"), CollisionObject, queue_size=100)
            self._pub_aco = rospy.Publisher(self._name("attached_collision_object"), AttachedCollisionObject, queue_size=100)

    def _name(self, relative: str) -> str:
        return ns_join(self._ns, relative) if self._ns else relative

    @staticmethod
    def _wait(service: str) -> None:
        told, started = False, time.monotonic()
        while not rospy.is_shutdown():
            try:
                rospy.wait_for_service(service, timeout=0.5)
                return
            except rospy.ROSException:
                if not told and time.monotonic() - started > 5.0:
                    told = True
                    rospy.logwarn("service '%s' not advertised yet. Continue waiting... (move_group offers it)", service)

    def _submit(self, message, attach: bool = False) -> None:
        if not self._synchronous:
            publish(self._pub_aco if attach else self._pub_co, message)
            return
        scene = PlanningScene(is_diff=True)
        scene.robot_state.is_diff = True
        if attach:
            scene.robot_state.attached_collision_objects = [message]
        else:
            scene.world.collision_objects = [message]
        self.apply_planning_scene(scene)

    # --- adding ---

    def add_object(self, collision_object: CollisionObject) -> None:
        """Add ``collision_object``, or do with it what its ``operation`` says."""
        self._submit(collision_object)

    def add_sphere(self, name: str, pose, radius: float = 1) -> None:
        """Add a sphere ``name`` of ``radius`` m at ``pose``: a PoseStamped, a Pose in the planning frame, or a list x y z (r p y)."""
        self._submit(self.make_sphere(name, pose, radius))

    def add_cylinder(self, name: str, pose, height: float, radius: float) -> None:
        """Add a cylinder ``name`` at ``pose``, ``height`` m along its z axis, of ``radius`` m."""
        self._submit(self.make_cylinder(name, pose, height, radius))

    def add_cone(self, name: str, pose, height: float, radius: float) -> None:
        """Add a cone ``name`` at ``pose``, ``height`` m along its z axis, of ``radius`` m at the bottom."""
        self._submit(self.make_cone(name, pose, height, radius))

    def add_mesh(self, name: str, pose, filename: str, size: Sequence[float] = (1, 1, 1)) -> None:
        """Add the mesh of ``filename`` as ``name`` at ``pose``; ``size`` is a scale; all meshes of the file are taken as one."""
        self._submit(self.make_mesh(name, pose, filename, size))

    def add_box(self, name: str, pose, size: Sequence[float] = (1, 1, 1)) -> None:
        """Add a box ``name`` at ``pose``, its middle, with sides of ``size``, m."""
        self._submit(self.make_box(name, pose, size))

    def add_plane(self, name: str, pose, normal: Sequence[float] = (0, 0, 1), offset: float = 0) -> None:
        """Add the plane ``normal`` . p + ``offset`` = 0 as ``name``, p in the frame of ``pose``."""
        self._submit(self.make_plane(name, pose, normal, offset))

    # --- attaching ---

    def attach_object(self, object, link: str | None = None, touch_links: Sequence[str] | None = None) -> None:
        """Attach ``object``: a CollisionObject, an AttachedCollisionObject, or the name of an object of the scene.

        :param link: that bears it; None: the one that an AttachedCollisionObject names.
        :param touch_links: that may touch it; None: ``link`` alone.
        """
        if isinstance(object, str):
            object = CollisionObject(id=object)
        if isinstance(object, CollisionObject):
            object = AttachedCollisionObject(object=object)
        if link is not None:
            object.link_name = link
        object.touch_links = list(touch_links) if touch_links is not None else [object.link_name]
        self._submit(object, attach=True)

    def attach_mesh(
        self,
        link: str,
        name: str,
        pose=None,
        filename: str = "",
        size: Sequence[float] = (1, 1, 1),
        touch_links: Sequence[str] | None = None,
    ) -> None:
        """Attach the mesh of ``filename`` at ``pose``, or the object ``name`` of the scene without them, to ``link``.

        ``size`` is a scale; ``touch_links``: as for :meth:`attach_object`.
        """
        item = self.make_mesh(name, pose, filename, size) if pose is not None and filename else name
        self.attach_object(item, link, touch_links)

    def attach_box(
        self, link: str, name: str, pose=None, size: Sequence[float] = (1, 1, 1), touch_links: Sequence[str] | None = None
    ) -> None:
        """Attach a box of ``size`` (m) at ``pose``, or the object ``name`` of the scene without one, to ``link``.

        ``touch_links``: as for :meth:`attach_object`.
        """
        self.attach_object(self.make_box(name, pose, size) if pose is not None else name, link, touch_links)

    def attach_sphere(self, link: str, name: str, pose=None, radius: float = 1, touch_links: Sequence[str] | None = None) -> None:
        """Attach a sphere of ``radius`` (m) at ``pose``, or the object ``name`` of the scene without one, to ``link``.

        ``touch_links``: as for :meth:`attach_object`.
        """
        self.attach_object(self.make_sphere(name, pose, radius) if pose is not None else name, link, touch_links)

    def attach_cylinder(
        self, link: str, name: str, pose=None, height: float = 1, radius: float = 1, touch_links: Sequence[str] | None = None
    ) -> None:
        """Attach a cylinder of ``height`` and ``radius`` (m) at ``pose``, or the object ``name`` of the scene without one, to ``link``.

        ``touch_links``: as for :meth:`attach_object`.
        """
        self.attach_object(self.make_cylinder(name, pose, height, radius) if pose is not None else name, link, touch_links)

    # --- removing ---

    def clear(self) -> None:
        """Remove all objects, attached ones too."""
        self.remove_attached_object()
        self.remove_world_object()

    def remove_world_object(self, name: str | None = None) -> None:
        """Remove the object ``name``, or all."""
        self._submit(CollisionObject(id=name or "", operation=CollisionObject.REMOVE))

    def remove_attached_object(self, link: str | None = None, name: str | None = None) -> None:
        """Detach the object ``name``, those of ``link``, or all; they stay in the world."""
        message = AttachedCollisionObject(link_name=link or "")
        message.object.id, message.object.operation = name or "", CollisionObject.REMOVE
        self._submit(message, attach=True)

    # --- asking ---

    def _world(self, geometry: bool = True) -> list[CollisionObject]:
        bits = PlanningSceneComponents.WORLD_OBJECT_GEOMETRY if geometry else PlanningSceneComponents.WORLD_OBJECT_NAMES
        return self.get_planning_scene(bits).world.collision_objects

    def get_known_object_names(self, with_type: bool = False) -> list[str]:
        """Objects of the world; ``with_type``: only those of a known type."""
        return [item.id for item in self._world(geometry=False) if not with_type or item.type.key]

    def get_known_object_names_in_roi(
        self, minx: float, miny: float, minz: float, maxx: float, maxy: float, maxz: float, with_type: bool = False
    ) -> list[str]:
        """Objects of which all shapes have their origin in a box of the planning frame; ``with_type``: only those of a known type.

        :param minx, miny, minz, maxx, maxy, maxz: the box, m.
        """
        names = []
        for item in self._world():
            poses = [*item.primitive_poses, *item.mesh_poses]
            base = convert.pose(item.pose)
            inside = [
                all(
                    low <= value <= high
                    for low, value, high in zip((minx, miny, minz), (base * convert.pose(pose)).position, (maxx, maxy, maxz))
                )
                for pose in poses
            ]
            if inside and all(inside) and (not with_type or item.type.key):
                names.append(item.id)
        return names

    def get_object_poses(self, object_ids: Sequence[str]) -> dict[str, Pose]:
        """{name: pose in the planning frame} of those of ``object_ids`` that are there."""
        return {item.id: item.pose for item in self._world() if item.id in object_ids}

    def get_objects(self, object_ids: Sequence[str] = ()) -> dict[str, CollisionObject]:
        """Those named in ``object_ids``, or all."""
        return {item.id: item for item in self._world() if not object_ids or item.id in object_ids}

    def get_attached_objects(self, object_ids: Sequence[str] = ()) -> dict[str, AttachedCollisionObject]:
        """Those named in ``object_ids``, or all."""
        scene = self.get_planning_scene(PlanningSceneComponents.ROBOT_STATE_ATTACHED_OBJECTS)
        return {
            item.object.id: item for item in scene.robot_state.attached_collision_objects if not object_ids or item.object.id in object_ids
        }

    def get_planning_scene(self, components: int) -> PlanningScene:
        """The scene, or the parts that ``components``, bits of PlanningSceneComponents, name.

        :raises MoveItCommanderException: move_group does not answer.
        """
        request = GetPlanningScene._request_class()
        request.components.components = components
        return self._call(self._get, request).scene

    def apply_planning_scene(self, planning_scene_message: PlanningScene) -> bool:
        """Apply ``planning_scene_message``, a scene or a diff; False when some of it could not be (move_group says what)."""
        request = ApplyPlanningScene._request_class(planning_scene_message)
        return self._call(self._apply_planning_scene_diff, request).success

    @staticmethod
    def _call(service, request):
        try:
            return service(request)
        except (rospy.ServiceException, rospy.ROSException) as error:
            raise MoveItCommanderException(f"{service.resolved_name} does not answer: {error}") from error

    # --- making ---

    @staticmethod
    def _make(name: str, pose) -> CollisionObject:
        message = CollisionObject(id=name, operation=CollisionObject.ADD)
        if hasattr(pose, "header"):
            message.header, message.pose = pose.header, pose.pose
        elif isinstance(pose, Pose):
            message.pose = pose
        else:
            values = list(pose)
            message.pose = conversions.list_to_pose(values if len(values) != 3 else [*values, 0, 0, 0])
        return message

    @classmethod
    def _make_primitive(cls, name: str, pose, kind: int, dimensions: Sequence[float]) -> CollisionObject:
        message = cls._make(name, pose)
        message.primitives = [SolidPrimitive(type=kind, dimensions=[float(value) for value in dimensions])]
        return message

    @staticmethod
    def make_box(name: str, pose, size: Sequence[float]) -> CollisionObject:
        """The message of :meth:`add_box` with ``name``, ``pose`` and ``size``."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.BOX, size)

    @staticmethod
    def make_sphere(name: str, pose, radius: float) -> CollisionObject:
        """The message of :meth:`add_sphere` with ``name``, ``pose`` and ``radius``."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.SPHERE, [radius])

    @staticmethod
    def make_cylinder(name: str, pose, height: float, radius: float) -> CollisionObject:
        """The message of :meth:`add_cylinder` with ``name``, ``pose``, ``height`` and ``radius``."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.CYLINDER, [height, radius])

    @staticmethod
    def make_cone(name: str, pose, height: float, radius: float) -> CollisionObject:
        """The message of :meth:`add_cone` with ``name``, ``pose``, ``height`` and ``radius``."""
        return PlanningSceneInterface._make_primitive(name, pose, SolidPrimitive.CONE, [height, radius])

    @staticmethod
    def make_mesh(name: str, pose, filename: str, scale: Sequence[float] = (1, 1, 1)) -> CollisionObject:
        """The message of :meth:`add_mesh`: ``name`` at ``pose``, from ``filename`` (STL, DAE, OBJ; also package:// and file://).

        :param scale: along each axis.
        :raises MoveItCommanderException: the file cannot be read.
        """
        message = PlanningSceneInterface._make(name, pose)
        try:
            shape = motion.Mesh.load(filename, tuple(float(value) for value in scale))
        except (motion.MotionError, OSError, ValueError) as error:
            raise MoveItCommanderException(f"The mesh {filename} cannot be used: {error}") from error
        convert.fill_shapes(message, [shape], [convert.IDENTITY])
        return message

    def make_plane(self, name: str, pose, normal: Sequence[float] = (0, 0, 1), offset: float = 0) -> CollisionObject:
        """The message of :meth:`add_plane` with ``name``, ``pose``, ``normal`` and ``offset``."""
        message = self._make(name, pose)
        message.planes, message.plane_poses = [Plane([*(float(value) for value in normal), float(offset)])], [message.pose]
        message.pose = Pose()
        return message


def _set_default(matrix: AllowedCollisionMatrix, obj: str, allow: bool) -> None:
    """Set the default collision behaviour of ``obj``."""
    matrix.default_entry_names = list(matrix.default_entry_names)
    matrix.default_entry_values = list(matrix.default_entry_values)
    if obj in matrix.default_entry_names:
        matrix.default_entry_values[matrix.default_entry_names.index(obj)] = allow
    else:
        matrix.default_entry_names.append(obj)
        matrix.default_entry_values.append(allow)


def _set_allowed(matrix: AllowedCollisionMatrix, obj: str, other: str | None = None, allow: bool = True) -> None:
    """Allow (or not) collisions between ``obj`` and ``other``, or between ``obj`` and everything."""
    if other is None:
        _set_default(matrix, obj, allow)
        return
    matrix.entry_names = list(matrix.entry_names)
    for row in matrix.entry_values:
        row.enabled = list(row.enabled)
    for name in (other, obj):
        if name not in matrix.entry_names:
            matrix.entry_names.append(name)
            for row in matrix.entry_values:
                row.enabled.append(False)
            matrix.entry_values.append(AllowedCollisionEntry([False] * len(matrix.entry_names)))
    i, j = matrix.entry_names.index(obj), matrix.entry_names.index(other)
    matrix.entry_values[i].enabled[j] = matrix.entry_values[j].enabled[i] = allow


AllowedCollisionMatrix.set_default = _set_default
AllowedCollisionMatrix.set_allowed = _set_allowed
