"""Messages to points, points to what is kept and drawn."""

import genpy
import numpy as np
import pytest
import rosbag
from geometry_msgs.msg import PointStamped
from rqt_multiplot.config import Curve, CurveAxes, CurveAxis, Data, DataType, FieldType
from rqt_multiplot.points import MOST_POINTS, Points
from rqt_multiplot.sampling import Sampler
from rqt_multiplot.sources import BagError, read_bag
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Header, String


def axis(topic, field="", receipt=False):
    return CurveAxis(topic=topic, field=field, field_type=FieldType.RECEIPT_TIME if receipt else FieldType.DATA)


def sampler(x, y):
    return Sampler(Curve(title="c", axes=CurveAxes(x, y)))


def test_one_topic_gives_a_point_per_message():
    curve = sampler(axis("/j", "header/stamp"), axis("/j", "position/1"))
    for i in range(3):
        curve.add("/j", JointState(header=Header(stamp=genpy.Time(i, 500_000_000)), position=[0.0, 10.0 * i]), 99.0)
    assert curve.take() == [(0.5, 0.0), (1.5, 10.0), (2.5, 20.0)] and curve.take() == []
    assert curve.is_time("x_axis") and not curve.is_time("y_axis")


def test_time_of_receipt():
    curve = sampler(axis("/f", receipt=True), axis("/f", "data"))
    assert curve.is_time("x_axis")
    curve.add("/f", Float64(3.0), 12.25)
    assert curve.take() == [(12.25, 3.0)]


def test_two_topics_are_interpolated_at_each_others_times():
    curve = sampler(axis("/a", "data"), axis("/b", "data"))
    for t in range(5):
        curve.add("/a", Float64(10.0 * t), float(t))
        curve.add("/b", Float64(100.0 * t), t + 0.5)
    points = curve.take()
    assert len(points) >= 4
    for x, y in points:  # a = 10 t, b = 100 (t - 0.5)
        assert y == pytest.approx(10 * x - 50)


def test_two_topics_meet_by_their_stamps():
    curve = sampler(axis("/a", "point/x"), axis("/b", "point/y"))
    for t in range(1, 5):
        curve.add("/a", PointStamped(header=Header(stamp=genpy.Time(t)), point=genpy_point(x=float(t))), 50.0 + t)
    for t in range(1, 5):
        curve.add("/b", PointStamped(header=Header(stamp=genpy.Time(t)), point=genpy_point(y=float(-t))), 90.0 + t)
    points = curve.take()
    assert len(points) >= 3 and all(y == -x for x, y in points)


def genpy_point(**fields):
    from geometry_msgs.msg import Point

    return Point(**fields)


def test_a_clock_that_is_set_back_begins_anew():
    curve = sampler(axis("/a", "data"), axis("/b", "data"))
    for begin in (100.0, 0.0):
        for t in range(4):
            curve.add("/a", Float64(t), begin + t)
            curve.add("/b", Float64(t), begin + t)
    assert len(curve.take()) >= 6
    points = Points(Data())
    points.append([(100.0, 1.0), (101.0, 2.0)], True)
    points.append([(102.0, 3.0), (0.0, 4.0), (1.0, 5.0)], True)
    assert points.x.tolist() == [0.0, 1.0] and points.ascending


@pytest.mark.parametrize(
    "field, message, said",
    [
        ("position/5", JointState(position=[1.0]), "holds no such number"),
        ("position", JointState(), "give an index"),
        ("speed", JointState(), "no field speed in sensor_msgs/JointState; it has header"),
        ("data", String("x"), "is no number but string"),
    ],
)
def test_what_is_no_number_is_told(field, message, said):
    curve = sampler(axis("/t", receipt=True), axis("/t", field))
    curve.add("/t", message, 1.0)
    assert curve.take() == [] and said in curve.problem


def test_an_unfinished_curve_wants_no_topic():
    assert sampler(axis("/t", receipt=True), axis("/t")).topics == set()


@pytest.mark.parametrize(
    "kind, capacity, kept",
    [(DataType.VECTOR, 5, 50), (DataType.LIST, 5, 50), (DataType.CIRCULAR_BUFFER, 5, 5), (DataType.TIME_FRAME, 5, 11)],
)
def test_what_is_kept(kind, capacity, kept):
    points = Points(Data(kind, capacity, 10.0))
    for i in range(50):
        points.append([(float(i), 0.0)], True)
    assert len(points) == kept and points.x[-1] == 49


def test_memory_is_bounded():
    points = Points(Data())
    block = np.zeros((200_000, 2))
    for _ in range(8):
        points.append(block, False)
    assert len(points) == MOST_POINTS and points._data.size <= 2 * (1.25 * MOST_POINTS + 200_000)


def test_a_path_that_turns_is_drawn_whole():
    angle = np.linspace(0, 200 * np.pi, 100_000)
    points = Points(Data())
    points.append(np.column_stack((np.cos(angle), np.sin(angle))), False)
    x, y = points.picture((-1, 1), (-1, 1), 400, 400)
    assert not points.ascending and 1000 < len(x) < 100_000
    assert np.abs(np.hypot(x, y) - 1).max() < 1e-9 and x.min() < -0.999 and y.max() > 0.999


def test_nearest_point():
    points = Points(Data())
    assert points.nearest(1.0) is None
    points.append([(0, 5), (1, 6), (2, 7)], False)
    assert [points.nearest(x) for x in (-9, 0.4, 0.6, 9)] == [(0, 5), (0, 5), (1, 6), (2, 7)]


@pytest.fixture
def bag(tmp_path):
    name = str(tmp_path / "a.bag")
    with rosbag.Bag(name, "w") as bag:
        for i in range(1000):
            bag.write("/f", Float64(i), genpy.Time(100 + i * 0.01))
            bag.write("/other", String("x"), genpy.Time(100 + i * 0.01))
    return name


def test_a_bag_feeds_curves(bag):
    curve, absent = sampler(axis("/f", receipt=True), axis("/f", "data")), sampler(axis("/g", receipt=True), axis("/g", "data"))
    shares = []
    count, missing = read_bag(bag, [curve, absent], lambda share: not shares.append(share))
    points = curve.take()
    assert (count, missing) == (1000, ["/g"]) and len(points) == 1000 and points[500] == (105.0, 500.0) and len(shares) == 2


def test_bags_that_give_nothing_are_told(bag, tmp_path):
    curve = sampler(axis("/g", receipt=True), axis("/g", "data"))
    (tmp_path / "no.bag").write_bytes(b"rubbish")
    (tmp_path / "cut.bag").write_bytes(open(bag, "rb").read()[:30_000])
    for name, said in (
        (bag, "has none of /g; it has /f, /other"),
        (tmp_path / "no.bag", "cannot be read"),
        (tmp_path / "cut.bag", "rosbag reindex"),
        (tmp_path / "absent.bag", "No such file"),
    ):
        with pytest.raises(BagError, match=said) as error:
            read_bag(str(name), [curve])
        assert "\n" not in str(error.value)
    with pytest.raises(BagError, match="no curve has a topic and fields"):
        read_bag(bag, [])


def test_reading_a_bag_can_be_stopped(bag):
    curve = sampler(axis("/f", receipt=True), axis("/f", "data"))
    assert read_bag(bag, [curve], lambda share: False)[0] == 500
