#!/usr/bin/env python3
"""Charts and the summary in words of what cloth_bench has measured.

    bench/plot_work_precision.py CSV_DIR [OUT_DIR] [--command TEXT]

reads runs.csv and scenes.csv of CSV_DIR and writes to OUT_DIR (default: CSV_DIR) SCENE.png, SCENE_details.png for each
scene, overview.png, spatial_error.png, stability_map.png, each also as .svg, and summary.md. CSV_DIR/runs.csv does for
CSV_DIR. The stability map, which depends on the methods alone, is that of stability_map.csv beside this program.
"""

import argparse
import os
import sys

import plot_stability_map
from work_precision import figures, pages, summary
from work_precision.runs import Malformed, read

STABILITY_MAP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stability_map.csv")


def main():
    arguments = parse()
    folder = os.path.dirname(arguments.csv) or "." if arguments.csv.endswith(".csv") else arguments.csv
    out = arguments.out or folder
    try:
        scenes, runs = read(folder)
    except Malformed as error:
        sys.exit("plot_work_precision: {}".format(error))
    os.makedirs(out, exist_ok=True)
    figures.set_style()
    for name, figure in pages.draw_all(scenes, runs):
        figures.save(figure, out, name)
    plot_stability_map.draw(STABILITY_MAP, os.path.join(out, "stability_map"))
    summary.write_summary(os.path.join(out, "summary.md"), scenes, runs, arguments.command)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", metavar="CSV_DIR")
    parser.add_argument("out", metavar="OUT_DIR", nargs="?")
    parser.add_argument("--command", default="cloth_bench", help="what the summary says the runs were made by")
    return parser.parse_args()


if __name__ == "__main__":
    main()
