#error "there is no rendering of Gazebo here: a plugin that draws or reads cameras cannot be built"
