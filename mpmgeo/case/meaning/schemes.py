"""Schemes and shapes that do not go together."""

LINEAR_LAST = (
    '"linear" with the scheme USL diverges in plain cases, such as a block that falls, whatever '
    "the time step: nodes that a particle just reaches are too light; "
    '"stress_scheme_update": "MUSL" mends it'
)


def check_schemes(draft, report):
    """Warn of a shape whose nodes the scheme does not hold."""
    case = draft.whole.values
    if case.get("shape_function") == "linear" and case.get("stress_scheme_update") == "USL":
        report.warn(("shape_function",), LINEAR_LAST)
