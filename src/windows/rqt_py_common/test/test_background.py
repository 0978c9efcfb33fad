"""Calls in threads: results in this one, hung calls harmless."""

import threading

from rqt_py_common.background import Background
from rqt_testing.in_process import application, process_events, wait_until


def test_results_and_errors_come_in_the_thread_of_the_window():
    application()
    got, background = [], Background()
    background.run("a", lambda: 1 + 1, lambda value: got.append((value, threading.current_thread())))
    background.run("b", lambda: 1 / 0, got.append, lambda error: got.append((type(error), threading.current_thread())))
    wait_until(lambda: len(got) == 2)
    assert set(got) == {(2, threading.main_thread()), (ZeroDivisionError, threading.main_thread())}
    assert not background.busy("a")


def test_a_hung_call_is_not_started_twice_and_can_be_forgotten():
    application()
    got, gate, background = [], threading.Event(), Background()
    assert background.run("poll", gate.wait, got.append)
    assert not background.run("poll", lambda: 1, got.append)
    assert background.run("other", lambda: 2, got.append)
    wait_until(lambda: got == [2])
    background.forget("poll")
    assert background.run("poll", lambda: 3, got.append)
    wait_until(lambda: got == [2, 3])
    gate.set()
    background.close()
    process_events()
    assert got == [2, 3] and not background.run("poll", lambda: 4, got.append)
