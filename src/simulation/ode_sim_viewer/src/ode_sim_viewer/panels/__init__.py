"""The tabs of the page; each is a :class:`~ode_sim_viewer.panels.base.Panel` in a module of its own."""

from ode_sim_viewer.panels.insert import InsertPanel
from ode_sim_viewer.panels.joints import JointsPanel
from ode_sim_viewer.panels.physics import PhysicsPanel
from ode_sim_viewer.panels.picked import PickedPanel
from ode_sim_viewer.panels.play import PlayPanel
from ode_sim_viewer.panels.record import RecordPanel
from ode_sim_viewer.panels.timeline import TimelinePanel
from ode_sim_viewer.panels.view import ViewPanel
from ode_sim_viewer.panels.world import WorldPanel

STANDARD = (PlayPanel, WorldPanel, InsertPanel, PickedPanel, JointsPanel, PhysicsPanel, ViewPanel, TimelinePanel, RecordPanel)
