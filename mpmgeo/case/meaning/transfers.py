"""What the transfers of velocity do not go with."""

from mpmgeo.mpm.schemes import SCHEMES, Newmark
from mpmgeo.values import shown

STEEP = (
    '"linear" does not go with {}: on the face of a cell its slopes belong to nodes of no weight; '
    "accepted: any other shape"
)


def check_transfers(draft, report):
    """Report a transfer other than plain FLIP together with what knows FLIP only."""
    case = draft.whole.values
    for part in draft.of("transfer"):
        transfer = part.made
        if transfer is None or transfer.symbols is None:
            continue
        if case.get("compatibility") is not None:
            message = "MPM-Geomechanics knows plain FLIP only; leave it or compatibility out"
            report.error(part.path, message)
        if case.get("n_phases") == 2:
            report.error(part.path, 'two phases go with "flip" alone, all of it; leave it out')
        if isinstance(SCHEMES.get(case.get("stress_scheme_update")), Newmark):
            scheme = shown(case["stress_scheme_update"])
            report.error(part.path, f'{scheme} goes with "flip" alone, all of it; leave it out')
        if transfer.is_affine and case.get("shape_function") == "linear":
            report.error(("shape_function",), STEEP.format(shown(transfer.type)))
