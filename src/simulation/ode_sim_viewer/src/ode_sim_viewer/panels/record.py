"""Save the world, a screenshot, a replay."""

from __future__ import annotations

import time
from typing import Any

from ode_sim_viewer.movie import RATE, Movie
from ode_sim_viewer.panels.base import Panel
from ode_sim_viewer.porter import entitled
from ode_sim_viewer.simulation import Frame, Refused


class RecordPanel(Panel):
    title = "Record"

    def __init__(self, page: Any):
        super().__init__(page)
        self._save = self.gui.add_button("Save world", hint="a world file of everything as it is now")
        self._shot = self.gui.add_button("Screenshot", hint="what this page shows, as PNG")
        self._replay = self.gui.add_button("Record", hint="a page that plays by itself, without a simulator")
        self._save.on_click(
            lambda event: page.attempt(
                event, lambda: keep(event.client, f"{page.world.name or 'world'}.world", self.simulation.save().encode())
            )
        )
        self._shot.on_click(lambda event: page.attempt(event, lambda: self._screenshot(event.client)))
        self._replay.on_click(lambda event: page.attempt(event, lambda: self._toggle(event.client)))
        self._film = self.gui.add_button("Film", hint="MP4 of what this page looks at, drawn when it ends; 2 minutes")
        self._film.on_click(lambda event: page.attempt(event, lambda: self._toggle_film(event.client)))
        self._recording: Any | None = None
        self._last = 0.0
        self._movie: Movie | None = None
        self._filming: Any = None  # the page that films
        self._next = 0.0  # wall s of the next picture

    def on_frame(self, frame: Frame) -> None:
        if self._recording is not None:
            now = time.monotonic()
            self._recording.insert_sleep(now - self._last)
            self._last = now

    def on_move(self, frame: Frame) -> None:
        movie, now = self._movie, time.monotonic()
        while movie is not None and self._next <= now and not movie.full:
            self._next += 1.0 / RATE
            movie.add(self.page.world, frame, self._filming.camera)

    def _toggle_film(self, client: Any) -> None:
        if self._movie is None:
            width, height = (
                max(64, int(side or usual)) for side, usual in ((client.camera.image_width, 1280), (client.camera.image_height, 720))
            )
            self._filming, self._next = client, time.monotonic()
            self._movie = Movie(width, height)
            self._film.label = "Stop and keep the film"
            return
        movie, self._movie, self._filming = self._movie, None, None
        self._film.label = "Film"
        keep(client, "film.mp4", movie.render())

    def _screenshot(self, client: Any) -> None:
        import cv2

        width = max(64, min(int(client.camera.image_width or 1280), 3840))
        height = max(64, min(int(client.camera.image_height or 720), 2160))
        picture = client.get_render(height, width)
        good, data = cv2.imencode(".png", picture[..., ::-1])
        if not good:
            raise Refused("The picture could not be written as PNG.")
        keep(client, "screenshot.png", data.tobytes())

    def _toggle(self, client: Any) -> None:
        if self._recording is None:
            self._recording, self._last = self.page.server.get_scene_serializer(), time.monotonic()
            self._replay.label = "Stop and keep the recording"
            return
        recording, self._recording = self._recording, None
        self._replay.label = "Record"
        keep(client, "replay.html", entitled(recording.as_html().encode(), f"Replay of {self.page.world.name or 'a world'}", framed=False))


def keep(client: Any, name: str, content: bytes) -> None:
    """A download of ``content`` as the file ``name`` by ``client``'s browser, without a further click."""
    client.send_file_download(name, content, save_immediately=True)
