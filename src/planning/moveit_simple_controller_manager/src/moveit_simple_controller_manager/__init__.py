"""Controllers behind actions: see :mod:`moveit_simple_controller_manager.manager`."""
