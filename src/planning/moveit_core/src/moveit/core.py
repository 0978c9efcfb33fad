"""Not supplied; importing it, or a module of it, says what takes its place."""

raise ModuleNotFoundError(
    "moveit.core (Noetic's compiled bindings of moveit_core) is not supplied: `import motion` has robots, states, planning scenes, "
    "collision checks and constraints in Python (motion.load_model, motion.PlanningScene), `import moveit_commander` asks move_group",
    name=__name__,
)
