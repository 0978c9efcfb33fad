#error "there is no window of Gazebo here: a GUI plugin cannot be built"
