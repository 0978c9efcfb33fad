"""Controllers without a robot: see :mod:`moveit_fake_controller_manager.manager`."""
