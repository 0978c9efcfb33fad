"""Ctrl-C for rospy nodes that ends them at once, without a traceback, at any moment.

rospy runs the whole shutdown inside its signal handler, on top of whatever the main thread was doing. If that was an
XML-RPC call to the master - every ``rospy.loginfo`` makes one - the handler waits for a lock that the interrupted call
holds, for ever. Here the handler only starts a thread, which shuts down while the main thread finishes its call.
And before ``rospy.init_node``, while a node imports what it needs, Python answers Ctrl-C with a traceback.

A node script::

    import node_signals

    with node_signals.silent():  # imports take a second, in which Ctrl-C ends the process without a word
        from my_package.node import main  # calls node_signals.init_node, waits in node_signals.spin
        node_signals.leave(main())

Nodes of launch files, which are started by the dozen, have ``signal.signal(signal.SIGINT, signal.SIG_DFL)`` before that
import: on a busy machine it takes a fifth of a second itself.

A script that handles ``KeyboardInterrupt`` itself has only its imports in that block. From there on a process that gets
no memory, threads or files from the system any more says so in one line and ends with 1: rospy's threads die of that one
by one, and what is left of the node waits for ever.
"""

import contextlib
import errno
import logging
import os
import select
import signal
import socket
import sys
import threading
import time
from typing import Optional

_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_PATIENCE = 1.5  # s that a main thread which hangs gets to return when the node is shut down
_REGISTERED_SOON = 0.002  # s
_shut_down = threading.Event()  # the shutdown hooks have run, the master knows


@contextlib.contextmanager
def silent():
    """Within the block SIGINT and SIGTERM end the process as they end a program in C: at once, without output - unless
    the block takes them over, as :func:`init_node` does. So does output that nobody reads any more (``... | head``).

    Costs no import of rospy, so that it can stand before all others. Main thread only.
    """
    for number in _SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    _watch_for_starvation()
    try:
        yield
    except BrokenPipeError:
        if not _nobody_reads():
            raise
        os._exit(128 + signal.SIGPIPE)
    finally:
        if signal.getsignal(signal.SIGINT) == signal.SIG_DFL:
            signal.signal(signal.SIGINT, signal.default_int_handler)


def _nobody_reads() -> bool:
    """Whether the reader of what is printed is gone; other pipes, a connection's, are somebody else's trouble."""
    output = select.poll()
    output.register(1, 0)
    return any(event & select.POLLERR for _, event in output.poll(0))


def init_node(name: str, **options) -> None:
    """``rospy.init_node`` of ``name`` and ``options``, with SIGINT and SIGTERM handled as said above. Call it in the main thread.

    Shutdown hooks run in a thread of their own. The process ends when they are done and the main thread has returned,
    which it does when it watches ``rospy.is_shutdown()`` or waits in :func:`spin`; one that hangs is left behind after
    1.5 s.
    """
    import rospy

    before_init_node()
    rospy.init_node(name, disable_signals=True, **options)
    _notice_shutdown()
    for number in _SIGNALS:
        signal.signal(number, _on_signal)


def spin() -> None:
    """``rospy.spin`` that returns the moment the node is shut down, where rospy's looks twice a second."""
    _notice_shutdown()
    _shut_down.wait()


def leave(code: int | None = 0) -> None:
    """End the process like ``sys.exit(code)``, the node shut down in order, without waiting for rospy's threads.

    Python would join them one by one at its end, up to 5 s each when one waits for a peer that hangs.

    :param code: exit code; None counts as 0
    """
    import rospy

    if rospy.core.is_initialized():
        _notice_shutdown()
        threading.Thread(target=rospy.signal_shutdown, args=("the node ends",), name="shutdown", daemon=True).start()
        _shut_down.wait()
    _exit(code or 0)


def before_init_node() -> None:
    """For nodes that call ``rospy.init_node`` themselves, before they do."""
    _end_when_starved_at_start()
    _register_promptly()


def _register_promptly() -> None:
    """rospy looks ten times a second whether the master knows the node; a launch file has a dozen nodes that wait for another."""
    import rospy

    class Prompt:
        @staticmethod
        def sleep(seconds: float) -> None:
            time.sleep(min(seconds, _REGISTERED_SOON))

    rospy.impl.init.time = Prompt  # nothing else of time is used there


