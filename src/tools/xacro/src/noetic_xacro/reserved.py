"""Element names of URDF and SDF (and of old xacro itself): no macro calls even if a macro has the same name."""

RESERVED = frozenset(
    """
    robot link joint material transmission gazebo sensor plugin arg param property macro include insert_block if unless
    inertial visual collision origin geometry mass inertia box cylinder sphere mesh color texture parent child axis
    limit dynamics mimic safety_controller calibration actuator type hardwareInterface mechanicalReduction role offset
    verbose contact_coefficients group state rosparam node sdf world model pose static physics light scene gui state
    population actor road frame wind atmosphere audio ambient diffuse specular emissive lighting script uri name
    transparency cast_shadows laser_retro surface friction contact bounce ode bullet torsional kp kd mu mu1 mu2 fdir1
    slip1 slip2 max_vel min_depth max_contacts self_collide gravity kinematic velocity_decay linear angular size radius
    length scale submesh center normal plane heightmap image polyline point height capsule ellipsoid empty always_on
    update_rate visualize topic camera ray imu gps sonar altimeter magnetometer rfid rfidtag transceiver force_torque
    logical_camera wireless_receiver wireless_transmitter horizontal_fov width format clip near far noise mean stddev
    save path depth_camera output distortion lens scan horizontal vertical samples resolution min_angle max_angle range
    min max angular_velocity linear_acceleration x y z xyz lower upper effort velocity stiffness dissipation damping
    spring_reference spring_stiffness provide_feedback cfm_damping implicit_spring_damper fudge_factor erp cfm
    suspension projector fov sky shadows background grid
""".split()
)
