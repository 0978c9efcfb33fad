"""``rosrun rosauth ros_mac_authentication _secret_file_location:=FILE``"""

from __future__ import annotations

import hashlib
import hmac

import node_signals
import rospy

from rosauth.srv import Authentication, AuthenticationRequest

LENGTH = 16  # characters of a secret
#: exit codes
NO_PARAMETER, NO_FILE, NO_SECRET = 255, 254, 253


def code(secret: str, request: AuthenticationRequest) -> str:
    """The message authentication code that ``request`` should have, by ``secret``, the text that both sides know."""
    text = f"{secret}{request.client}{request.dest}{request.rand}{request.t.secs}{request.level}{request.end.secs}"
    return hashlib.sha512(text.encode("utf-8")).hexdigest()


def good(secret: str, request: AuthenticationRequest, now: rospy.Time, delta: float) -> bool:
    """Whether ``request`` knows ``secret`` and is of this time.

    :param delta: s, how far the request's time may be from ``now``; negative: times do not count
    """
    in_time = delta < 0 or (abs(int((request.t - now).to_sec())) < delta and request.end > now)
    return in_time and hmac.compare_digest(code(secret, request).encode(), request.mac.encode("utf-8"))


def main() -> int:
    node_signals.init_node("ros_mac_authentication")
    file = rospy.get_param("~secret_file_location", None)
    delta = rospy.get_param("~allowed_time_delta", 5)
    if not isinstance(file, str) or not isinstance(delta, (int, float)):
        rospy.logfatal("~secret_file_location should name the file with the secret, ~allowed_time_delta be a number of seconds")
        return NO_PARAMETER
    try:
        with open(file, encoding="utf-8") as stream:
            secret = stream.readline().rstrip("\n")
    except (OSError, UnicodeDecodeError) as error:
        rospy.logfatal("~secret_file_location: %s cannot be read: %s", file, getattr(error, "strerror", None) or "it is no text")
        return NO_FILE
    if len(secret) != LENGTH:
        rospy.logfatal("~secret_file_location: the first line of %s has %d characters, and a secret has %d", file, len(secret), LENGTH)
        return NO_SECRET
    rospy.Service("authenticate", Authentication, lambda request: good(secret, request, rospy.Time.now(), delta))
    rospy.loginfo("ROS Authentication Server Started")
    node_signals.spin()
    return 0
