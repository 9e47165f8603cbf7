"""Which outputs of a run come before a state of it."""


def earlier(outputs: list[tuple], time: float, is_due: bool) -> list[tuple]:
    """Return the outputs, whose first members are times, that a run has made when it is at `time`.

    The first output is that of the initial state. `is_due`: whether there is one at `time`; if not,
    one that a run made there because it was interrupted does not count.
    """
    return [
        output
        for number, output in enumerate(outputs)
        if output[0] < time or (output[0] == time and (is_due or number == 0))
    ]
