"""For time lines of other packages: keeps their caches of stamps up to date."""

import threading


class IndexCacheThread(threading.Thread):
    """Calls ``timeline._update_index_cache(topic)`` for topics in ``timeline.invalidated_caches``, at most once in
    ``period`` seconds, whenever ``timeline.index_cache_cv`` is notified; has the scene drawn again if that found any."""

    def __init__(self, timeline):
        super().__init__(daemon=True)
        self.timeline = timeline
        self.period = 1.0
        self._stopped = threading.Event()
        self.start()

    def run(self):
        timeline = self.timeline
        while not self._stopped.is_set():
            with timeline.index_cache_cv:
                while not timeline.invalidated_caches and not self._stopped.is_set():
                    timeline.index_cache_cv.wait()
                if self._stopped.is_set():
                    return
                stale = [topic for topic in timeline.topics if topic in timeline.invalidated_caches]
                found = sum(timeline._update_index_cache(topic) for topic in stale)
            try:
                if found:
                    timeline.scene().update()
            except RuntimeError:
                return  # the window is gone
            self._stopped.wait(self.period)

    def stop(self):
        self._stopped.set()
        with self.timeline.index_cache_cv:
            self.timeline.index_cache_cv.notify_all()
