#error "there is no window of Gazebo here, and no camera of it: gzclient is a page in a browser"
