"""What the master and the nodes are asked. Every call may take its time."""

import rosgraph
import rospy
import rosservice
from roscpp.srv import GetLoggers, SetLoggerLevel

LEVELS = ("Debug", "Info", "Warn", "Error", "Fatal")


class LoggerLevelServiceCaller:
    """Stateless."""

    def get_levels(self) -> list[str]:
        return list(LEVELS)

    def get_node_names(self) -> list[str]:
        """All nodes with a service set_logger_level.

        :raises OSError, rosgraph.MasterException, rosservice.ROSServiceIOException: the master does not answer
        """
        ending = "/set_logger_level"
        return sorted(name[: -len(ending)] for name in rosservice.get_service_list() if name.endswith(ending))

    def get_loggers(self, node: str) -> dict[str, str]:
        """Logger to level; :raises rospy.ServiceException: the node is gone"""
        answer = rospy.ServiceProxy(node + "/get_loggers", GetLoggers)()
        return {logger.name: logger.level.capitalize() for logger in sorted(answer.loggers, key=lambda logger: logger.name)}

    def set_logger_level(self, node: str, logger: str, level: str) -> None:
        """Let ``logger`` of ``node`` log from ``level`` on, one of LEVELS.

        :raises rospy.ServiceException: the node is gone, or refuses
        """
        rospy.ServiceProxy(node + "/set_logger_level", SetLoggerLevel)(logger, level)


ERRORS = (OSError, rosgraph.MasterException, rosservice.ROSServiceIOException, rospy.ServiceException)
