"""Where the pointer is over the scene of one page. viser tells of clicks and drags only, so a few lines of script note
it in the page, and it is asked for."""

from __future__ import annotations

import json
import secrets
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from ode_sim.math3 import quat_to_matrix

_PERIOD = 1.0 / 20.0  # wall s between two questions
_PATIENCE = 10.0  # wall s that a page may take to answer
_ESCAPE = "escape"
_SCRIPT = """
const key = Object.keys(localStorage).find(name => name.endsWith(KEY));
const canvas = [...document.querySelectorAll('canvas')].sort((a, b) => b.width * b.height - a.width * a.height)[0];
const tell = text => {
  if (localStorage.getItem(key) !== null) { localStorage.setItem(key, text); return; }
  canvas.removeEventListener('pointermove', move);
  window.removeEventListener('keydown', press);
};
const move = event => {
  const box = canvas.getBoundingClientRect();
  tell(`${(event.clientX - box.left) / box.width} ${(event.clientY - box.top) / box.height}`);
};
const press = event => { if (event.key === 'Escape') tell('escape'); };
canvas.addEventListener('pointermove', move);
window.addEventListener('keydown', press);
"""

Ray = tuple[np.ndarray, np.ndarray]  # place of the eye and direction, (3,)


def ray_of(camera: Any, x: float, y: float) -> Ray:
    """What a pixel of a page sees.

    :param camera: of viser: ``position``, ``wxyz`` (z forward, y down), ``fov`` rad from edge to edge, ``aspect``
    :param x, y: 0 to 1, from the upper left corner
    """
    half = np.tan(float(camera.fov) / 2)
    w, i, j, k = (float(v) for v in camera.wxyz)
    turn = np.array(quat_to_matrix((i, j, k, w)))
    way = turn @ np.array([(2 * x - 1) * half * float(camera.aspect), (2 * y - 1) * half, 1.0])
    return np.asarray(camera.position, float), way


def on_plane(ray: Ray, height: float = 0.0, farthest: float = 1000.0) -> tuple[float, float] | None:
    """(x, y) m where ``ray`` meets the level at ``height``, m; None where it does not, or beyond ``farthest`` m."""
    origin, way = (np.asarray(part, float) for part in ray)
    if abs(way[2]) < 1e-9:
        return None
    along = (height - origin[2]) / way[2]
    place = origin + along * way
    if not along > 0.0 or not np.linalg.norm(place - origin) < farthest:
        return None
    return float(place[0]), float(place[1])


class Pointer:
    """Asks from now on until :meth:`end`, in a thread of its own.

    :param on_ray: called there with every new :data:`Ray`. :param on_escape: the key was pressed, or the page has gone
    """

    def __init__(self, client: Any, on_ray: Callable[[Ray], None], on_escape: Callable[[], None]):
        self._client = client
        self._on_ray, self._on_escape = on_ray, on_escape
        self._key = f"pointer_{secrets.token_hex(4)}"
        self._ended = threading.Event()
        threading.Thread(target=self._run, name="pointer", daemon=True).start()

    def end(self) -> None:
        self._ended.set()

    def _run(self) -> None:
        from viser import _messages

        store, told = self._client.local_storage, ""
        try:
            store.set_item(self._key, told)
            self._client._websock_connection.queue_message(
                _messages.RunJavascriptMessage(source=_SCRIPT.replace("KEY", json.dumps(self._key)))
            )
            while not self._ended.is_set():
                begin = time.monotonic()
                now = store.get_item(self._key, _PATIENCE) or ""
                if now == _ESCAPE:
                    self._on_escape()
                    break
                if now and now != told and not self._ended.is_set():
                    told = now
                    x, y = (float(part) for part in now.split())
                    self._on_ray(ray_of(self._client.camera, x, y))
                self._ended.wait(max(0.0, begin + _PERIOD - time.monotonic()))
            store.remove_item(self._key)
        except TimeoutError:  # it draws slowly: without a preview the click still counts
            return
        except (RuntimeError, ValueError):  # it has gone, or keeps nothing for others
            if not self._ended.is_set() and self._client.client_id not in self._clients():
                self._on_escape()

    def _clients(self) -> Any:
        return self._client._viser_server._connected_clients
