"""Objects of the planning scene as markers: green those of the world, purple what is attached."""
from __future__ import annotations

import threading
from typing import List

import rospy
from geometry_msgs.msg import Point, Vector3
from moveit_msgs.msg import CollisionObject, PlanningScene, PlanningSceneComponents
from moveit_msgs.srv import GetPlanningScene
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from moveit_core import convert

_GREEN = ColorRGBA(0.2, 0.9, 0.2, 0.9)
_PURPLE = ColorRGBA(0.6, 0.2, 0.6, 0.9)


class SceneMarkers:
    """Asks for the scene whenever it changed, at most five times a second."""

    def __init__(self) -> None:
        self._news, self._end = threading.Event(), False
        self._publisher = rospy.Publisher("goal_marker/scene", MarkerArray, queue_size=1, latch=True)
        self._subscriber = rospy.Subscriber("move_group/monitored_planning_scene", PlanningScene, self._received,
                                            queue_size=10)
        self._news.set()
        threading.Thread(target=self._run, name="scene markers", daemon=True).start()

    def shutdown(self) -> None:
        """Stop showing."""
        self._end = True
        self._news.set()

    def _received(self, message: PlanningScene) -> None:
        if not message.is_diff or message.world.collision_objects or message.robot_state.attached_collision_objects \
                or message.object_colors:
            self._news.set()

    def _run(self) -> None:
        ask = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)
        wanted = PlanningSceneComponents
        bits = wanted.WORLD_OBJECT_GEOMETRY | wanted.ROBOT_STATE_ATTACHED_OBJECTS | wanted.OBJECT_COLORS
        while not self._end and not rospy.is_shutdown():
            self._news.wait()
            self._news.clear()
            try:
                self._publisher.publish(scene_markers(ask(PlanningSceneComponents(bits)).scene))
            except (rospy.ServiceException, rospy.ROSException) as error:
                rospy.logdebug("the scene cannot be asked for: %s", error)
            threading.Event().wait(0.2)


def scene_markers(scene: PlanningScene) -> MarkerArray:
    """All objects of a scene message."""
    colours = {entry.id: entry.color for entry in scene.object_colors}
    markers: List[Marker] = [Marker(action=Marker.DELETEALL)]
    for item in scene.world.collision_objects:
        markers += _object(item, colours.get(item.id, _GREEN))
    for body in scene.robot_state.attached_collision_objects:
        markers += _object(body.object, colours.get(body.object.id, _PURPLE))
    for number, marker in enumerate(markers):
        marker.id = number
    return MarkerArray(markers)


def _object(item: CollisionObject, colour: ColorRGBA) -> List[Marker]:
    base, result = convert.pose(item.pose), []
    shapes = [(_primitive(shape), pose) for shape, pose in zip(item.primitives, item.primitive_poses)]
    shapes += [(_mesh(shape), pose) for shape, pose in zip(item.meshes, item.mesh_poses)]
    for marker, pose in shapes:
        marker.header.frame_id, marker.ns = item.header.frame_id, item.id
        marker.color, marker.frame_locked = colour, True
        marker.pose = convert.pose_message(base * convert.pose(pose))
        result.append(marker)
    return result


def _primitive(shape: SolidPrimitive) -> Marker:
    size = list(shape.dimensions)
    if shape.type == SolidPrimitive.BOX:
        return Marker(type=Marker.CUBE, scale=Vector3(*size))
    if shape.type == SolidPrimitive.SPHERE:
        return Marker(type=Marker.SPHERE, scale=Vector3(*[2 * size[0]] * 3))
    return Marker(type=Marker.CYLINDER, scale=Vector3(2 * size[1], 2 * size[1],
                                                      size[0]))  # a cone is shown by the cylinder around it


def _mesh(shape) -> Marker:
    marker = Marker(type=Marker.TRIANGLE_LIST, scale=Vector3(1, 1, 1))
    for triangle in shape.triangles:
        marker.points += [Point(vertex.x, vertex.y,
                                vertex.z) for vertex in (shape.vertices[index] for index in triangle.vertex_indices)]
    return marker
