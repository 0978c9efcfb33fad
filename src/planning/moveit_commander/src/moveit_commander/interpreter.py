"""Commands as lines of text: what moveit_commander_cmdline.py reads."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable

import rospy
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import MoveItErrorCodes

from . import conversions
from .exception import MoveItCommanderException
from .move_group import MoveGroupCommander
from .planning_scene_interface import PlanningSceneInterface
from .robot import RobotCommander


class MoveGroupInfoLevel:
    """How an answer is to be shown."""

    FAIL = 1
    WARN = 2
    SUCCESS = 3
    INFO = 4
    DEBUG = 5


Answer = tuple[int, str]
_OK = (MoveGroupInfoLevel.DEBUG, "OK")
_HELP = """Known commands:
  help                             show this text
  allow looking|replanning <true|false>
  constrain                        clear path constraints
  constrain <name>                 constrain paths by what the database has under a name
  current                          show the current state of the group
  database [<file>|<host> <port>]  open a database of constraints, or list what it has
  group_state                      the current state, to paste into an SRDF
  delete <name>                    forget the joint values <name>
  eef                              name of the end effector link
  execute                          execute the plan computed before
  go <name>                        plan and move to the state <name>
  go rand                          plan and move to a random state
  go <dir> <dx>                    move up|down|left|right|forward|backward by <dx> m
  go <x y z roll pitch yaw> [approx]   move to a pose
  ground                           add a ground to the planning scene
  id | which                       name of the group
  joints                           names of the joints of the group
  load [<file>]                    execute commands from a file
  pick <name>                      pick up an object
  place <name>                     put an object down
  plan <name> | plan rand          plan only
  planner <name>                   use a planner for the next motions
  record <name>                    remember the current joint values as <name>
  rotate <r> <p> <y>               move to an orientation (rad)
  save [<file>]                    save what is remembered as commands
  show [<name>]                    show remembered joint values
  stop                             stop the motion
  time [<val>]                     show or set the planning time (s)
  tolerance [<val>]                show or set the tolerance of goals
  trace <on|off>                   print commands loaded from files
  use <name>                       switch to a group
  use | groups                     groups loaded so far
  vars                             names that are remembered
  wait <dt>                        wait for <dt> s
  x = y | x = [v1 v2 ...] | x[idx] = val   assign joint values"""


def _numbers(values) -> str:
    return "[" + " ".join(str(value) for value in values) + "]"


class MoveGroupCommandInterpreter:
    """Executes one line at a time: :meth:`execute` gives (level, text)."""

    DEFAULT_FILENAME = "move_group.cfg"
    GO_DIRS = {
        "up": (2, 1),
        "down": (2, -1),
        "z": (2, 1),
        "left": (1, 1),
        "right": (1, -1),
        "y": (1, 1),
        "forward": (0, 1),
        "backward": (0, -1),
        "back": (0, -1),
        "x": (0, 1),
    }

    def __init__(self) -> None:
        self._gdict: dict[str, MoveGroupCommander] = {}
        self._group_name = ""
        self._prev_group_name = ""
        self._planning_scene_interface = PlanningSceneInterface()
        self._robot = RobotCommander()
        self._last_plan = None
        self._trace = False

    def get_active_group(self) -> MoveGroupCommander | None:
        return self._gdict.get(self._group_name)

    def get_loaded_groups(self):
        return self._gdict.keys()

    def execute(self, cmd: str) -> Answer:
        """Execute one line, ``cmd``."""
        words = cmd.split()
        if not words:
            return _OK
        words[0] = {"which": "id", "groups": "use"}.get(words[0].lower(), words[0].lower())
        generic: dict[str, Callable[[list[str]], Answer]] = {
            "use": self._use,
            "trace": self._set_trace,
            "load": self._load,
            "save": self._save,
            "help": self._help,
        }
        try:
            if words[0] in generic and "=" not in words:
                return generic[words[0]](words)
            if os.path.isfile("cmd/" + cmd):
                return self._load(["load", "cmd/" + cmd])
            group = self.get_active_group()
            if group is None:
                return (
                    MoveGroupInfoLevel.INFO,
                    self.get_help() + "\n\nNo groups initialized yet. You must call the 'use' or the 'load' command first.\n",
                )
            return self.execute_group_command(group, " ".join([words[0]] + words[1:]))
        except MoveItCommanderException as error:
            return (MoveGroupInfoLevel.WARN, str(error))

    # --- for all groups ---

    def _help(self, _words: list[str]) -> Answer:
        return (MoveGroupInfoLevel.INFO, self.get_help())

    def _use(self, words: list[str]) -> Answer:
        if len(words) == 1:
            return (MoveGroupInfoLevel.INFO, "\n".join(self.get_loaded_groups()))
        name = self._prev_group_name if words[1] == "previous" else words[1]
        if not name:
            return _OK
        if name not in self._gdict:
            try:
                self._gdict[name] = MoveGroupCommander(name)
            except (RuntimeError, MoveItCommanderException) as error:
                return (MoveGroupInfoLevel.FAIL, f"Initializing {name}: {error}")
        self._prev_group_name, self._group_name = self._group_name, name
        return _OK

    def _set_trace(self, words: list[str]) -> Answer:
        if len(words) == 1:
            return (MoveGroupInfoLevel.INFO, "trace is on" if self._trace else "trace is off")
        self._trace = words[1].lower() == "on"
        return _OK

    def _load(self, words: list[str]) -> Answer:
        if len(words) > 2:
            return (MoveGroupInfoLevel.WARN, "Unable to parse load command")
        name = words[1] if len(words) == 2 else self.DEFAULT_FILENAME
        name = name if os.path.isfile(name) else "cmd/" + name
        try:
            with open(name) as file:
                lines = file.read().splitlines()
        except OSError as error:
            return (MoveGroupInfoLevel.WARN, f"Unable to load {name}: {error.strerror}")
        for number, line in enumerate(lines, 1):
            if self._trace:
                print(f"{name}:{number}:  {line}")
            line = line.split("#")[0].strip()
            level, text = self.execute(line) if line else _OK
            if level in (MoveGroupInfoLevel.FAIL, MoveGroupInfoLevel.WARN):
                return (MoveGroupInfoLevel.WARN, f"Error at {name}:{number}:  {line}\n{text}")
        return _OK

    def _save(self, words: list[str]) -> Answer:
        if len(words) > 2:
            return (MoveGroupInfoLevel.WARN, "Unable to parse save command")
        name = words[1] if len(words) == 2 else self.DEFAULT_FILENAME
        lines = []
        for group, commander in self._gdict.items():
            lines.append(f"use {group}")
            lines += [f"{key} = {_numbers(values)}" for key, values in commander.get_remembered_joint_values().items()]
        try:
            with open(name, "w") as file:
                file.write("".join(line + "\n" for line in lines))
        except OSError as error:
            return (MoveGroupInfoLevel.WARN, f"Unable to save {name}: {error.strerror}")
        return _OK

    # --- for the active group ---

    def execute_group_command(self, g: MoveGroupCommander, cmdorig: str) -> Answer:
        """Execute the line ``cmdorig`` with the group ``g``."""
        words = cmdorig.split()
        words[0] = words[0].lower()
        answer = self._assignment(g, cmdorig)
        if answer is not None:
            return answer
        handler = getattr(self, f"_do_{len(words) - 1}_{words[0]}", None) or getattr(self, f"_do_{words[0]}", None)
        if handler is not None:
            try:
                return handler(g, words)
            except (ValueError, IndexError):
                return (MoveGroupInfoLevel.WARN, f"Unable to parse '{cmdorig}'")
        known = g.get_remembered_joint_values()
        if len(words) == 1 and words[0] in known:
            return (MoveGroupInfoLevel.INFO, _numbers(known[words[0]]))
        return (MoveGroupInfoLevel.WARN, f"Unknown command: '{cmdorig}'")

    @staticmethod
    def _assignment(g: MoveGroupCommander, line: str) -> Answer | None:
        known = g.get_remembered_joint_values()
        copy = re.match(r"^(\w+)\s*=\s*(\w+)$", line)
        if copy and copy.group(2) in known:
            g.remember_joint_values(copy.group(1), known[copy.group(2)])
            return (MoveGroupInfoLevel.SUCCESS, f"{copy.group(1)} is now the same as {copy.group(2)}")
        vector = re.match(r"^(\w+)\s*=\s*\[([\d.eE+\-\s]+)\]$", line)
        element = re.match(r"^(\w+)\s*\[\s*(\d+)\s*\]\s*=\s*([\d.eE+\-]+)$", line)
        try:
            if vector:
                g.remember_joint_values(vector.group(1), [float(value) for value in vector.group(2).split()])
                return (MoveGroupInfoLevel.SUCCESS, f"Remembered joint values [{vector.group(2)}] under the name {vector.group(1)}")
            if element and element.group(1) in known:
                values = known[element.group(1)]
                values[int(element.group(2))] = float(element.group(3))
                g.remember_joint_values(element.group(1), values)
                return (MoveGroupInfoLevel.SUCCESS, f"Updated {element.group(1)}[{element.group(2)}]")
        except (ValueError, IndexError):
            return (MoveGroupInfoLevel.WARN, f"Unable to parse index or value in '{line}'")
        return (MoveGroupInfoLevel.WARN, f"Unknown command: '{line}'") if copy or element else None

    def _do_stop(self, g, _words) -> Answer:
        g.stop()
        return _OK

    def _do_id(self, g, _words) -> Answer:
        return (MoveGroupInfoLevel.INFO, g.get_name())

    def _do_vars(self, g, _words) -> Answer:
        return (MoveGroupInfoLevel.INFO, _numbers(g.get_remembered_joint_values()))

    def _do_joints(self, g, _words) -> Answer:
        rows = [f"{index} = {name}" for index, name in enumerate(g.get_joints())]
        return (MoveGroupInfoLevel.INFO, "\n" + "\n".join(rows) + "\n")

    def _do_0_show(self, g, _words) -> Answer:
        return (
            MoveGroupInfoLevel.INFO,
            "\n".join(f"{name} = {_numbers(values)}" for name, values in g.get_remembered_joint_values().items()),
        )

    def _do_1_show(self, g, words) -> Answer:
        known = g.get_remembered_joint_values()
        if words[1] not in known:
            return (MoveGroupInfoLevel.WARN, f"Joint values for {words[1]} are not known")
        return (MoveGroupInfoLevel.INFO, _numbers(known[words[1]]))

    def _do_current(self, g, _words) -> Answer:
        text = "joints = [" + ", ".join(str(value) for value in g.get_current_joint_values()) + "]"
        link = g.get_end_effector_link()
        if link:
            text += f"\n\n{link} pose = [\n{g.get_current_pose()} ]\n{link} RPY = {g.get_current_rpy()}"
        return (MoveGroupInfoLevel.INFO, text)

    def _do_group_state(self, g, _words) -> Answer:
        rows = [
            f'        <joint name="{name}" value="{value}"/>' for name, value in zip(g.get_active_joints(), g.get_current_joint_values())
        ]
        return (
            MoveGroupInfoLevel.INFO,
            f'    <group_state name="custom_state" group="{g.get_name()}">\n' + "\n".join(rows) + "\n    </group_state>",
        )

    def _do_ground(self, _g, _words) -> Answer:
        pose = PoseStamped()
        pose.pose.position.z = -0.0501  # 0.1 mm below the robot's foot, which is to touch nothing
        pose.pose.orientation.w = 1.0
        pose.header.stamp, pose.header.frame_id = rospy.get_rostime(), self._robot.get_root_link()
        self._planning_scene_interface.attach_box(self._robot.get_root_link(), "ground", pose, (3, 3, 0.1))
        return (MoveGroupInfoLevel.INFO, "Added ground")

    def _do_eef(self, g, _words) -> Answer:
        return (MoveGroupInfoLevel.INFO, g.get_end_effector_link() or "There is no end effector defined")

    def _do_database(self, g, words) -> Answer:
        if len(words) > 1:
            try:
                g.set_constraints_database(words[1], int(words[2]) if len(words) > 2 else 33829)
            except (MoveItCommanderException, ValueError) as error:
                return (MoveGroupInfoLevel.WARN, f"Not connected to a database: {error}")
        known = g.get_known_constraints()
        return (
            MoveGroupInfoLevel.INFO,
            "Constraints of the database: " + ", ".join(known)
            if known
            else "Not connected to a database, or it has no constraints for this group",
        )

    def _do_0_constrain(self, g, _words) -> Answer:
        g.clear_path_constraints()
        return (MoveGroupInfoLevel.SUCCESS, "Cleared path constraints")

    def _do_1_constrain(self, g, words) -> Answer:
        try:
            g.set_path_constraints(words[1])
        except MoveItCommanderException as error:
            return (MoveGroupInfoLevel.WARN, str(error))
        return (MoveGroupInfoLevel.SUCCESS, f"Constraining paths by {words[1]}")

    def _do_0_tolerance(self, g, _words) -> Answer:
        return (MoveGroupInfoLevel.INFO, "Joint = %0.6g, Position = %0.6g, Orientation = %0.6g" % g.get_goal_tolerance())

    def _do_1_tolerance(self, g, words) -> Answer:
        g.set_goal_tolerance(float(words[1]))
        return (MoveGroupInfoLevel.SUCCESS, "OK")

    _do_0_tol, _do_1_tol = _do_0_tolerance, _do_1_tolerance

    def _do_0_time(self, g, _words) -> Answer:
        return (MoveGroupInfoLevel.INFO, str(g.get_planning_time()))

    def _do_1_time(self, g, words) -> Answer:
        g.set_planning_time(float(words[1]))
        return (MoveGroupInfoLevel.SUCCESS, "OK")

    def _do_1_wait(self, _g, words) -> Answer:
        time.sleep(float(words[1]))
        return (MoveGroupInfoLevel.SUCCESS, f"{words[1]} seconds passed")

    def _do_1_planner(self, g, words) -> Answer:
        g.set_planner_id(words[1])
        return (MoveGroupInfoLevel.SUCCESS, f"Planner is now {words[1]}")

    def _do_1_record(self, g, words) -> Answer:
        g.remember_joint_values(words[1])
        return (MoveGroupInfoLevel.SUCCESS, f"Remembered current joint values under the name {words[1]}")

    def _do_1_random(self, g, words) -> Answer:
        g.remember_joint_values(words[1], g.get_random_joint_values())
        return (MoveGroupInfoLevel.SUCCESS, f"Remembered random joint values under the name {words[1]}")

    def _do_1_delete(self, g, words) -> Answer:
        g.forget_joint_values(words[1])
        return (MoveGroupInfoLevel.SUCCESS, f"Forgot joint values under the name {words[1]}")

    _do_1_rec, _do_1_rand, _do_1_del = _do_1_record, _do_1_random, _do_1_delete

    def _do_2_allow(self, g, words) -> Answer:
        allowed = words[2] in ("1", "true", "T", "True")
        if words[1] in ("look", "looking"):
            g.allow_looking(allowed)
        elif words[1] in ("replan", "replanning"):
            g.allow_replanning(allowed)
        else:
            return (MoveGroupInfoLevel.WARN, f"Unknown command: 'allow {words[1]}'")
        return _OK

    # --- motions ---

    def _do_0_plan(self, _g, _words) -> Answer:
        return (MoveGroupInfoLevel.INFO, "No previous plan" if self._last_plan is None else str(self._last_plan))

    def _do_1_plan(self, g, words) -> Answer:
        self._last_plan = None
        where = self._target(g, words[1])
        good, plan, _, _ = g.plan()
        if not good or not (plan.joint_trajectory.points or plan.multi_dof_joint_trajectory.points):
            return (MoveGroupInfoLevel.FAIL, f"Failed while planning to {where}")
        self._last_plan = plan
        return (MoveGroupInfoLevel.SUCCESS, f"Planned to {where}")

    @staticmethod
    def _target(g, name: str) -> str:
        if name in ("rand", "random"):
            values = g.get_random_joint_values()
            g.set_joint_value_target(values)
            return _numbers(values)
        g.set_named_target(name)
        return name

    def _do_execute(self, g, _words) -> Answer:
        if self._last_plan is None:
            return (MoveGroupInfoLevel.WARN, "No motion plan computed")
        if g.execute(self._last_plan):
            return (MoveGroupInfoLevel.SUCCESS, "Plan submitted for execution")
        return (MoveGroupInfoLevel.WARN, "Failed to submit plan for execution")

    def _do_1_go(self, g, words) -> Answer:
        self._last_plan = None
        where = self._target(g, words[1])
        where = f"random target {where}" if words[1] in ("rand", "random") else where
        return self._go(g, f"Moved to {where}", f"Failed while moving to {where}")

    def _do_2_go(self, g, words) -> Answer:
        self._last_plan = None
        if words[1] not in self.GO_DIRS:
            return (MoveGroupInfoLevel.WARN, f"Unknown direction '{words[1]}'; there are: {', '.join(self.GO_DIRS)}")
        if not g.has_end_effector_link():
            return (MoveGroupInfoLevel.WARN, f"No known end effector. Cannot move {words[1]}")
        axis, sign = self.GO_DIRS[words[1]]
        g.shift_pose_target(axis, sign * float(words[2]))
        return self._go(g, f"Moved {words[1]} by {float(words[2])} m", f"Failed while moving {words[1]}")

    def _do_6_go(self, g, words) -> Answer:
        self._last_plan = None
        pose = conversions.list_to_pose([float(value) for value in words[1:7]])
        if words[7:8] in (["approx"], ["approximate"]):
            g.set_joint_value_target(pose, True)
        else:
            g.set_pose_target(pose)
        return self._go(g, f"Moved to pose target\n{pose}\n", f"Failed while moving to pose \n{pose}\n")

    _do_7_go = _do_6_go

    def _do_3_rotate(self, g, words) -> Answer:
        g.set_rpy_target([float(value) for value in words[1:]])
        return self._go(g, "Rotation complete", f"Failed while rotating to {' '.join(words[1:])}")

    @staticmethod
    def _go(g, good: str, bad: str) -> Answer:
        return (MoveGroupInfoLevel.SUCCESS, good) if g.go() else (MoveGroupInfoLevel.FAIL, bad)

    def _do_1_pick(self, g, words) -> Answer:
        self._last_plan = None
        if g.pick(words[1]) == MoveItErrorCodes.SUCCESS:
            return (MoveGroupInfoLevel.SUCCESS, f"Picked object {words[1]}")
        return (MoveGroupInfoLevel.FAIL, f"Failed while trying to pick object {words[1]}")

    def _do_1_place(self, g, words) -> Answer:
        self._last_plan = None
        if g.place(words[1]):
            return (MoveGroupInfoLevel.SUCCESS, f"Placed object {words[1]}")
        return (MoveGroupInfoLevel.FAIL, f"Failed while trying to place object {words[1]}")

    # --- help ---

    def get_help(self) -> str:
        return _HELP

    def get_keywords(self) -> dict[str, list[str]]:
        """What may follow each command, for completion."""
        group = self.get_active_group()
        known = list(group.get_remembered_joint_values()) if group is not None else []
        named = list(group.get_named_targets()) if group is not None else []
        alone = (
            "help",
            "wait",
            "group_state",
            "current",
            "load",
            "save",
            "pick",
            "place",
            "constrain",
            "vars",
            "joints",
            "tolerance",
            "time",
            "eef",
            "execute",
            "ground",
            "id",
            "stop",
            "planner",
            "rotate",
        )
        keywords: dict[str, list[str]] = {name: [] for name in alone}
        directions = ["up", "down", "left", "right", "backward", "forward"]
        keywords.update(go=directions + ["random"] + named, plan=["random"] + named, record=known, show=known)
        keywords.update(delete=known, use=self._robot.get_group_names(), allow=["replanning", "looking"])
        keywords["trace"] = ["on", "off"]
        return keywords
