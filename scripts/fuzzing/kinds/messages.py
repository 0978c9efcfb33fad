"""Service calls and topic messages with extreme fields, to a running simulator with the labs' robots and controllers."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

from fuzzing import move_group, ros, seeds, simulation, tree_cases, values, xml_cases
from fuzzing.findings import check_message
from fuzzing.kinds import Kind

_INTEGERS = {
    "byte": (-128, 127),
    "char": (0, 255),
    **{f"int{n}": (-(2 ** (n - 1)), 2 ** (n - 1) - 1) for n in (8, 16, 32, 64)},
    **{f"uint{n}": (0, 2**n - 1) for n in (8, 16, 32, 64)},
}
_FLOATS = (float("nan"), float("inf"), -3e38, 3e38, 1e-38, 1e9)  # of 32 bits


class MessageKind(Kind):
    """JSON: ``messages``, a list of ``["service" | "topic", name, type, fields]``; after each the server must answer and time go on."""

    name, suffix = "messages", ".json"
    time_limit = 120.0
    wall_limit = 240.0
    memory = 12 << 30
    cases_per_worker = 10**9
    silent = False

    def prepare(self) -> None:
        self._targets = simulation.listed()
        texts = simulation.robot_texts()
        names = {
            tag: [f"{model}::{name}" for model, text in texts.items() for name in re.findall(rf'<{tag} [^>]*?name="([^"]+)"', text)]
            for tag in ("link", "joint")
        }
        plain = [name.split("::")[1] for name in names["joint"]]
        self._strings: dict[str, list[str]] = {
            "model_name": list(texts),
            "link_name": names["link"],
            "body_name": names["link"],
            "joint_names": plain,
            "joint_name": names["joint"] + plain,
            "reference_frame": ["", "world", *names["link"]],
            "name": ["joint0_position_controller", "arm_controller", "max_update_rate", "gravity_z", "time_step", "pause"],
            "start_controllers": ["joint0_position_controller", "joint_state_controller"],
            "stop_controllers": ["joint1_position_controller"],
            "light_name": ["sun"],
            "frame_id": ["", "world", "base_link"],
        }
        self._xml = {
            "urdf": xml_cases.XmlMutator([text for text in seeds.robots().values() if len(text) < 4000]),
            "sdf": xml_cases.XmlMutator([text for text in seeds.models().values() if len(text) < 4000]),
        }

    def start(self, folder: Path, number: int) -> None:
        self._simulation = simulation.Simulation(folder, number)
        self._broken = False

    def stop(self) -> None:
        self._simulation.stop()

    # ------------------------------------------------------------------------------------------ making

    def generate(self, random: Random) -> bytes:
        messages = []
        for _ in range(random.choice((1, 1, 1, 2, 3))):
            what, name, kind = random.choice(self._targets)
            extreme = random.choice((0.05, 0.2, 0.6))
            messages.append([what, name, kind, self._fields(random, _message_class(what, kind), extreme)])
        return json.dumps({"messages": messages}).encode()

    def _fields(self, random: Random, kind: type, extreme: float) -> dict[str, Any]:
        return {name: self._value(random, name, slot, extreme) for name, slot in zip(kind.__slots__, kind._slot_types)}

    def _value(self, random: Random, name: str, slot: str, extreme: float) -> Any:
        import roslib.message

        array = re.match(r"(.*)\[(\d*)\]$", slot)
        if array:
            count = int(array[2]) if array[2] else random.choice((0, 1, 1, 2, 4, 6, 30))
            return [self._value(random, name, array[1], extreme) for _ in range(count)]
        if slot in _INTEGERS:
            low, high = _INTEGERS[slot]
            return random.choice((low, high)) if random.random() < extreme else random.randint(max(low, -3), min(high, 3))
        if slot in ("float32", "float64"):
            if random.random() < extreme:
                return random.choice(values.NUMBERS if slot == "float64" else _FLOATS)
            return random.choice((0.0, 1.0, 0.001, 1000.0, random.gauss(0.0, 1.0)))
        if slot == "bool":
            return random.random() < 0.5
        if slot == "string":
            return self._string(random, name, extreme)
        if slot in ("time", "duration"):
            low = 0 if slot == "time" else -(2**31)
            return [random.choice((0, 0, 1, 2**31 - 1, low, -1 if low else 7)), random.choice((0, 0, 1, 999999999))]
        return self._fields(random, roslib.message.get_message_class(slot), extreme)

    def _string(self, random: Random, name: str, extreme: float) -> str:
        if name.endswith("_xml"):
            return self._xml[random.choice(("urdf", "sdf"))].case(random)[:50000].decode("utf-8", "ignore")
        known = self._strings.get(name, [])
        if known and random.random() > extreme:
            return random.choice(known)
        return random.choice(random.choice((values.NAMES, values.ODDITIES, known or ["x"])))

    # ------------------------------------------------------------------------------------------ running

    def run(self, case: bytes) -> None:
        if self._broken:
            self._simulation.recover()
            self._broken = False
        try:
            for what, name, kind, fields in json.loads(case)["messages"]:
                self._send(what, name, kind, fields)
            self._simulation.check()
        except Exception:
            self._broken = True
            raise

    def _send(self, what: str, name: str, kind: str, fields: dict[str, Any]) -> None:
        import genpy
        import rospy
        import rosservice

        message = _filled(_message_class(what, kind), fields)
        if what == "topic":
            try:
                self._simulation.publish(name, message)
            except (rospy.ROSSerializationException, genpy.SerializationError):
                return
            time.sleep(0.005)
            return
        if name.endswith(("/switch_controller", "/reload_controller_libraries")):
            self._simulation.call("/gazebo/unpause_physics")  # in a paused world it waits, as it should: the loop stops controllers
        try:
            answer = self._simulation.call(name, message)
        except (genpy.SerializationError, rosservice.ROSServiceException):  # the latter: a message before has taken it away
            return
        except rospy.ServiceException as error:
            ros.check_line(str(error))  # a service that refuses may say so by an error
            return
        for field in ("status_message", "message"):
            said = getattr(answer, field, "")
            if said and isinstance(said, str):
                check_message(said, f"answer of {name}")

    def smaller(self, case: bytes) -> Iterator[bytes]:
        messages = json.loads(case)["messages"]
        for fewer in tree_cases.runs(messages):
            yield json.dumps({"messages": fewer}).encode()
        for i, (*_, fields) in enumerate(messages):
            for path in list(tree_cases.places(fields)):
                value = tree_cases.value_at(fields, path)
                plain = {float: 0.0, int: 0, str: "", list: [], bool: False}.get(type(value))
                if plain is not None and value != plain:
                    changed = json.loads(json.dumps(messages))
                    tree_cases.value_at(changed[i][3], path[:-1])[path[-1]] = plain
                    yield json.dumps({"messages": changed}).encode()


class PlanningKind(MessageKind):
    """Requests to move_group: its services, the goals of its actions, scenes and states, as JSON like the others."""

    name, suffix = "planning", ".planning.json"
    time_limit = 60.0

    def prepare(self) -> None:
        kept = ("/set_logger_level", "/save_map")  # the latter writes where it is told to
        self._targets = [target for target in simulation.listed("fuzzing.move_group") if not target[1].endswith(kept)]
        things = ["box", "ball", "<octomap>"]
        links = ["hand", "base_link", "tool0"]
        self._strings = {
            "group_name": list(move_group.GROUPS),
            "group": list(move_group.GROUPS),
            "name": [*move_group.JOINTS, "finger_joint"],
            "joint_name": move_group.JOINTS,
            "joint_names": move_group.JOINTS,
            "frame_id": ["", "world", "base_link", "hand", "box"],
            "link_name": links,
            "ik_link_name": links,
            "fk_link_names": links,
            "pipeline_id": ["", "ompl", "pilz_industrial_motion_planner"],
            "planner_id": ["", "RRTConnect", "PTP", "LIN", "CIRC"],
            "planner_config": ["RRTConnect", "RRT"],
            "id": things,
            "target_name": things,
            "attached_object_name": things,
            "support_surface_name": things,
            "touch_links": links,
            "end_effector": ["hand", ""],
            "data": ["stop", ""],
            "filename": ["nowhere/map.bt"],
        }
        self._xml = {}

    def start(self, folder: Path, number: int) -> None:
        self._simulation = move_group.MoveGroup(folder, number)
        self._broken = False

    def _fields(self, random: Random, kind: type, extreme: float) -> dict[str, Any]:
        if getattr(kind, "_type", "") == "moveit_msgs/MotionPlanRequest" and random.random() < 0.5:
            return self._industrial(random, extreme)
        return super()._fields(random, kind, extreme)

    def _industrial(self, random: Random, extreme: float) -> dict[str, Any]:
        """A request for PTP, LIN or CIRC that can be planned, but for what is changed in it."""
        request = json.loads(json.dumps(random.choice(move_group.industrial_requests())))
        for _ in range(random.choice((0, 1, 1, 2, 4))):
            path = random.choice([path for path in tree_cases.places(request) if path])
            holder, value = tree_cases.value_at(request, path[:-1]), tree_cases.value_at(request, path)
            if isinstance(value, list):
                holder[path[-1]] = random.choice(([], value * 2))
            elif isinstance(value, bool):
                holder[path[-1]] = not value
            elif isinstance(value, str):
                holder[path[-1]] = self._string(random, str(path[-1]), extreme)
            elif isinstance(value, float):
                holder[path[-1]] = value + random.choice((0.01, -0.1, random.choice(values.NUMBERS)))
        request["allowed_planning_time"] = 0.2
        return request

    def _value(self, random: Random, name: str, slot: str, extreme: float) -> Any:
        if name == "allowed_planning_time":  # more is what was asked for, and no fault
            return random.choice((0.0, 0.05, 0.2, -1.0, float("nan")))
        if name == "allow_looking" or (name == "replan" and slot == "bool"):
            return False
        return super()._value(random, name, slot, extreme)

    def _string(self, random: Random, name: str, extreme: float) -> str:
        known = self._strings.get(name, [])
        if known and random.random() > extreme:
            return random.choice(known)
        return random.choice(random.choice((values.NAMES, values.ODDITIES, known or ["x"])))


def _message_class(what: str, kind: str) -> type:
    import roslib.message

    if what == "service":
        return roslib.message.get_service_class(kind)._request_class
    return roslib.message.get_message_class(kind)


def _filled(kind: type, fields: dict[str, Any]) -> Any:
    """A message of nested maps and lists; what is missing keeps its default."""
    message = kind()
    for name, slot in zip(kind.__slots__, kind._slot_types):
        if name in fields:
            setattr(message, name, _filled_value(slot, fields[name]))
    return message


def _filled_value(slot: str, value: Any) -> Any:
    import genpy
    import roslib.message

    array = re.match(r"(.*)\[(\d*)\]$", slot)
    if array and array[1] in ("uint8", "char"):
        return bytes(value)
    if array:
        return [_filled_value(array[1], entry) for entry in value]
    if slot in ("time", "duration"):
        made = genpy.Time() if slot == "time" else genpy.Duration()
        made.secs, made.nsecs = value
        return made
    if "/" in slot:
        return _filled(roslib.message.get_message_class(slot), value)
    return value
