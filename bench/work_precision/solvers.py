"""The solvers that are compared: which family each belongs to, its order, and how it is drawn."""

from collections import namedtuple

FAMILIES = ("explicit", "implicit", "constraint-based", "independent")
LINES = {"explicit": "-", "implicit": (0, (5, 1.5)), "constraint-based": (0, (4, 1.2, 1, 1.2)),
         "independent": (0, (1, 1.2))}

# order is that of the table of methods; None: it has none, or chooses it by itself.
Solver = namedtuple("Solver", "family order colour marker")

OURS = {
    "explicit_euler": Solver("explicit", 1, "#8a6bbf", "v"),
    "symplectic_euler": Solver("explicit", 1, "#2a9fd6", "^"),
    "velocity_verlet": Solver("explicit", 2, "#0b3c8c", "o"),
    "midpoint": Solver("explicit", 2, "#12a594", "s"),
    "rk4": Solver("explicit", 4, "#5a1e96", "D"),
    "dopri5": Solver("explicit", 5, "#3f6fb5", "P"),
    "implicit_euler": Solver("implicit", 1, "#e0701a", "v"),
    "implicit_midpoint": Solver("implicit", 2, "#c9a008", "s"),
    "tr_bdf2": Solver("implicit", 2, "#b3282d", "o"),
    "projective": Solver("constraint-based", 1, "#3d8b37", "X"),
    "xpbd": Solver("constraint-based", 1, "#c2298c", "*"),
}
KNOWN_INDEPENDENT = {
    "cvode_bdf": ("#111111", "o"),
    "cvode_adams": ("#666666", "s"),
    "bullet": ("#6b4423", "h"),
}
MORE_INDEPENDENT = (("#444444", "D"), ("#888888", "^"), ("#2f4f4f", "P"), ("#7a7a52", "X"), ("#555577", "v"))


def look_up(name, all_names):
    """Solvers outside our table are independent ones; `all_names` gives those not known here their places."""
    if name in OURS:
        return OURS[name]
    if name in KNOWN_INDEPENDENT:
        return Solver("independent", None, *KNOWN_INDEPENDENT[name])
    others = sorted(other for other in set(all_names) if other not in OURS and other not in KNOWN_INDEPENDENT)
    return Solver("independent", None, *MORE_INDEPENDENT[others.index(name) % len(MORE_INDEPENDENT)])


def is_ours(name):
    return name in OURS


def in_order(names):
    """As in the table of methods, then the independent ones by name."""
    table = list(OURS)
    return sorted(set(names), key=lambda name: (table.index(name) if name in OURS else len(table), name))
