"""Test double of a robot: ``robot`` (the joints) and ``node`` (clock, controller manager and control loop around it).

Parameters of the node ``test_robot`` (private)::

    rate: 100.0            # control loop, Hz of simulated time
    speed: 1.0             # simulated seconds per second while no test waits (see node.TestRobotNode)
    joints:
      elbow: {interfaces: [position], initial: 0.0}   # of position, velocity, effort, pos_vel, pos_vel_acc
    imus: {imu: {frame_id: imu_link, orientation: [0, 0, 0, 1]}}                # fields of ImuSensorHandle
    force_torque_sensors: {wrist: {frame_id: wrist_link, force: [1, 2, 3]}}     # fields of ForceTorqueSensorHandle
    faults:                # read at the start, and again when the service ~apply_faults (std_srvs/Empty) is called
      elbow: {delay: 1, smoothing: 0.9, upper_bound: 0.5, wrap: true, nan: true}   # see robot.Faults

A position joint goes where it is told at once, a velocity joint moves as told, an effort joint is a mass of 1 kg
(kg m^2) pushed by at most 10 N (Nm). A joint with several interfaces obeys the one that a controller claimed last.
"""
