"""What the tests of SDF share: models in a folder, and short ways to read a body."""

import pytest
from ode_sim.description import ResourceFinder, load_world, read_sdf_model

BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
MODEL = """<?xml version="1.0"?>
<sdf version="1.6"><model name="{name}"><pose>9 9 9 0 0 0</pose>
<link name="body"><pose>0 0 1 0 0 0</pose></link><link name="tip"/>
<joint name="j" type="revolute"><parent>body</parent><child>tip</child></joint>
<plugin name="own" filename="libown.so"/></model></sdf>"""


@pytest.fixture
def models(tmp_path):
    def add(name, sdf, config='<model><sdf version="1.6">model.sdf</sdf></model>'):
        folder = tmp_path / "models" / name
        folder.mkdir(parents=True)
        (folder / "model.config").write_text(config)
        (folder / "model.sdf").write_text(sdf)
        return folder

    add.finder = ResourceFinder([tmp_path / "models"], [tmp_path], environment=False, stock="/nowhere", package_path=lambda name: None)
    return add


@pytest.fixture
def finder(models):
    return models.finder


def world(body, finder, version="1.6"):
    return load_world(f'<sdf version="{version}"><world name="w">{body}</world></sdf>', finder)


def model(body, finder, version="1.6"):
    return read_sdf_model(f'<sdf version="{version}"><model name="m">{body}</model></sdf>', finder=finder)


def text(problems):
    return "\n".join(str(problem) for problem in problems)


def names(items):
    return [item.name for item in items]
