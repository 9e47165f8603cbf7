"""What `"method": "recommended"` says: choices of the method that a case leaves open."""

RECOMMENDED = {
    "shape_function": "cubic-bspline",
    "stress_scheme_update": "USL",
    "transfer": {"type": "tpic"},
    "particle_domain": "initial",
    "volumetric_locking": "off",
}
"""What the manual's page on which method to use comes to."""

FOR_TWO_PHASES = RECOMMENDED | {"transfer": {"type": "flip"}}
"""The same where other transfers are refused."""


def fill_method(tree):
    """Write into the tree of a case what its method says and it does not say itself."""
    if tree.get("method") == "recommended":
        chosen = FOR_TWO_PHASES if tree.get("n_phases") == 2 else RECOMMENDED
        for key, value in chosen.items():
            tree.setdefault(key, value)
