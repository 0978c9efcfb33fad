"""Motion planning from outside, as a student does it: launch, a scene, plan, execute, a straight line, pick and place."""

from __future__ import annotations

import argparse
import csv
import os
import threading
import time
from pathlib import Path

import demonstration
from demonstration import DemoError, save_report

JOINTS = ("shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint")
TOLERANCE = 0.01  # rad between where the arm was sent and where it is
LINE = 0.002  # m off a straight line
PLACE = (0.5, 0.3, 0.9605)  # where the block goes: its middle, a hair above the table


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="scripts/demo_motion", description=__doc__)
    demonstration.add_options(parser, "out/demo_motion")
    options = parser.parse_args()
    demonstration.check_folder(parser, options.out)
    return options


def say(text: str) -> None:
    print(f"[demo_motion] {text}", flush=True)


class Recorder:
    """Where the arm is, and what its controller was told: rows (time s, six joints rad) in sim time."""

    def __init__(self):
        import rospy
        from control_msgs.msg import FollowJointTrajectoryActionGoal
        from sensor_msgs.msg import JointState

        self.rows, self.planned = [], []
        self._lock = threading.Lock()
        rospy.Subscriber("/joint_states", JointState, self._state, queue_size=100)
        rospy.Subscriber("/arm_controller/follow_joint_trajectory/goal", FollowJointTrajectoryActionGoal, self._goal)

    def _state(self, message) -> None:
        at = dict(zip(message.name, message.position))
        if all(name in at for name in JOINTS):
            with self._lock:
                self.rows.append((message.header.stamp.to_sec(), *(at[name] for name in JOINTS)))

    def _goal(self, message) -> None:
        names, start = message.goal.trajectory.joint_names, message.header.stamp.to_sec()
        self.planned.append(
            [
                (start + point.time_from_start.to_sec(), *(point.positions[names.index(name)] for name in JOINTS))
                for point in message.goal.trajectory.points
            ]
        )

    def since(self, moment: float) -> list:
        """Rows from a sim time on."""
        with self._lock:
            return [row for row in self.rows if row[0] >= moment]

    def error(self) -> float:
        """The largest distance (rad) of a joint from the last way point of its last trajectory."""
        return max(abs(a - b) for a, b in zip(self.rows[-1][1:], self.planned[-1][-1][1:]))


def save_picture(path: Path, title: str, pictures: list) -> None:
    """The next picture of the spectator's camera in the simulated world."""
    import numpy as np
    import rospy
    from PIL import Image as Picture
    from sensor_msgs.msg import Image

    try:
        message = rospy.wait_for_message("/spectator/image_raw", Image, timeout=30)
    except rospy.ROSException:
        return say("no picture came from /spectator/image_raw")
    pixels = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, : message.width * 3]
    Picture.fromarray(np.ascontiguousarray(pixels.reshape(message.height, message.width, 3))).save(path)
    pictures.append((path, title))


def save_rviz(path: Path, title: str, pictures: list) -> None:
    """What RViz shows: robot, scene, planned path."""
    import rospkg
    from rviz_offscreen.cli import ScreenshotError, take
    from rviz_offscreen.views import parse_view

    config = os.path.join(rospkg.RosPack().get_path("myur5_moveit_config"), "launch", "moveit.rviz")
    try:
        taken = take(config, [parse_view("yaw=-0.7,pitch=0.45,distance=2.4,x=0.35,y=0,z=1.05")], str(path), size="960x720")
        pictures += [(Path(taken["pictures"][0]), title)]
    except ScreenshotError as error:
        say(f"no RViz picture: {error}")


