#error \
    "joints, surfaces and meshes of Gazebo over ODE are not here, rays are (ODERayShape.hh): a plugin that derives from this class cannot be built; gazebo/physics/*.hh has what it can ask"
