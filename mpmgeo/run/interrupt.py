"""Ctrl-C and SIGTERM as a question to stop, so that no step is cut in two."""

import signal


class Interrupt:
    """While active, the first SIGINT or SIGTERM sets `asked`; a second one acts as always."""

    def __init__(self):
        self.asked = False
        self._before = {}

    def _ask(self, *_):
        self.asked = True
        self._restore()

    def _restore(self):
        for name, handler in self._before.items():
            signal.signal(name, handler)
        self._before = {}

    def __enter__(self):
        for name in (signal.SIGINT, signal.SIGTERM):
            try:
                self._before[name] = signal.signal(name, self._ask)
            except ValueError:  # not in the main thread, where signals are not ours
                break
        return self

    def __exit__(self, *_):
        self._restore()
