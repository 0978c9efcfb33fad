"""Ctrl-C for rospy nodes that never hangs.

rospy runs the whole shutdown inside its signal handler, on top of whatever the main thread was doing. If that was an
XML-RPC call to the master - every ``rospy.loginfo`` makes one - the handler waits for a lock that the interrupted call
holds, for ever. Here the handler only starts a thread, which shuts down while the main thread finishes its call.
"""
import signal
import threading

import rospy


def init_node(name: str, **options) -> None:
    """``rospy.init_node`` with SIGINT and SIGTERM handled as said above. Call it in the main thread.

    Shutdown hooks run in a thread of their own; the process ends when they are done and the main thread has returned,
    which it does when it watches ``rospy.is_shutdown()`` or waits in ``rospy.spin()``.
    """
    rospy.init_node(name, disable_signals=True, **options)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _shut_down)


def _shut_down(number, _frame) -> None:
    threading.Thread(target=rospy.signal_shutdown, args=(f"signal-{number}",), name="shutdown").start()
