"""SDF of small models for plugins_rostest.py. Lengths m, masses kg."""


def sdf(*parts, static=False):
    return f'<sdf version="1.6"><model name="any"><static>{str(static).lower()}</static>{"".join(parts)}</model></sdf>'


def plugin(library, **tags):
    return f'<plugin name="{library}" filename="lib{library}.so">{elements(**tags)}</plugin>'


def elements(**tags):
    return "".join(f"<{tag}>{value}</{tag}>" for tag, value in tags.items())


def link(name, at=(0, 0, 0), mass=1.0, inertia=0.01, shape="", extra="", gravity=True, mu=1.0):
    """:param shape: ``<box>...``, '' = no collision"""
    collision = (
        f"""<collision name="c"><geometry>{shape}</geometry>
        <surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface></collision>"""
        if shape
        else ""
    )
    return f"""<link name="{name}"><pose>{at[0]} {at[1]} {at[2]} 0 0 0</pose><gravity>{int(gravity)}</gravity>
        <inertial><mass>{mass}</mass><inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy><izz>{inertia}</izz></inertia></inertial>
        {collision}{extra}</link>"""


def box(x, y, z):
    return f"<box><size>{x} {y} {z}</size></box>"


def joint(name, kind, parent, child, xyz=(0, 0, 1), lower=-1e16, upper=1e16, extra=""):
    axis = (
        ""
        if kind == "fixed"
        else f"""<axis><xyz>{xyz[0]} {xyz[1]} {xyz[2]}</xyz>
        <limit><lower>{lower}</lower><upper>{upper}</upper></limit></axis>"""
    )
    return f'<joint name="{name}" type="{kind}"><parent>{parent}</parent><child>{child}</child>{axis}{extra}</joint>'


def wheel(name, at, radius=0.1, mass=0.5, mu=1.0):
    """Turns about y."""
    return f"""<link name="{name}"><pose>{at[0]} {at[1]} {at[2]} 0 0 0</pose>
        <inertial><mass>{mass}</mass><inertia><ixx>0.002</ixx><iyy>0.003</iyy><izz>0.002</izz></inertia></inertial>
        <collision name="c"><pose>0 0 0 1.5707963267948966 0 0</pose>
        <geometry><cylinder><radius>{radius}</radius><length>0.04</length></cylinder></geometry>
        <surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface></collision></link>"""


def ray(
    name,
    plugins,
    samples=360,
    low=-3.141592653589793,
    high=3.124139361069850,
    near=0.1,
    far=3.2,
    noise=0.0,
    resolution=1,
    vertical="",
    rate=10,
    at="0 0 0.5 0 0 0",
    kind="ray",
):
    noise = f"<noise><type>gaussian</type><mean>0</mean><stddev>{noise}</stddev></noise>" if noise else ""
    return f"""<sensor name="{name}" type="{kind}"><pose>{at}</pose><update_rate>{rate}</update_rate><ray><scan><horizontal>
        <samples>{samples}</samples><resolution>{resolution}</resolution><min_angle>{low}</min_angle>
        <max_angle>{high}</max_angle></horizontal>{vertical}</scan>
        <range><min>{near}</min><max>{far}</max></range>{noise}</ray>{plugins}</sensor>"""
