"""What plain MPM cannot do, in numbers: the figures of manual/limits.md.

python benchmarks/limits.py [layers] [bar] [spin] [linear] [flight]
"""

import itertools
import sys
import warnings

import mpmgeo
from mpmgeo.run.watch import Diverged
from mpmgeo.verify import limits

SCHEMES = ("USL", "MUSL", "USF")
OFFSETS = (0.0, 0.013)  # m


def keys(scheme, shape):
    return {"stress_scheme_update": scheme, "shape_function": shape}


def layers():
    """Print the error of stress for ratios of stiffness."""
    for scheme, shape in (("USL", "GIMP"), ("MUSL", "GIMP"), ("MUSL", "linear")):
        for stiff in ("lower", "upper"):
            for ratio in (1, 10, 100, 1e3, 1e4):
                case = limits.layers(ratio, stiff, **keys(scheme, shape))
                error = limits.error_in_layers(mpmgeo.Simulation(case).run())
                print(f"{scheme} {shape}, stiff {stiff}, {ratio:g}: ", end="")
                print(", ".join(f"{e:.3f} {layer}" for layer, e in error.items()), flush=True)


def bar():
    """Print the share of stress for strains."""
    for count in (1, 2, 3):
        for scheme, shape in (("USL", "GIMP"), ("MUSL", "GIMP"), ("MUSL", "linear")):
            simulation = mpmgeo.Simulation(limits.bar(count, **keys(scheme, shape)))
            _draw(simulation, (0.04, 0.08, 0.15, 0.2, 0.3, 0.5, 0.7), f"{shape}, {count} a cell")
    for domain, schemes in (("initial", SCHEMES), ("updated", ("USL", "MUSL"))):
        for scheme, count in itertools.product(schemes, (2, 3)):
            more = {"stress_scheme_update": scheme, "particle_domain": domain, "time": 6}
            simulation = mpmgeo.Simulation(limits.bar(count, **more))
            _draw(simulation, (0.2, 0.4, 0.6, 0.8, 1.0), f"{domain}, {count} a cell")


def _draw(simulation, strains, name):
    shares = []
    for strain in strains:
        share = limits.share_of_stress(simulation.run(until=strain / 0.2))
        shares.append(f"{share:.3f} at {strain:g}")
    print(f"{simulation.case.stress_scheme_update} {name}: {', '.join(shares)}", flush=True)


def spin():
    """Print the share of angular momentum after half a turn, one and three."""
    plain = [(s, f, 2, 1) for f in ("GIMP", "linear") for s in SCHEMES]
    for scheme, shape, count, fine in (*plain, ("USL", "GIMP", 4, 1), ("USL", "GIMP", 2, 2)):
        case = limits.square(fine=fine, **keys(scheme, shape))
        case["body"][0]["particles_per_direction"] = 3 * [count]
        simulation = mpmgeo.Simulation(case)
        start, shares = limits.spin(simulation), []
        try:
            for turns in (0.5, 1, 3):
                simulation.run(until=turns * case["time"] / 3)
                shares.append(f"{limits.angular_momentum(simulation) / start:.2f}")
        except Diverged:
            shares.append("diverged")
        print(f"{scheme} {shape}, {count} along an edge, {4 * fine} cells: ", *shares, flush=True)


def linear():
    """Print when USL with linear diverges: a block that falls on a floor, a square that spins."""
    for share in (0.5, 0.25, 0.1, 0.05, 0.02):
        more = {"critical_time_step_multiplier": share, **keys("USL", "linear")}
        falling = {f"falls, {offset:g} m off": limits.block(offset, **more) for offset in OFFSETS}
        for name, case in (falling | {"spins": limits.square(**more)}).items():
            simulation = mpmgeo.Simulation(case)
            if name == "spins":
                limits.spin(simulation)
            try:
                simulation.run()
                end = f"runs for {simulation.time:.3g} s"
            except Diverged:
                end = f"diverges after {simulation.time:.3g} s"
            print(f"USL linear, {share:g} of the critical step, {name}: {end}", flush=True)


def flight():
    """Print by how much the vibration of a cube in flight has grown, and when the guard tells."""
    plain = [(scheme, share, 0.5, 2) for scheme in SCHEMES for share in (0, 0.1, 0.3, 0.9)]
    smaller = [("MUSL", 0.3, step, 2) for step in (0.9, 0.25, 0.1)]
    layouts = [("MUSL", 0.3, 0.5, count) for count in (1, 3, 4)]
    for scheme, share, step, count in plain + smaller + layouts:
        more = {"critical_time_step_multiplier": step, "stress_scheme_update": scheme}
        simulation = mpmgeo.Simulation(limits.flight(share, count, **more))
        start, heard = limits.vibrate(simulation), limits.Heard()
        simulation.run(watchers=[heard])
        grown = (limits.vibration(simulation) / start) ** 0.5
        told = "" if heard.at is None else f", told at {(heard.at / start) ** 0.5:.2g}"
        print(
            f"{scheme}, {share:g} c, step {step:g}, {count} an edge: {grown:.3g}{told}", flush=True
        )


if __name__ == "__main__":
    warnings.simplefilter("ignore", mpmgeo.CaseWarning)
    for name in sys.argv[1:] or ("layers", "bar", "spin", "linear", "flight"):
        globals()[name]()
