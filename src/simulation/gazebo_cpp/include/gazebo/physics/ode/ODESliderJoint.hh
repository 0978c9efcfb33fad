#error \
    "the classes of Gazebo over ODE are not here: a plugin that derives from them or calls ODE itself cannot be built; gazebo/physics/*.hh has what it can ask"
