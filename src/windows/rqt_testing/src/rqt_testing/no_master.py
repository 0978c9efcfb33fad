"""A master that knows nobody: enough for rospy to make publishers and subscribers in a test."""

import threading
from socketserver import ThreadingMixIn
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer


class _Handler(SimpleXMLRPCRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass


class _Server(ThreadingMixIn, SimpleXMLRPCServer):
    daemon_threads = True  # callers keep their connections open


class NoMaster:
    """Answers every call of a node with success and nothing; ``answers[method]`` gives a method another value."""

    def __init__(self, answers=None):
        self.answers = {
            "getPid": 1,
            "getSystemState": [[], [], []],
            "getPublishedTopics": [],
            "getTopicTypes": [],
            "subscribeParam": {},
            "getParamNames": [],
            "hasParam": False,
            "searchParam": "",
            **(answers or {}),
        }
        self._nodes = {}
        self._server = _Server(("127.0.0.1", 0), requestHandler=_Handler, logRequests=False, allow_none=True)
        self._server.register_instance(self)
        self._server.register_multicall_functions()

    def start(self) -> str:
        """Serve from a thread; returns the URI."""
        threading.Thread(target=self._server.serve_forever, name="no master", daemon=True).start()
        return f"http://127.0.0.1:{self._server.server_address[1]}"

    def _dispatch(self, method, parameters):
        if method in ("registerPublisher", "registerSubscriber", "registerService"):
            self._nodes[parameters[0]] = parameters[3]
        if method == "lookupNode" and parameters[1] in self._nodes:
            return [1, "", self._nodes[parameters[1]]]  # a node that is not known would register again and again
        if method in ("getParam", "lookupNode", "lookupService", "searchParam", "deleteParam") and method not in self.answers:
            return [-1, "nobody here", 0]
        value = self.answers.get(method)
        if value is None:
            value = [] if method in ("registerSubscriber", "registerPublisher") else 1
        return [1, "", value]
