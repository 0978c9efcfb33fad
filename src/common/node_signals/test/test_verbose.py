import logging
import os

import pytest
import rosgraph.roslogging
import rospy
from node_signals import verbose
from rospy.impl import rosout


@pytest.fixture
def said():
    """What the node's logger hands on, as a terminal or the log file would get it."""
    logger = logging.getLogger("rosout")
    assert isinstance(logger, rosgraph.roslogging.RospyLogger)
    lines = []

    class Reader(logging.Handler):
        def emit(self, record):
            lines.append(record.getMessage())

    reader, before = Reader(), (logger.level, list(logger.filters))
    logger.addHandler(reader)
    yield lines
    logger.removeHandler(reader)
    logger.setLevel(before[0])
    logger.filters[:] = before[1]


def by_rospy(code):
    exec(compile(code, os.path.join(os.path.dirname(rospy.__file__), "topics.py"), "exec"), {"rospy": rospy})


@pytest.mark.parametrize("asked, heard", [(True, ["ours", "warning of rospy"]), (False, ["warning of rospy"])])
def test_a_verbose_node_leaves_out_what_rospy_says_of_its_connections(said, asked, heard):
    chosen = verbose.level(asked)
    assert chosen == (rospy.DEBUG if asked else rospy.INFO)
    logging.getLogger("rosout").setLevel(rosout._rospy_to_logging_levels[chosen])
    rospy.logdebug("ours")
    by_rospy("rospy.logdebug('publisher connection terminated')")
    by_rospy("rospy.logwarn('warning of rospy')")
    assert said == heard
