"""What is to be done when a new master is there, and for how long it is kept in mind."""

import gc

from node_signals import master_watch


class Parameters:
    def __init__(self):
        self.set = 0

    def restore(self):
        self.set += 1


def function():
    pass


def test_what_an_object_wanted_done_goes_with_it():
    """Controllers are loaded and unloaded by the thousand in a long run."""
    before = len(master_watch._restorers)
    for _ in range(100):
        master_watch.on_return(Parameters().restore)
    gc.collect()
    assert len(master_watch._restorers) == before
    kept = Parameters()
    master_watch.on_return(kept.restore)
    master_watch.on_return(function)
    gc.collect()
    assert [reference() for reference in list(master_watch._restorers.values())[before:]] == [kept.restore, function]
