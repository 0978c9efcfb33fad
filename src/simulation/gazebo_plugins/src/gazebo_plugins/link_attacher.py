"""libgazebo_ros_link_attacher.so: services that hold links of two models together and let them go."""

from __future__ import annotations

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
        return self._answer(request, self._hold)

    def _detach(self, request: AttachRequest) -> AttachResponse:
        return self._answer(request, self._let_go)

    def _answer(self, request: AttachRequest, action) -> AttachResponse:
        try:
            self.server.call(lambda: action(*self._links(request)))
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

    def _hold(self, first, second) -> None:
        key = (first.scoped_name, second.scoped_name)
        held = self.attachments.get(key)
        if held is None or not held.active:
            self.attachments[key] = self.server.world.attach(first, second)

    def _let_go(self, first, second) -> None:
        held = self.attachments.pop((first.scoped_name, second.scoped_name), None)
        if held is None or not held.active:
            raise PluginError(f"{first.scoped_name} and {second.scoped_name} are not attached")
        held.detach()

    def shutdown(self) -> None:
        for service in self.services:
            service.shutdown("the plugin is unloaded")
