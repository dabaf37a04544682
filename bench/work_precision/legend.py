"""What the lines and markers mean."""

from matplotlib.lines import Line2D

from work_precision import failures, rankings, solvers, words
from work_precision.axes import FRONT, line_style


def add(axes, runs, all_names, two_columns=False, with_front=True, **style):
    """The solvers family by family, then what else is drawn."""
    explicit, implicit, constraints, independent = (family_handles(family, runs, all_names)
                                                    for family in solvers.FAMILIES)
    first = explicit + implicit
    second = constraints + independent + [blank()] + marks(runs, with_front)
    if two_columns:
        length = max(len(first), len(second))
        first, second = ([*half, *(blank() for _ in range(length - len(half)))] for half in (first, second))
    legend = axes.legend(handles=first + second, frameon=False, handlelength=3.2, labelspacing=0.28,
                         ncol=2 if two_columns else 1, columnspacing=1.0, **style)
    for text in legend.get_texts():
        if text.get_text() in solvers.FAMILIES:
            text.set_fontweight("bold")


def blank(label=" "):
    return Line2D([], [], linestyle="none", label=label)


def family_handles(family, runs, all_names):
    members = [key for key in rankings.ladders(runs) if solvers.look_up(key[0], all_names).family == family]
    return ([blank(family)] if members else []) + [solver_handle(*key, all_names) for key in members]


def solver_handle(name, setting, all_names):
    return Line2D([], [], label=name if setting == "step" else "{}, {}".format(name, setting),
                  **line_style(name, setting, all_names))


def marks(runs, with_front):
    front = [Line2D([], [], color=FRONT, linewidth=5.0, label="least cost (Pareto front)")] if with_front else []
    statuses = {run.status for run in runs}
    return front + [Line2D([], [], label=words.STATUS_WORDS[status], **failures.marker_style(status, "#555555"))
                    for status in failures.MARKERS if status in statuses]
