"""The command ``gzclient``: :mod:`ode_sim.viewer` fed by the node ``/gazebo``.

====================  ======================================================
``main``              from the command line to the page, and to its end
``command_line``      the options
``ros_simulation``    the simulator by its topics and services
``desktop``           a window of the desktop that shows the page
``panels``            the tabs that speak ROS: topics, controllers
====================  ======================================================
"""
