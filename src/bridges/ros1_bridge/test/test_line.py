"""What the two processes say to each other comes whole and in its order, and questions get their answers."""

import socket
import threading
from multiprocessing.connection import Connection

import pytest
from ros1_bridge.line import BULK, Line


class End:
    """One end, with what it has heard."""

    def __init__(self, end, answers):
        self.line, self.heard, self.over = Line(Connection(end.detach())), [], threading.Event()
        self.came, self._answers = threading.Condition(), answers
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self):
        self.line.listen(self._hear)
        self.over.set()

    def _hear(self, word, *words):
        if word == "answer":
            self.line.answered(*words)
        elif word in self._answers:
            *_, number, data = words
            self.line.answer(number, self._answers[word], data)
        with self.came:
            self.heard.append((word, *words))
            self.came.notify_all()

    def wait(self, count):
        with self.came:
            assert self.came.wait_for(lambda: len(self.heard) >= count, 20.0)
        return self.heard


@pytest.fixture
def ends():
    return [End(end, {"call": "done"}) for end in socket.socketpair()]


@pytest.mark.parametrize("size", [0, 1, BULK, BULK + 1, 5_000_000])
def test_data_of_any_size_comes_whole(ends, size):
    data = bytes(index % 251 for index in range(min(size, 1000))) * (size // min(size, 1000) if size else 0)
    one, two = ends
    one.line.tell("first", 1, "x", data=data)
    one.line.tell("second", data=bytearray(data))
    one.line.tell("third")
    assert two.wait(3) == [("first", 1, "x", data), ("second", data), ("third", None)]


def test_both_ends_ask_at_one_time_and_each_gets_its_own_answers(ends):
    said, lock = [], threading.Lock()

    def ask(end, mark):
        for _ in range(50):
            answer = end.line.wait(20.0, "call", mark, data=mark.encode() * 10)
            with lock:
                said.append((answer, mark))

    threads = [threading.Thread(target=ask, args=(end, mark)) for end, marks in zip(ends, ("ab", "cd")) for mark in marks]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60.0)
    assert len(said) == 200 and all(answer == ("done", mark.encode() * 10) for answer, mark in said)


def test_a_question_that_nobody_answers_ends_and_a_late_answer_is_left_out(ends):
    one, two = ends
    with pytest.raises(TimeoutError):
        one.line.wait(0.01, "nothing")
    ((_, number, _),) = two.wait(1)
    two.line.answer(number, "late")
    two.line.tell("more")
    one.wait(2)
    assert one.line.wait(20.0, "call") == ("done", None)


def test_an_end_hears_that_the_other_has_gone():
    ours, theirs = socket.socketpair()
    end = End(ours, {})
    theirs.close()
    assert end.over.wait(20.0)
    end.line.tell("into the air")
