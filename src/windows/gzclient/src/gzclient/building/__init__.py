"""The building editor: plans for ``build_world``, drawn by hand.

``plan``      what a hand does to a plan: no window, no ROS
``files``     where plans are kept, and models of them
``drawing``   the plan in the page
"""
