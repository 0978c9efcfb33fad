"""Several bag files as one, without a window."""

import genpy
import pytest
import rosbag
from rqt_bag import bag_helper
from rqt_bag.bags import BagError, Bags, copy_region, open_bag
from rqt_bag.timeline_cache import TimelineCache
from std_msgs.msg import Float64, String


def write(path, topic, stamps, message=Float64):
    with rosbag.Bag(str(path), "w") as bag:
        for stamp in stamps:
            bag.write(topic, message(stamp) if message is Float64 else message(str(stamp)), genpy.Time.from_sec(stamp))
    return str(path)


@pytest.fixture
def bags(tmp_path):
    bags = Bags()
    bags.add(open_bag(write(tmp_path / "a.bag", "/f", [100.0, 101.0, 104.0])))
    bags.add(open_bag(write(tmp_path / "b.bag", "/f", [102.0, 103.0])))
    bags.add(open_bag(write(tmp_path / "c.bag", "/s", [101.5], String)))
    yield bags
    bags.close()


def t(seconds):
    return genpy.Time.from_sec(seconds)


def test_bags_merge(bags):
    assert bags.topics == ["/f", "/s"] and bags.datatype("/s") == "std_msgs/String" and bags.datatype("/x") is None
    assert bags.stamps("/f").tolist() == [100, 101, 102, 103, 104] and bags.span() == (t(100), t(104))
    assert [entry.time.to_sec() for _, entry in bags.entries(None, t(101), t(103))] == [101, 101.5, 102, 103]
    assert [bags.read(bag, entry.position)[1].data for bag, entry in bags.entries("/f", t(0), t(999))] == [100, 101, 102, 103, 104]


def test_neighbours(bags):
    assert bags.entry(t(102.5), "/f")[1].time == t(102) and bags.entry(t(99), "/f") == (None, None)
    assert bags.entry(t(101.7))[1].time == t(101.5) and bags.entry_after(t(101))[1].time == t(101.5)
    assert bags.entry_after(t(101), "/f")[1].time == t(102) and bags.entry_after(t(104)) == (None, None)


def test_region_is_copied(bags, tmp_path):
    shares = []
    assert copy_region(bags, str(tmp_path / "part.bag"), t(101), t(103), lambda share: not shares.append(share)) == 4
    with rosbag.Bag(str(tmp_path / "part.bag")) as part:
        assert [(topic, message.data) for topic, message, _ in part.read_messages()] == [
            ("/f", 101.0),
            ("/s", "101.5"),
            ("/f", 102.0),
            ("/f", 103.0),
        ]
    with pytest.raises(BagError, match="absent/x.bag cannot be written: No such file"):
        copy_region(bags, str(tmp_path / "absent/x.bag"), t(101), t(103))


@pytest.mark.parametrize(
    "content, said",
    ids=["empty", "text", "head", "bytes", "absent", "cut"],
    argvalues=[
        (b"", "cannot be read|is no bag|has no index"),
        (b"hello", "cannot be read|is no bag|has no index"),
        (b"#ROSBAG V2.0\n", "has no index|is no bag"),
        (b"#ROSBAG V2.0\n" + b"\xff" * 200, "has no index|is no bag"),
        (None, "No such file"),
        ("cut", "rosbag reindex"),
    ],
)
def test_files_that_are_no_bags(tmp_path, content, said):
    path = tmp_path / "x.bag"
    if content == "cut":
        content = open(write(tmp_path / "whole.bag", "/f", [float(i) for i in range(1, 500)]), "rb").read()[:9000]
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(BagError, match=said) as error:
        open_bag(str(path))
    assert "\n" not in str(error.value) and str(path) in str(error.value)


def test_damaged_message_is_told(bags, tmp_path):
    name = write(tmp_path / "d.bag", "/d", [1.0, 2.0], String)
    data = bytearray(open(name, "rb").read())
    at = data.index(b"op=\x02")  # kind of the record: a message
    data[at + 3] = 0x0B
    open(name, "wb").write(data)
    bags.add(open_bag(name))
    bag, entry = bags.entry(t(1.0), "/d")
    with pytest.raises(BagError, match="a message cannot be read"):
        bags.read(bag, entry.position)


def test_helper(tmp_path):
    with rosbag.Bag(write(tmp_path / "a.bag", "/f", [100.0, 101.0])) as bag:
        assert bag_helper.get_topics(bag) == ["/f"] and bag_helper.get_datatype(bag, "/f") == "std_msgs/Float64"
        assert bag_helper.get_start_stamp(bag) == t(100) and bag_helper.get_end_stamp(bag) == t(101)
        assert bag_helper.get_topics_by_datatype(bag) == {"std_msgs/Float64": ["/f"]}
    assert [bag_helper.filesize_to_str(size) for size in (5, 2048, 5 << 20)] == ["5 B", "2.0 KB", "5.0 MB"]


def test_cache_keeps_what_is_used():
    cache = TimelineCache(lambda topic, stamp, details: (t(stamp), f"item {stamp}"), max_cache_size=3)
    for stamp in (1.0, 2.0, 3.0):
        cache.cache_item("/f", t(stamp), stamp)
    assert cache.get_item("/f", 1.2, 0.5) == 1.0 and cache.get_item("/f", 1.6, 0.5) == 2.0 and cache.get_item("/f", 9.0, 0.5) is None
    cache.get_item("/f", 1.0, 0.1)
    cache.cache_item("/f", t(4.0), 4.0)
    assert cache.get_item("/f", 3.0, 0.1) is None and cache.get_item("/f", 1.0, 0.1) == 1.0
    cache.stop()
    cache.join(10)
    assert not cache.is_alive()


def test_an_mcap_file_is_opened_as_a_bag(tmp_path):
    from bag_tools.convert import convert

    name = write(tmp_path / "a.bag", "/f", [100.0, 101.0, 104.0])
    convert(tmp_path / "a.bag", tmp_path / "a.mcap")
    bags, same = Bags(), Bags()
    bags.add(open_bag(str(tmp_path / "a.mcap")))
    same.add(open_bag(str(name)))
    both = [[opened.read(bag, entry.position) for bag, entry in opened.entries("/f", t(0), t(999))] for opened in (bags, same)]
    assert both[0] == both[1] and [message.data for _, message, _ in both[0]] == [100.0, 101.0, 104.0]
    (tmp_path / "cut.mcap").write_bytes((tmp_path / "a.mcap").read_bytes()[:200])
    with pytest.raises(BagError, match="cut.mcap is no MCAP file, or cut off"):
        open_bag(str(tmp_path / "cut.mcap"))
