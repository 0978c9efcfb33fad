"""Small robots whose collisions are known by hand."""


def link(name: str, size: str = "0.2 0.2 0.2", at: str = "0 0 0") -> str:
    """A link with a box, metres; no geometry if ``size`` is empty."""
    shape = f'<collision><origin xyz="{at}"/><geometry><box size="{size}"/></geometry></collision>' if size else ""
    return f'<link name="{name}">{shape}</link>'


def joint(
    name: str, parent: str, child: str, at: str = "0 0 0", kind: str = "revolute", axis: str = "0 0 1", limits: str = 'lower="-1" upper="1"'
) -> str:
    """A joint; limits in rad or m."""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{at}"/>'
        f'<axis xyz="{axis}"/><limit {limits} velocity="2" effort="5"/></joint>'
    )


def robot(*parts: str) -> str:
    """A URDF."""
    return f'<robot name="small">{"".join(parts)}</robot>'


# base - a bare link - column: the two boxes are adjacent although a link without geometry is between them. The column's
# child "inside" sits in the base for ever (its joint only turns it about its own axis); "far" is two metres away and never
# touches anything but "swing", a long bar near it, which also hits the column when it points that way.
FIVE = robot(
    link("base", "0.4 0.4 0.4"),
    link("bare", ""),
    link("column"),
    link("inside", "0.1 0.1 0.1"),
    link("far"),
    link("swing", "1.9 0.05 0.05", "0.95 0 0"),
    joint("fixed_bare", "base", "bare", kind="fixed"),
    joint("turn", "bare", "column", "0 0 0.5"),
    joint("spin", "column", "inside", "0 0 -0.5"),
    joint("away", "column", "far", "2 0 0", kind="fixed"),
    joint("wave", "far", "stand", "0 0.45 0", kind="fixed"),
    link("stand", ""),
    joint("swinging", "stand", "swing", "-0.3 0 0", limits='lower="-3" upper="3"'),
)
