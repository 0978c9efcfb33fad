"""Models of a town: trees, posts, cars and buildings, which are static, and a tote, a pallet and a truss, which are not.

Their extents are those of the Gazebo model database, so that worlds that place them side by side look as they were meant to; what they
are composed of is our own. Cars stand along x with the front at +x, ambulances, buses and fire trucks along y with the front at -y.
"""

from pieces import Model, Shape, box, colour
from town_shapes import (
    BLUE,
    BRICK,
    CREAM,
    GREY,
    LEAVES,
    RED,
    WHITE,
    YELLOW,
    block,
    cafe,
    car,
    coach,
    fast_food,
    fire_station,
    flat,
    fountain,
    gas_station,
    hatchback,
    house,
    lamp,
    maze_wall,
    number,
    oak,
    pallet,
    pickup,
    pine,
    speed_limit,
    stop_light,
    stop_light_post,
    telephone_pole,
    tote,
    tower,
    truss,
    water_tower,
)


def static(title: str, description: str, shapes: tuple[Shape, ...], name: str = "", **more) -> Model:
    return Model(title, description, shapes, static=True, name=name, **more)


TOWN: dict[str, Model] = {
    "pine_tree": static(
        "Pine tree", "A conifer, 5 m high.", pine(), scripts={"PineTree/Branch": (0.1, 0.3, 0.14), "PineTree/Bark": (0.32, 0.22, 0.13)}
    ),
    "oak_tree": static(
        "Oak tree",
        "A tree with a wide crown, 6.5 m high.",
        oak(),
        scripts={"OakTree/Branch": (0.2, 0.4, 0.14), "OakTree/Bark": (0.32, 0.22, 0.13)},
    ),
    "lamp_post": static("Lamp post", "A street lamp, 9.3 m high, its arm to -y.", lamp(), "Lamp Post"),
    "telephone_pole": static("Telephone pole", "A wooden pole, 9.1 m high.", telephone_pole()),
    "stop_light_post": static("Stop light post", "Traffic lights on an arm to -x, 6 m high.", stop_light_post()),
    "speed_limit_sign": static("Speed limit sign", "A road sign, 2.4 m high, seen from -y.", speed_limit(), "Speed limit"),
    "hatchback": static("Hatchback", "A small car, 4 m long.", hatchback(GREY)),
    "hatchback_red": static("Hatchback red", "A small red car, 4 m long.", hatchback(RED)),
    "hatchback_blue": static("Hatchback blue", "A small blue car, 4 m long.", hatchback(BLUE)),
    "suv": static("SUV", "A big car, 5 m long.", car((-2.44, -1.3, 0), (2.58, 1.3, 2.15), 1.3, (-2.3, 1.0), colour(0.2, 0.25, 0.2))),
    "pickup": static("Pickup", "A car with an open bed, 5.7 m long.", pickup()),
    "bus": static("Bus", "A bus, 12.5 m long.", coach((-1.35, -6.29, 0), (1.35, 6.19, 3.7), WHITE, BLUE)),
    "ambulance": static("Ambulance", "An ambulance, 7.5 m long.", coach((-1.48, -3.85, 0), (1.48, 3.69, 2.87), WHITE, RED, 1.6)),
    "fire_truck": static("Fire truck", "A fire engine, 12.4 m long.", coach((-1.77, -6.55, 0), (1.77, 5.88, 3.35), RED, WHITE)),
    "house_1": static(
        "House 1",
        "A house of two storeys, 16.5 m by 13 m.",
        house((-8.64, -6.84, 0), (7.85, 6.09, 7.69), 5.0, CREAM, 1.5),
        "House 1",
        scripts={"House_1/Diffuse": (0.85, 0.8, 0.68)},
    ),
    "house_2": static(
        "House 2",
        "A house, 12.7 m by 9.8 m.",
        house((-5.15, -4.11, 0), (7.56, 5.66, 7.19), 4.4, BRICK),
        "House 2",
        scripts={"House_2/Diffuse": (0.56, 0.3, 0.24)},
    ),
    "house_3": static(
        "House 3",
        "A house of two storeys, 13 m by 8.7 m.",
        house((-7.08, -4.37, 0), (6.1, 4.34, 9.17), 5.8, WHITE, 1.2),
        "House 3",
        scripts={"House_3/Diffuse": (0.9, 0.9, 0.88)},
    ),
    "gas_station": static(
        "Gas station",
        "A shop, pumps under a canopy and a sign.",
        gas_station(),
        "Gas Station",
        scripts={"GasStation/Diffuse": (0.85, 0.8, 0.68)},
    ),
    "fast_food": static(
        "Fast food",
        "A restaurant with a sign.",
        fast_food(),
        "Fast Food",
        link_pose=(0, 0, 3.15931296),
        scripts={"FastFood/Diffuse": (0.7, 0.08, 0.06)},
    ),
    "cafe": static("Cafe", "A room of 9.4 m by 22.6 m, without a roof.", cafe()),
    "fire_station": static("Fire station", "A building with three gates, at +y.", fire_station()),
    "post_office": static("Post office", "A low building, 10.4 m wide.", flat((-5.2, -2.18, 0), (5.2, 5.12, 3.93), BRICK, 1, BLUE)),
    "police_station": static(
        "Police station",
        "A building on a terrace, 13 m by 13 m.",
        (
            Shape("landing", box(13.037, 16.2446, 0.9282), (0, 0, 0.4641), GREY),
            *flat((-6.5185, -6.5185, 0), (6.5185, 6.5185, 8.58), CREAM, 2, BLUE),
        ),
    ),
    "school": static("School", "A building of three storeys, 33 m wide.", flat((-16.51, -11.11, 0), (16.51, 6.41, 14.24), BRICK, 3)),
    "grocery_store": static(
        "Grocery store", "A shop, 32 m wide.", flat((-16.0992, -8.7713, 0), (16.0992, 8.7713, 8.0921), CREAM, 1, LEAVES)
    ),
    "law_office": static("Law office", "A narrow house of four storeys.", flat((-3.422, -2.716, 0), (3.422, 2.716, 13.925), BRICK, 4)),
    "salon": static("Salon", "A narrow house of four storeys.", flat((-3.6065, -2.6894, 0), (3.6065, 2.6894, 11.3894), CREAM, 4, RED)),
    "thrift_shop": static(
        "Thrift shop", "A narrow house of four storeys.", flat((-3.6065, -2.7158, 0), (3.6065, 2.7158, 11.3894), BRICK, 4, YELLOW)
    ),
    "apartment": static("Apartment", "A house of five storeys, 20 m by 22 m.", flat((-10.13, -11.14, 0), (10.13, 11.14, 14.79), BRICK, 5)),
    "office_building": static(
        "Office building", "A house of six storeys, 18 m by 18 m.", flat((-8.85, -8.85, 0), (8.85, 8.85, 18.66), GREY, 6), "Office Building"
    ),
    "radio_tower": static("Radio tower", "A mast, 44 m high.", tower(5.8, 44.17)),
    "water_tower": static("Water tower", "A tank on four legs, 23 m high.", water_tower()),
    "fountain": static("Fountain", "A fountain, 2.7 m high.", fountain()),
    "grey_tote": Model(
        "Grey tote", "A container with a lid, 68 cm long, 3.5 kg.", tote(), mass=3.53802, inertia=(0.09, 0.17, 0.2), com=(0, 0, 0.15)
    ),
    "stop_light": static("Stop light", "Traffic lights seen from -y.", stop_light(), pose=(0, 0, 1.0)),
    "nist_maze_wall_120": static("NIST maze wall 120", "A thin wall, 1.2 m square.", maze_wall(1.2), link="nist_maze_wall_120_link"),
    "nist_maze_wall_240": static("NIST maze wall 240", "A thin wall, 2.4 m high.", maze_wall(2.4), link="nist__maze_wall_240_link"),
    "drc_practice_yellow_parking_block": static(
        "DRC practice yellow parking block", "A low kerb, 1.8 m long.", (block("block", (-0.08, -0.9, 0), (0.08, 0.9, 0.1), YELLOW),)
    ),
    "drc_practice_truss": Model(
        "DRC practice truss", "A piece of scaffolding, 1.5 m long.", truss(), mass=20.7307, inertia=(4.7978, 0.4699, 4.7978), name="truss"
    ),
    "euro_pallet": Model("Euro pallet", "A pallet, 0.8 m by 1.2 m.", pallet(), mass=20.0, inertia=(2.43, 1.1, 3.47)),
    **{
        f"number{digit}": static(f"Number {digit}", f"A cube that shows {digit}.", number(digit), pose=(0, 0, 0.4))
        for digit in range(1, 10)
    },
}
