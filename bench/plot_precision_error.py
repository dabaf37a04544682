#!/usr/bin/env python3
"""Draws what single precision adds to the error of xpbd, from the CSV of the program precision_error:

    precision_error errors.csv
    bench/plot_precision_error.py errors.csv docs/images/precision_error

writes docs/images/precision_error.png.
"""

import csv
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

IN_DOUBLES = "#c2298c"
MIXED = "#0b3c8c"
APART = "#8d9aa8"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(sys.argv[1], sys.argv[2])


def draw(csv_path, out):
    """Writes out.png."""
    sheets = read_errors(csv_path)
    figure, all_axes = plt.subplots(1, len(sheets), figsize=(3.2 * len(sheets), 3.6), sharex=True, sharey=True,
                                    squeeze=False, constrained_layout=True)
    for axes, (nodes, rows) in zip(all_axes[0], sheets.items()):
        draw_errors(axes, rows)
        axes.set_title("{0} x {0} nodes".format(nodes))
    all_axes[0][0].set_ylabel("distance from the exact motion, m")
    all_axes[0][0].legend(frameon=False)
    # Without a version the same errors give the same file.
    figure.savefig(out + ".png", dpi=150, metadata={"Software": None})
    plt.close(figure)


def draw_errors(axes, rows):
    substeps = [row["substep"] for row in rows]
    axes.plot(substeps, [row["apart"] for row in rows], ":", color=APART, label="from each other")
    axes.plot(substeps, [row["double"] for row in rows], "o-", color=IN_DOUBLES, markersize=5, label="in doubles")
    axes.plot(substeps, [row["mixed"] for row in rows], "s--", color=MIXED, markersize=3.5, label="mixed")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("substep, s")
    axes.grid(color="#e3e8ee", linewidth=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def read_errors(path):
    """A list of rows for every sheet, by its nodes a side."""
    sheets = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            nodes = int(row.pop("nodes_a_side"))
            sheets.setdefault(nodes, []).append({key: float(text) for key, text in row.items()})
    return sheets


if __name__ == "__main__":
    main()
