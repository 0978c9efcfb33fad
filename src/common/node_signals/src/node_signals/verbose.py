"""What a node says when it is asked to say more: its own DEBUG lines, and none of rospy's.

rospy writes a traceback of two exceptions whenever a subscriber leaves, and two lines for each service.
"""

import logging
import os


def level(verbose: bool) -> int:
    """For ``rospy.init_node(log_level=...)``: DEBUG if ``verbose``, else INFO."""
    import rospy

    if verbose:
        logging.getLogger("rosout").addFilter(_not_of_rospy)
    return rospy.DEBUG if verbose else rospy.INFO


def _not_of_rospy(record: logging.LogRecord) -> bool:
    import rospy

    return record.levelno > logging.DEBUG or not record.pathname.startswith(os.path.dirname(rospy.__file__) + os.sep)
