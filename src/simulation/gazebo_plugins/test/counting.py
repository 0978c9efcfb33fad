#!/usr/bin/env python3
"""counting.py SECONDS TOPIC...: a subscriber without a bound that takes so long for each message; for each line on standard input it
prints how many messages of each topic it has had, as JSON."""

import json
import sys
import time

import rospy


def main():
    took, topics = float(sys.argv[1]), sys.argv[2:]
    counts = dict.fromkeys(topics, 0)

    def count(_, topic):
        counts[topic] += 1
        time.sleep(took)

    rospy.init_node("counting", anonymous=True, disable_rostime=True, disable_signals=True)
    for topic in topics:
        rospy.Subscriber(topic, rospy.AnyMsg, count, topic, queue_size=None, buff_size=1 << 24)
    for _ in sys.stdin:
        print(json.dumps(counts), flush=True)


if __name__ == "__main__":
    main()
