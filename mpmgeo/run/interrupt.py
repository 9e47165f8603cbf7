"""Ctrl-C, SIGTERM and SIGHUP as a question to stop, so that no step is cut in two."""

import signal

from mpmgeo.run.terminal import Streams

HANGUP = getattr(signal, "SIGHUP", None)
"""What comes, often twice, when the terminal goes away; None where there is no such thing."""


def ending() -> list:
    """Return the signals that end a run beside Ctrl-C; SIGHUP unless it is ignored, by nohup."""
    hears = HANGUP is not None and signal.getsignal(HANGUP) != signal.SIG_IGN
    return [signal.SIGTERM, HANGUP] if hears else [signal.SIGTERM]


class Interrupt:
    """While active, the first of these signals sets `asked`; a second one acts as always.

    After SIGHUP further ones are ignored, and what is printed to a terminal that is gone is lost.
    """

    def __init__(self):
        self.asked = False
        self._before = {}
        self._streams = Streams()

    def _ask(self, number, _):
        self.asked = True
        if number == HANGUP:
            self._streams.hang_up()
        self._restore(but=number if number == HANGUP else None)

    def _restore(self, but=None):
        for number, handler in self._before.items():
            signal.signal(number, signal.SIG_IGN if number == but else handler)
        self._before = {but: self._before[but]} if but in self._before else {}

    def __enter__(self):
        for number in (signal.SIGINT, *ending()):
            try:
                self._before[number] = signal.signal(number, self._ask)
            except ValueError:  # not in the main thread, where signals are not ours
                break
        return self

    def __exit__(self, *_):
        self._restore()
