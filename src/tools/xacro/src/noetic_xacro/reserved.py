"""Element names that robot descriptions, worlds and xacro itself use: none of them is a macro called without prefix.

Names of SDF that are parts of robots as well (``gripper``, ``battery``, ``lidar``) are not among them: outside of ``<gazebo>``, where no
macro is called without prefix anyhow, a robot's description has no such element.
"""

_URDF = """
    actuator axis box calibration camera capsule child collision color compensator contact_coefficients cylinder dampingFactor
    disableFixedJointLumping dynamics fdir1 flexJoint fudgeFactor gap_joint gazebo gear_ratio geometry group hardwareInterface
    implicitSpringDamper inertia inertial initial_joint_position joint jointBacklash kd kp laserRetro leftActuator limit link map
    mass material maxContacts maxVel mechanicalReduction mesh mimic minDepth motorTorqueConstant mu1 mu2 offset origin parent
    passive_joint preserveFixedJoint provideFeedback pulsesPerRevolution ray rightActuator robot role rollJoint rosparam
    safety_controller screw_reduction selfCollide sensor simulated_actuated_joint simulated_reduction sphere springReference
    springStiffness state static_map stopCfm stopErp stopKd stopKp texture thread_pitch transmission turnGravityOff type
    use_simulated_gripper_joint verbose visual
"""
_SRDF = """
    chain disable_collisions disable_default_collisions enable_collisions enable_default_collisions end_effector group_state
    joint_property link_sphere_approximation property subgroup virtual_joint
"""
_XACRO_AND_LAUNCH = """
    arg attribute call element env if include insert_block launch macro node param remap unless
"""
_SDF = """
    accel acceleration accuracy actor air_pressure albedo_map allow_auto_disable altimeter always_on ambient ambient_occlusion_map
    angle angular angular_velocity animation aspect_ratio atmosphere attach_steps attenuation audio audio_sink audio_source
    auto_start axis2 background bias_mean bias_stddev blend bone_attachment bounce bullet c1 c2 c3 cast_shadows category_bitmask
    center cfm cfm_damping clip clouds coefficient collide_bitmask collide_without_contact collide_without_contact_bitmask
    collision_detector color_end color_range_image color_start cols constant constraints contact contact_max_correcting_vel
    contact_surface_layer custom_function custom_rpy cutoff_angle cx cy damping dart delay_start deletions density depth_camera
    detach_steps device diffuse direction dissipation distortion distribution double_sided duration dynamic_bias_correlation_time
    dynamic_bias_stddev dynamic_friction effort elastic_modulus elevation ellipsoid emissive emissive_map emitting empty
    enable_metrics enable_orientation enable_wind env_texture_size environment_map erp essid f fade_dist falloff far far_clip
    filename flesh_mass_fraction fog force force_torque format fov frame frequency friction friction2 friction_model fudge_factor
    fun fx fy gain gearbox_ratio gearbox_reference_body glossiness glossiness_map gps granularity grasp_check grav_dir_x gravity
    grid gripper_link gui heading_deg height heightmap horizontal horizontal_fov humidity image implicit_spring_damper imu
    inherit_yaw initial_position inner_angle insertions interpolate_x intrinsics island_threads iterations iters ixx ixy ixz iyy iyz
    izz k1 k2 k3 kinematic laser_retro latitude_deg layer length lens lifetime light light_map lighting linear linear_acceleration
    linear_velocity localization logical_camera longitude_deg lower magnetic_field magnetometer max max_angle max_contacts max_dist
    max_force max_frequency max_step_size max_transient_velocity max_vel max_velocity mean mean_size measure_direction meta metal
    metalness metalness_map min min_angle min_contact_count min_depth min_dist min_frequency min_height min_step_size min_velocity
    model model_count mu must_be_base_link must_be_loop_joint name near near_clip noise normal normal_map ode
    orientation_reference_frame origin_visual outer_angle output override_impact_capture_velocity
    override_stiction_transition_velocity p1 p2 palm_link particle_emitter particle_scatter_ratio particle_size patch_radius path
    pbr physics pitch plane plastic_coef_restitution plastic_impact_velocity plugin point poissons_ratio polyline population pos
    pose position_sensing precision precon_iters pressure projection_type projector provide_feedback quadratic radius range rate
    real_time real_time_factor real_time_update_rate reference_altitude render_order resolution restitution_coefficient rfid rfidtag
    road rolling_friction roughness roughness_map rows s samples sampling save scale scale_rate scale_to_hfov scan scene script sdf
    self_collide sensitivity shader shadows sim_time simbody size sky slip slip1 slip2 soft_cfm soft_contact soft_erp solver
    solver_type sonar sor specular specular_map speed spherical_coordinates split_impulse split_impulse_penetration_threshold
    spring_reference spring_stiffness static static_friction stddev step stiffness submesh sunrise sunset surface surface_model
    surface_radius suspension temperature temperature_gradient thread_position_correction threshold time topic torque torsional
    track_visual trajectory transceiver transparency update_rate upper uri use_dynamic_moi_rescaling use_model_frame
    use_parent_model_frame use_patch_radius use_terrain_paging velocity velocity_decay velocity_sensing vertical vertical_position
    vertical_velocity view_controller viscous_friction visibility_flags visibility_mask visualize voltage wall_time waypoint width
    wind wireless_receiver wireless_transmitter world world_frame_orientation wrench x xyz y z
"""
RESERVED = frozenset((_URDF + _SRDF + _XACRO_AND_LAUNCH + _SDF).split())
