"""What failed in a subtest is in rosunit's report."""

import socket
import unittest

import pytest
import test_support
from rosunit import xmlrunner
from test_support import free_port, never, wait_until


def subject(name):
    """One of the tests below, which are none of this file: pytest would collect them elsewhere."""

    class Subject(test_support.TestCase):
        def test_cases(self):
            for number in range(4):
                with self.subTest(number, parity=number % 2):
                    self.assertFalse(number % 2, "odd")
            with self.subTest("table"):
                {}["no such key"]

        def test_good(self):
            with self.subTest("good"):
                pass

        def test_skipped(self):
            with self.subTest("skipped"):
                self.skipTest("not here")

    return Subject(name)


def report(name, tmp_path):
    """(unittest's result, the text of the JUnit file) of one of the tests above."""
    file = tmp_path / "report.xml"
    with open(file, "w", encoding="utf-8") as stream:
        result = xmlrunner.XMLTestRunner(stream).run(unittest.TestSuite([subject(name)]))
    return result, file.read_text(encoding="utf-8")


def test_all_cases_that_failed_are_in_the_report(tmp_path):
    result, text = report("test_cases", tmp_path)
    assert len(result.failures) == 1 and not result.errors
    message = str(result.failures[0][1])
    for words in ("3 cases failed", "1, parity=1: 1 is not false : odd", "3, parity=1: ", "table: KeyError: 'no such key'", __file__):
        assert words in message
    assert "parity=1" in text and 'failures="1"' in text


@pytest.mark.parametrize("name, skipped", [("test_good", 0), ("test_skipped", 1)])
def test_what_does_not_fail_is_left_alone(name, skipped, tmp_path):
    result, _ = report(name, tmp_path)
    assert result.wasSuccessful() and len(result.skipped) == skipped


def test_waiting_ends_with_the_answer_or_with_what_was_waited_for():
    answers = iter([0, None, "there"])
    assert wait_until(lambda: next(answers)) == "there"
    with pytest.raises(AssertionError, match="waited 0.05 s in vain for the kettle to boil; the last answer was 0"):
        wait_until(lambda: 0, "the kettle to boil", 0.05)


def test_a_free_port_can_be_taken():
    for kind in (socket.SOCK_STREAM, socket.SOCK_DGRAM):
        with socket.socket(socket.AF_INET, kind) as taken:
            taken.bind(("127.0.0.1", free_port(kind)))


def test_what_must_not_come_ends_the_wait_when_it_does():
    never(lambda: 0, "the end", 0.05)
    answers = iter([0, None, "there"])
    with pytest.raises(AssertionError, match="the end came: 'there'"):
        never(lambda: next(answers), "the end", 5.0)
