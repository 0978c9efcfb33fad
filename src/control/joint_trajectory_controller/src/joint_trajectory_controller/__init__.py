"""Joint trajectory controllers.

``segment`` (one polynomial of one joint) <- ``splice`` (messages to segments, joined to the running motion)
<- ``controller`` (topic, action, supervision) <- ``variants`` (what is written to the hardware). ``segment``,
``tolerances`` and ``splice`` know no ROS: they take any object with the fields of the message.
"""
