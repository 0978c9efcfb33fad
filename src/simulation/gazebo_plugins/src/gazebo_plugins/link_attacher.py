"""libgazebo_ros_link_attacher.so: services that hold links of two models together and let them go."""

from __future__ import annotations

from collections.abc import Callable

import rospy
from gazebo_ros.plugin import PluginError, WorldPlugin
from gazebo_ros_link_attacher.srv import Attach, AttachRequest, AttachResponse
from node_signals import offers
from ode_sim import Attachment

Pair = tuple[str, str]


class LinkAttacher(WorldPlugin):
    """``/link_attacher_node/attach`` and ``detach``; an attachment ends with its models and with a reset."""

    def load(self, server, sdf) -> None:
        self.server = server
        self.attachments: dict[Pair, Attachment] = {}
        self.services = [
            offers.service(f"/link_attacher_node/{name}", Attach, handler)
            for name, handler in (("attach", self._attach), ("detach", self._detach))
        ]

    def _attach(self, request: AttachRequest) -> AttachResponse:
        return self._answer(lambda: self._hold(request))

    def _detach(self, request: AttachRequest) -> AttachResponse:
        return self._answer(lambda: self._let_go(request))

    def _answer(self, action: Callable[[], None]) -> AttachResponse:
        try:
            self.server.call(action)
        except (PluginError, ValueError) as error:
            rospy.logerr("link attacher: %s", error)
            return AttachResponse(ok=False)
        return AttachResponse(ok=True)

    def _links(self, request: AttachRequest):
        links = []
        for model_name, link_name in ((request.model_name_1, request.link_name_1), (request.model_name_2, request.link_name_2)):
            model = self.server.world.models.get(model_name)
            if model is None:
                raise PluginError(f"there is no model '{model_name}'; there are {', '.join(self.server.world.models) or 'none'}")
            if link_name not in model.links:
                raise PluginError(f"model {model_name} has no link '{link_name}'; it has {', '.join(model.links) or 'none'}")
            links.append(model.links[link_name])
        return links

    def _hold(self, request: AttachRequest) -> None:
        first, second = self._links(request)
        held = self.attachments.get(_pair(request))
        if held is None or not held.active:
            self.attachments[_pair(request)] = self.server.world.attach(first, second)

    def _let_go(self, request: AttachRequest) -> None:
        """What was held once is let go as often as somebody asks, also when its models are gone."""
        held = self.attachments.get(_pair(request))
        if held is None:
            first, second = self._links(request)
            raise PluginError(f"{first.scoped_name} and {second.scoped_name} were never attached in this order")
        if held.active:
            held.detach()

    def shutdown(self) -> None:
        for service in self.services:
            service.shutdown("the plugin is unloaded")


def _pair(request: AttachRequest) -> Pair:
    return (f"{request.model_name_1}::{request.link_name_1}", f"{request.model_name_2}::{request.link_name_2}")
