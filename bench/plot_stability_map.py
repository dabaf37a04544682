#!/usr/bin/env python3
"""Draws the stability map from the CSV that the program stability_map (make stability_map) writes in half a minute:

    stability_map bench/stability_map.csv
    bench/plot_stability_map.py bench/stability_map.csv docs/images/stability_map

writes docs/images/stability_map.png and .svg.
"""

import csv
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

MEASURED = "#b3282d"
PREDICTED = "#1f4e79"
STABLE = "#dce8f3"
COLUMNS = 3


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(sys.argv[1], sys.argv[2])


def draw(csv_path, out):
    """Writes out.png and out.svg."""
    methods = read_map(csv_path)
    limited = {name: rows for name, rows in methods.items() if is_limited(rows)}
    unlimited = [name for name in methods if name not in limited]

    set_style()
    lines = -(-len(limited) // COLUMNS)
    figure = plt.figure(figsize=(9.0, 1.96 + 2.82 * lines), constrained_layout=True)
    grid = figure.add_gridspec(lines + 1, COLUMNS, height_ratios=[1.0] * lines + [0.7])
    draw_maps(figure, grid, limited, lines)
    draw_ratios(figure.add_subplot(grid[lines, :2]), limited)
    name_unlimited(figure.add_subplot(grid[lines, 2]), unlimited)
    for ending in ("png", "svg"):
        # Without date and version the same map gives the same file.
        metadata = {"Date": None, "Creator": None} if ending == "svg" else {"Software": None}
        figure.savefig("{}.{}".format(out, ending), dpi=150, metadata=metadata)
    plt.close(figure)


def read_map(path):
    """A list of rows for every method, in the order of the file."""
    methods = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            name = row.pop("method")
            methods.setdefault(name, []).append({key: number(text) for key, text in row.items()})
    return methods


def number(text):
    return float(text.replace(".inf", "inf")) if text else float("nan")


def is_limited(rows):
    return any(row["measured"] < float("inf") or row["predicted"] < float("inf") for row in rows)


def column(rows, key):
    return [row[key] for row in rows]


def set_style():
    plt.rcdefaults()
    plt.rcParams.update({
        "font.size": 9,
        "axes.titlesize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "svg.hashsalt": "stability_map",
    })


def draw_maps(figure, grid, limited, lines):
    highest = 1.06 * max(max(column(rows, "measured")) for rows in limited.values())
    first = None
    for place, (name, rows) in enumerate(limited.items()):
        axes = figure.add_subplot(grid[place // COLUMNS, place % COLUMNS], sharex=first, sharey=first)
        first = first or axes
        ratios = column(rows, "zeta")
        predicted = column(rows, "predicted")
        axes.fill_between(ratios, predicted, color=STABLE, linewidth=0)
        axes.plot(ratios, predicted, color=PREDICTED, linewidth=1.4, label="predicted")
        axes.plot(ratios, column(rows, "measured"), "o", color=MEASURED, markersize=3.2, label="measured",
                  clip_on=False, zorder=3)
        axes.set_title(name)
        axes.set_xlim(0.0, 2.0)
        axes.set_ylim(0.0, highest)
        axes.tick_params(labelleft=place % COLUMNS == 0, labelbottom=place // COLUMNS == lines - 1)
        if place % COLUMNS == 0:
            axes.set_ylabel(r"longest stable step  $z = \omega h$")
        if place // COLUMNS == lines - 1:
            axes.set_xlabel(r"damping ratio  $\zeta$")
    first.text(1.0, 0.22, "stable", color=PREDICTED, ha="center")
    first.legend(frameon=False, loc="upper right")


def draw_ratios(axes, limited):
    points = [(row["zeta"], row["ratio"]) for rows in limited.values() for row in rows if row["predicted"] > 0.0]
    farthest = max(abs(ratio - 1.0) for _, ratio in points)
    axes.axhspan(0.98, 1.02, color=STABLE, linewidth=0)
    axes.axhline(1.0, color=PREDICTED, linewidth=1.4)
    axes.plot(*zip(*points), "o", color=MEASURED, markersize=3.2)
    axes.text(1.98, 1.0165, "within 2 %", color=PREDICTED, ha="right", va="center")
    axes.text(0.02, 1.0055, "all methods above, {} points; the farthest is {:.2f} % off".format(
        len(points), 100.0 * farthest), color=MEASURED, va="center")
    axes.set_xlim(-0.02, 2.02)
    axes.set_ylim(0.97, 1.03)
    axes.set_xlabel(r"damping ratio  $\zeta$")
    axes.set_ylabel("measured / predicted")


def name_unlimited(axes, names):
    axes.axis("off")
    axes.text(0.0, 0.97, "No limit found up to $z = 1000$,\nand none predicted:", transform=axes.transAxes, va="top")
    axes.text(0.06, 0.68, "\n".join(names), transform=axes.transAxes, va="top", color=PREDICTED, linespacing=1.5)


if __name__ == "__main__":
    main()
