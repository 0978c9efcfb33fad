"""A main window that holds plugins: docks, menus, perspectives, settings. No ROS in here; rqt_gui is its ROS face."""
