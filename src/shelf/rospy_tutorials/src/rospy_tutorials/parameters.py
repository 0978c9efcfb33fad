"""The node param_talker: parameters read in each of the namespaces, set, looked for and deleted, then said over and over."""

import node_signals
import rospy
from std_msgs.msg import String

from .talking import over_and_over


def talk() -> None:
    """Speaks ``utterance`` of its group on the topic that its parameter ``topic_name`` names, once a second."""
    node_signals.init_node("param_talker")
    rospy.loginfo("%s is %s", rospy.resolve_name("/global_example"), rospy.get_param("/global_example"))
    utterance = rospy.get_param("utterance")
    rospy.loginfo("%s is %s", rospy.resolve_name("utterance"), utterance)
    topic = rospy.get_param("~topic_name")
    rospy.loginfo("%s is %s", rospy.resolve_name("~topic_name"), topic)
    rospy.loginfo("default_param is %s", rospy.get_param("default_param", "default_value"))
    gains = rospy.get_param("gains")
    rospy.loginfo("gains are %s, %s, %s", gains["P"], gains["I"], gains["D"])
    rospy.set_param("list_of_floats", [1.0, 2.0, 3.0, 4.0])
    rospy.set_param("bool_True", True)
    rospy.set_param("~private_bar", 1 + 2)
    rospy.set_param("to_delete", "baz")
    rospy.delete_param("to_delete")
    rospy.loginfo("found global_example as %s", rospy.search_param("global_example"))
    publisher = rospy.Publisher(topic, String, queue_size=10)

    def say() -> None:
        publisher.publish(utterance)
        rospy.loginfo(utterance)

    over_and_over(say, period=1.0)
