"""The assistant's screens, in the order of its list."""

from moveit_setup_assistant.screens.author import AuthorScreen
from moveit_setup_assistant.screens.controllers import ControllersScreen
from moveit_setup_assistant.screens.end_effectors import EndEffectorsScreen
from moveit_setup_assistant.screens.files import FilesScreen
from moveit_setup_assistant.screens.groups import GroupsScreen
from moveit_setup_assistant.screens.passive_joints import PassiveJointsScreen
from moveit_setup_assistant.screens.perception import PerceptionScreen
from moveit_setup_assistant.screens.poses import PosesScreen
from moveit_setup_assistant.screens.self_collisions import SelfCollisionsScreen
from moveit_setup_assistant.screens.simulation import SimulationScreen
from moveit_setup_assistant.screens.start import StartScreen
from moveit_setup_assistant.screens.virtual_joints import VirtualJointsScreen

ALL = (
    StartScreen,
    SelfCollisionsScreen,
    VirtualJointsScreen,
    GroupsScreen,
    PosesScreen,
    EndEffectorsScreen,
    PassiveJointsScreen,
    ControllersScreen,
    SimulationScreen,
    PerceptionScreen,
    AuthorScreen,
    FilesScreen,
)
