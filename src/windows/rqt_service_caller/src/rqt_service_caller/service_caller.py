"""The plugin: calls services, in the background."""

import ast

import roslib.message
import rospy
import rosservice
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from rqt_py_common.message_template import Field, TemplateError

from .service_caller_widget import ServiceCallerWidget


class RequestField(Field):
    """A request as a whole: its type has no name of its own among the messages."""

    def __init__(self, request_class):
        """:raises TemplateError: if one of its fields cannot be imported"""
        self.name, self.type_name, self.path = "", request_class._type, ""
        self.base, self.is_array, self.fixed_length = request_class._type, False, None
        self.expression, self.children, self.message_class = None, [], request_class
        self._add_slots()


def service_class(type_name: str):
    """:raises TemplateError: if it cannot be imported"""
    try:
        found = roslib.message.get_service_class(type_name)
    except ValueError as error:
        raise TemplateError("", str(error)) from error
    if found is None:
        raise TemplateError("", f"cannot import the service type {type_name}; is its package built and sourced?")
    return found


class ServiceCaller(Plugin):
    """One service is chosen; its request is edited and sent."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("ServiceCaller")
        self._background = Background(self)
        self._requests = {}  # service -> state of its request
        self._service, self._class, self._template = "", None, None
        self._counter = 0
        self._widget = ServiceCallerWidget()
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        self._widget.refresh_requested.connect(self.refresh)
        self._widget.service_chosen.connect(self.choose)
        self._widget.call_requested.connect(self.call)
        self._widget.stop_requested.connect(self.stop_waiting)
        context.add_widget(self._widget)
        self.refresh()

    @property
    def widget(self) -> ServiceCallerWidget:
        return self._widget

    def refresh(self) -> None:
        self._background.run(
            "services",
            lambda: sorted(rosservice.get_service_list()),
            self._widget.set_services,
            lambda error: self._widget.show_error(str(error)),
        )

    def choose(self, service: str) -> None:
        """Ask a service for its type; a node that is dead or hangs answers never."""
        self._keep_request()
        self._service, self._class, self._template = service, None, None
        self._widget.show_request(service, None)
        self._background.forget("type")
        if service:
            self._background.run(
                "type",
                lambda: rosservice.get_service_type(service),
                lambda kind: self._show(service, kind),
                lambda error: self._widget.show_error(str(error)),
            )

    def _show(self, service: str, type_name) -> None:
        if not type_name:
            self._widget.show_error(f"{service} does not answer; its node may be dead")
            return
        try:
            self.use(service, service_class(type_name), type_name)
        except TemplateError as error:
            self._widget.show_error(str(error))

    def use(self, service: str, kind, type_name: str) -> None:
        """Edit a request of ``service``, whose class is ``kind`` and whose type is called ``type_name``.

        :raises TemplateError: if one of its fields cannot be imported
        """
        template = RequestField(kind._request_class)
        self._service, self._class, self._template = service, kind, template
        self._template.restore(self._requests.get(service, {}))
        self._widget.show_request(type_name, self._template)

    def call(self) -> None:
        if self._template is None:
            return
        try:
            request = self._template.value(self._counter)
        except TemplateError as error:
            self._widget.show_request_error(error)
            return
        self._widget.show_request_error(None)
        service, kind = self._service, self._class
        self._widget.show_waiting(True)
        self._background.run("call", lambda: rospy.ServiceProxy(service, kind)(request), self._answered, self._failed)

    def stop_waiting(self) -> None:
        """The call goes on, its answer will not be shown."""
        self._background.forget("call")
        self._widget.show_waiting(False)

    def _answered(self, response) -> None:
        self._widget.show_waiting(False)
        self._widget.show_response(response)

    def _failed(self, error) -> None:
        self._widget.show_waiting(False)
        self._widget.show_failure(error)

    def _keep_request(self) -> None:
        if self._template is not None:
            self._requests[self._service] = self._template.state()

    def trigger_configuration(self) -> None:
        self._widget.flip()

    def shutdown_plugin(self) -> None:
        self._background.close()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        self._keep_request()
        instance_settings.set_value("splitter_orientation", 2 if self._widget.orientation() == "vertical" else 1)  # Qt's numbers
        instance_settings.set_value("current_service_name", self._service)
        instance_settings.set_value("requests", repr(self._requests))

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        vertical = str(instance_settings.value("splitter_orientation", 1)) in ("2", "vertical")  # the word: until 0.2
        self._widget.set_orientation("vertical" if vertical else "horizontal")
        try:
            requests = ast.literal_eval(instance_settings.value("requests", "{}") or "{}")
            self._requests = {str(name): dict(state) for name, state in requests.items()}
        except (ValueError, SyntaxError, TypeError, AttributeError):
            self._requests = {}
        self._widget.choose(instance_settings.value("current_service_name", "") or "")
