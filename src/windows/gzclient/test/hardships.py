"""What a page has to bear: meshes that are broken, worlds that are large, networks that are slow."""

import contextlib
import math
import os
import socket
import struct
import threading
import time

WORLD = (
    "<sdf version='1.6'><world name='{name}'><include><uri>model://sun</uri></include>"
    "<include><uri>model://ground_plane</uri></include>{models}</world></sdf>"
)
LINK = (
    "<model name='{name}'><pose>{x} {y} {z} 0 0 0</pose><link name='l'><inertial><mass>1</mass><inertia><ixx>0.01</ixx>"
    "<iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name='c'><geometry><sphere><radius>0.3</radius></sphere>"
    "</geometry></collision><visual name='v'><geometry>{shape}</geometry></visual></link></model>"
)
BALL = "<sphere><radius>0.3</radius></sphere>"
PENDULUM = (
    "<model name='{name}'><pose>{x} {y} 2 0 0 0</pose><link name='l'><inertial><pose>0.8 0 0 0 0 0</pose><mass>1</mass><inertia>"
    "<ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><visual name='v'><pose>0.8 0 0 0 0 0</pose><geometry>"
    "{shape}</geometry></visual></link><joint name='j' type='revolute'><parent>world</parent><child>l</child><axis>"
    "<xyz>0 1 0</xyz></axis></joint></model>"
)
BROKEN = {
    "cut.stl": bytes(80) + struct.pack("<I", 4_000_000) + b"x" * 500,
    "text.dae": b"<COLLADA><open>",
    "none.obj": b"",
    "nan.stl": bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", *[float("nan")] * 12, 0),
    "far.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n",
    "missing.dae": None,
}


def write_world(file, models, name="default"):
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(WORLD.format(name=name, models=models))
    return file


def body(name, x, y, z, shape=BALL):
    return LINK.format(name=name, x=x, y=y, z=z, shape=shape)


def mesh(file):
    return f"<mesh><uri>file://{file}</uri></mesh>"


def swinging_balls(count):
    """b0, b1 ...; they swing for ever."""
    return "".join(PENDULUM.format(name=f"b{i}", x=i % 6, y=i // 6, shape=BALL) for i in range(count))


def broken_bodies(folder):
    """A model of each mesh that is not there, cut off, of text, of nothing; it has the file's name."""
    models = []
    for number, (name, content) in enumerate(BROKEN.items()):
        file = os.path.join(folder, name)
        if content is not None:
            with open(file, "wb") as stream:
                stream.write(content)
        models.append(body(name, 2, number, 0.3, mesh(file)))
    return "".join(models)


def heavy_bodies(folder):
    """m0 to m199, of 5 000 triangles each."""
    file = os.path.join(folder, "ball.stl")
    sphere_file(file, 50, 50)
    return "".join(body(f"m{i}", i % 20, i // 20, 0.3, mesh(file)) for i in range(200))


def sphere_file(file, rows, columns):
    """A binary STL of rows x columns x 2 triangles."""

    def point(row, column):
        polar, turn = math.pi * row / rows, 2 * math.pi * column / columns
        radius = 0.3 * (1 + 0.1 * math.sin(9 * turn) * math.sin(7 * polar))
        return (radius * math.sin(polar) * math.cos(turn), radius * math.sin(polar) * math.sin(turn), radius * math.cos(polar))

    with open(file, "wb") as stream:
        stream.write(bytes(80) + struct.pack("<I", 2 * rows * columns))
        for row in range(rows):
            for column in range(columns):
                a, b, c, d = (point(row + i, column + j) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
                for triangle in ((a, b, c), (a, c, d)):
                    stream.write(struct.pack("<12fH", 0, 0, 1, *(v for p in triangle for v in p), 0))


class SlowNetwork:
    """A relay to a port of this machine that lets through so many bytes a second in each direction, each of them late."""

    def __init__(self, port, rate=250_000, delay=0.1):
        self._target, self._rate, self._delay = port, rate, delay
        self._door = socket.create_server(("127.0.0.1", 0))
        self.port = self._door.getsockname()[1]
        self.carried = 0
        threading.Thread(target=self._accept, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._door.close()

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                near = self._door.accept()[0]
                far = socket.create_connection(("127.0.0.1", self._target))
                for one, other in ((near, far), (far, near)):
                    threading.Thread(target=self._carry, args=(one, other), daemon=True).start()

    def _carry(self, source, target):
        with contextlib.suppress(OSError):
            time.sleep(self._delay)
            while data := source.recv(4096):
                target.sendall(data)
                self.carried += len(data)
                time.sleep(len(data) / self._rate)
            target.shutdown(socket.SHUT_WR)
