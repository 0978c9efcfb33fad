"""The command ``gzclient``: :mod:`ode_sim_viewer` fed by the node ``/gazebo``.

====================  ======================================================
``main``              from the command line to the page, and to its end
``page``              the page with all its tabs
``command_line``      the options
``ros_simulation``    the simulator by its topics and services
``desktop``           a window of the desktop that shows the page
``panels``            the tabs beside those of ``ode_sim_viewer``: sensors, TF, topics, controllers, the editors
``sensor_drawing``    how messages of sensors are drawn, ``sensor_frames`` where
``markers``           how RViz's markers are drawn; ``tf_frames`` where the frames of TF are
``building``          the building editor without its controls, ``modelling`` the model editor
====================  ======================================================
"""
