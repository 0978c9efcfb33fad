"""What the YAML of the arm's homework cannot say."""


def arm_moved(context, joints, by):
    """At least so many ``joints`` moved ``by`` so much, rad, between the task's first and last moment, as ``context`` has them."""

    def places(sample):
        return {name: state[0] for model in sample.models.values() for name, state in model.get("joints", {}).items()}

    if not context.samples:
        return False, "the program ended before any time had passed"
    first, last = places(context.samples[0]), places(context.samples[-1])
    moved = sorted(name for name in first if abs(last.get(name, first[name]) - first[name]) >= by)
    return len(moved) >= joints, f"{len(moved)} joints moved by {by:g} rad or more: {', '.join(moved) or 'none'}"


def states_are_printed(context):
    """The program of the task's run listens to joint states: it, or the log, shows positions."""
    import rosgraph

    subscribed = dict(rosgraph.Master("/lab_check").getSystemState()[1])
    listeners = [node for node in subscribed.get("/arm/joint_states", []) if "controller" in node]
    return bool(listeners), f"listening to /arm/joint_states: {', '.join(listeners) or 'no node of arm_controller'}"
