#error "Planning request adapters in C++ do not exist here: write one in Python, as moveit_ros_planning/planning_pipeline.py takes them (docs/differences.md, 'MoveIt in C++')"
