"""What may be sent to a terminal, and what happens to messages when it is gone."""

import os
import re

CONTROLS = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]")  # all but the end of a line


def without_controls(text: str) -> str:
    """Return a text in which nothing steers a terminal: its control characters are spelled out."""
    return CONTROLS.sub(lambda found: f"\\x{ord(found[0]):02x}", text)


class Streams:
    """Standard output and error: those that were a terminal are silenced when it has hung up."""

    def __init__(self):
        self.terminals = [number for number in (1, 2) if os.isatty(number)]

    def hang_up(self):
        """Let what is printed go nowhere if the terminal is gone, for it would be an error."""
        for number in self.terminals:
            if not os.isatty(number):
                nowhere = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nowhere, number)
                os.close(nowhere)
