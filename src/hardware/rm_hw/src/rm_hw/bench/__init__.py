"""A motor bench without a motor: speed controllers, rotors and loads behind a serial port that speaks SLCAN.

``motor`` is physics alone, ``bus`` joins motors, faults and ports into a CAN bus, ``slcan`` is one serial port,
``app`` runs it all in real time with keys and ROS topics.
"""