def _end_when_starved_at_start() -> None:
    """When the thread of one of its servers cannot start, rospy takes it for a shutdown, or logs it and goes on without."""
    import rospy

    def look(record: logging.LogRecord) -> bool:
        text = record.getMessage()
        if text.startswith("unable to start TCPROS server") and starved(RuntimeError(text)):
            _end_starved("can't start new thread")
        return True

    def at_end(reason: str) -> None:
        if starved(RuntimeError(reason)):
            _end_starved(reason)

    run_error = rospy.impl.init._node_run_error

    def in_xml_rpc(error: Exception) -> None:
        if starved(error):
            _end_starved(error)  # to log it, as rospy does, takes memory
        run_error(error)

    rospy.impl.init._node_run_error = in_xml_rpc
    rospy.core.add_preshutdown_hook(at_end)
    logging.getLogger("rosout").addFilter(look)


def starved(error: BaseException | None) -> bool:
    """Whether ``error`` says that the system has refused memory, a thread or a file."""
    text = str(error)
    return (
        isinstance(error, MemoryError)
        or isinstance(error, socket.gaierror)
        and error.errno == socket.EAI_MEMORY
        or isinstance(error, OSError)
        and error.errno in (errno.ENOMEM, errno.EMFILE, errno.ENFILE)
        or isinstance(error, RuntimeError)
        and "can't start new thread" in text
        or isinstance(error, ImportError)
        and ("failed to map segment" in text or "cannot allocate memory" in text)
        or isinstance(error, SystemError)  # the interpreter's own word where not even a MemoryError could be made
        and ("without exception set" in text or "without setting an exception" in text)
    )


def _end_starved(error) -> None:
    name, lines = os.path.basename(sys.argv[0]), str(error).split("\n")
    reason = next((line for line in reversed(lines) if line.strip(" )")), "out of memory")
    os.write(
        2,
        f"{name}: the system gives this process no more memory, threads or open files ({reason}); "
        "raise its limits (ulimit -v, -u, -n) or close other programs\n".encode(),
    )
    os._exit(1)  # an orderly end needs what there is not


def _watch_for_starvation() -> None:
    main, thread, ignored = sys.excepthook, threading.excepthook, sys.unraisablehook

    def in_main(kind, error, trace) -> None:
        _end_starved(error) if starved(error) else main(kind, error, trace)

    def in_thread(args) -> None:
        if starved(args.exc_value):
            _end_starved(args.exc_value)
        elif not _over(args.exc_value):
            thread(args)

    def in_bare_thread(args) -> None:
        """rosgraph starts the thread of a node's XML-RPC server by ``_thread``; init_node waits for it for ever."""
        if starved(args.exc_value) and "thread" in (args.err_msg or ""):
            _end_starved(args.exc_value)
        ignored(args)

    sys.excepthook, threading.excepthook, sys.unraisablehook = in_main, in_thread, in_bare_thread


def _over(error: BaseException | None) -> bool:
    """A thread that published, or waited, while the node was shut down: the status timer of an action server, say."""
    rospy = sys.modules.get("rospy")
    if rospy is None or not isinstance(error, rospy.ROSException):
        return False
    return rospy.is_shutdown() or rospy.core.is_shutdown_requested()


def _notice_shutdown() -> None:
    import rospy

    rospy.core.add_shutdown_hook(lambda reason: _shut_down.set())  # after those of rospy itself; at once if it is over


def _on_signal(number, _frame) -> None:
    try:
        threading.Thread(target=_end, args=(number,), name="shutdown", daemon=True).start()
    except RuntimeError:  # no thread to be had
        os._exit(128 + number)


def _end(number: int) -> None:
    import rospy

    rospy.signal_shutdown(f"signal-{number}")
    _shut_down.wait()  # when another thread was quicker to ask
    main = threading.main_thread()
    main.join(_PATIENCE)
    if main.is_alive():
        _exit(128 + number)


def _exit(code: int) -> None:
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):  # whoever read it is gone
            pass
    os._exit(code)
