"""A function in a thread of its own, and another one in the thread of the widgets when it has ended."""

from python_qt_binding.QtCore import QThread


class WorkerThread(QThread):
    """``start()`` runs ``run_callback()`` in a thread; at its end ``finished_callback()`` runs where the object lives.

    It can be started again after its end.
    """

    def __init__(self, run_callback, finished_callback=None):
        super().__init__()
        self._run_callback = run_callback
        self._finished_callback = finished_callback
        self._wanted = False
        self.finished.connect(self._on_finished)

    def run(self):
        self._run_callback()

    def start(self):
        self._wanted = True
        super().start()

    def _on_finished(self):
        if self._wanted and not self.isRunning():
            self._wanted = False
            if self._finished_callback is not None:
                self._finished_callback()

    def kill(self, patience=2000):
        """End without a call of ``finished_callback``: wait for the function, which should watch a flag of the plugin's.

        :param patience: ms; after that the thread is left behind rather than stopped in the middle of Python's own work,
            which would hang the process
        """
        self._wanted = False
        if self.isRunning() and not self.wait(patience):
            _left_behind.append(self)


_left_behind: list[QThread] = []  # Qt ends the process when the object of a running thread is deleted
