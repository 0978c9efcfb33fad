"""Which displays need not be waited for."""

import pytest
from rviz_offscreen.displays import State, nobody_publishes


@pytest.mark.parametrize(
    "topics, published, nobody",
    [
        (("/eye",), (), True),
        (("/eye",), ("/eye",), False),
        (("/eye",), ("/eye/compressed",), False),
        (("/eye",), ("/eyelid",), True),
        (("/eye",), ("/eye/mouse_click",), True),
        (("/eye",), ("/eye/mouse_click", "/eye/theora"), False),
        (("", "/b"), ("/b",), False),
        (("/mouse_click",), ("/mouse_click",), False),
        (("",), ("/eye",), True),
        ((), (), False),
    ],
)
def test_nobody_publishes(topics, published, nobody):
    assert nobody_publishes(State("Eye", "Warn", topics=topics), frozenset(published)) is nobody