def save_plot(path: Path, recorder: Recorder, marks: list) -> None:
    """Planned way points on the curves of what the joints did."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(12, 5.5))
    for column, name in enumerate(JOINTS):
        (line,) = axes.plot([row[0] for row in recorder.rows], [row[1 + column] for row in recorder.rows], linewidth=1.2, label=name)
        for part in recorder.planned:
            axes.plot([row[0] for row in part], [row[1 + column] for row in part], ".", color=line.get_color(), markersize=5)
    for moment, text in marks:
        axes.axvline(moment, color="grey", linewidth=0.8, linestyle=":")
        axes.annotate(text, (moment, 1.0), xycoords=("data", "axes fraction"), rotation=90, va="top", fontsize=8)
    axes.set(xlabel="sim time [s]", ylabel="joint position [rad]", title="Lines: /joint_states. Dots: planned way points")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def demand(good, text: str) -> None:
    """:raises DemoError: ``good`` is not."""
    if not good:
        raise DemoError(f"{text}; see launch.log")


class Show:
    """The acts, one after the other. ``figures`` and ``pictures`` are what the report shows."""

    def __init__(self, out: Path, recorder: Recorder):
        import moveit_commander

        self.out, self.figures, self.pictures, self.marks = out, {}, [], []
        self.recorder = recorder
        try:
            self.arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        except RuntimeError as error:
            raise DemoError(f"move_group did not come up: {error}") from error
        self.scene = moveit_commander.PlanningSceneInterface()
        self.arm.set_max_velocity_scaling_factor(0.5)
        self.arm.set_planning_time(20.0)

    def now(self, text: str) -> float:
        """Begin an act; the sim time."""
        import rospy

        say(text)
        moment = rospy.get_time()
        self.marks.append((moment, text))
        return moment

    def arrived(self, name: str) -> None:
        time.sleep(0.2)
        error = self.recorder.error()
        self.figures[f"{name}: joints off their goal"] = f"{error:.6f} rad at most"
        demand(error < TOLERANCE, f"{name}: a joint is {error:.4f} rad off")

    def round_the_post(self) -> None:
        """From one side of the post to the other; the way between is not free."""
        self.now("to the block's side of the table")
        pose = self.arm.get_current_pose().pose
        pose.position.x, pose.position.y, pose.position.z = 0.55, -0.3, 1.15
        self.arm.set_pose_target(pose)
        demand(self.arm.go(wait=True), "the first motion failed")
        self.now("round the post")
        pose.position.y = 0.3
        self.arm.set_pose_target(pose)
        good, plan, seconds, _ = self.arm.plan()
        demand(good, "no way round the post was found")
        save_rviz(self.out / "rviz-plan.png", "RViz: the planning scene, before the way round the post", self.pictures)
        demand(self.arm.execute(plan, wait=True), "the way round the post was not executed")
        self.figures["round the post"] = (
            f"planned in {seconds * 1e3:.0f} ms, {len(plan.joint_trajectory.points)} way points, "
            f"{plan.joint_trajectory.points[-1].time_from_start.to_sec():.2f} s of motion"
        )
        self.arrived("round the post")

    def straight_line(self) -> None:
        """20 cm straight along x and z."""
        import motion
        import numpy as np
        import rospy

        moment = self.now("a straight line")
        pose = self.arm.get_current_pose().pose
        start = np.array((pose.position.x, pose.position.y, pose.position.z))
        pose.position.x, pose.position.z = pose.position.x + 0.12, pose.position.z + 0.16
        plan, fraction = self.arm.compute_cartesian_path([pose], 0.005, 0.0)
        demand(fraction == 1.0, f"only {fraction:.0%} of the straight line can be gone")
        demand(self.arm.execute(plan, wait=True), "the straight line was not executed")
        model = motion.load_model(rospy.get_param("robot_description"), rospy.get_param("robot_description_semantic"), meshes=False)
        state, axis = model.state(), np.array((0.6, 0.0, 0.8))
        off = 0.0
        for row in self.recorder.since(moment):
            state.set(dict(zip(JOINTS, row[1:])))
            way = np.asarray(state.pose("tool0").position) - start
            off = max(off, float(np.linalg.norm(way - axis * (way @ axis))))
        self.figures["straight line of 0.2 m"] = f"the flange stays within {off * 1e3:.2f} mm of it"
        demand(off < LINE, f"the flange left its line by {off * 1e3:.1f} mm")
        self.arrived("straight line")

    def pick(self) -> None:
        from myur5_pick_place import table

        self.now("pick")
        self.arm.set_support_surface_name("table")
        before = table.position(table.model_pose("block"))
        code = self.arm.pick("block", table.grasps(table.model_pose("block")))
        demand(code == 1, f"the block could not be picked (error code {code})")
        lifted = table.position(table.model_pose("block"))
        self.figures["picked"] = f"the simulated block is {lifted[2] - before[2]:.3f} m higher"
        demand(lifted[2] - before[2] > 0.08, "the block was not lifted in the simulator")
        save_picture(self.out / "camera-picked.png", "The simulated world: the block is held", self.pictures)
        save_rviz(self.out / "rviz-picked.png", "RViz: the block is attached", self.pictures)

    def place(self) -> None:
        import numpy as np
        from myur5_pick_place import table

        self.now("place")
        demand(self.arm.place("block", table.places(*PLACE)), "the block could not be placed")
        off = float(np.linalg.norm(table.position(table.model_pose("block"))[:2] - PLACE[:2]))
        self.figures["placed"] = f"the simulated block stands {off * 1e3:.1f} mm off its place"
        demand(off < 0.01, f"the block stands {off * 1e3:.0f} mm off its place")
        self.now("home")
        self.arm.set_named_target("HomePose")
        demand(self.arm.go(wait=True), "the arm did not get home")
        self.arrived("home")
        save_picture(self.out / "camera-placed.png", "The simulated world: the block is on the other side of the post", self.pictures)


def run(options: argparse.Namespace, out: Path, environment: dict, window: bool) -> int:
    import rosgraph
    import rospy
    from launch_gallery.session import running
    from myur5_pick_place import table

    begin = time.monotonic()
    say("roslaunch myur5_pick_place pick_place.launch")
    port = environment["ROS_MASTER_URI"].rsplit(":", 1)[1]
    words = ["roslaunch", "-p", port, "myur5_pick_place", "pick_place.launch", "gui:=false", f"rviz:={str(window).lower()}"]
    with running(words, environment, out / "launch.log") as launch:
        while not (rosgraph.is_master_online() and rosgraph.Master("/demo_motion").hasParam("/use_sim_time")):
            demand(launch.poll() is None and time.monotonic() - begin < 60, "roslaunch did not start")
            time.sleep(0.1)
        rospy.init_node("demo_motion", disable_signals=True, log_level=rospy.ERROR)
        recorder = Recorder()
        while not recorder.rows:
            demand(launch.poll() is None and time.monotonic() - begin < 120, "no joint states came")
            time.sleep(0.1)
        show = Show(out, recorder)
        show.figures["launch command to ready"] = f"{time.monotonic() - begin:.1f} s"
        table.fill_scene(show.scene)
        save_picture(out / "camera-before.png", "The simulated world: UR5, table, post and block", show.pictures)
        show.round_the_post()
        show.straight_line()
        show.pick()
        show.place()
    with open(out / "joints.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["sim_time", *JOINTS])
        writer.writerows([f"{row[0]:.3f}", *(f"{q:.9f}" for q in row[1:])] for row in show.recorder.rows)
    save_plot(out / "joints.png", show.recorder, show.marks)
    save_report(
        out,
        show.figures,
        [(out / "joints.png", "Planned way points on what the joints did"), *show.pictures],
        "The UR5 plans, moves, picks and places",
    )
    for key, value in show.figures.items():
        say(f"{key}: {value}")
    say(f"report: {out / 'report.html'}")
    return 0


if __name__ == "__main__":
    demonstration.main("demo_motion", parse(), run)
