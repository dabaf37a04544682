#!/usr/bin/env python3
"""The table of docs/performance.md: nanoseconds a spring and step, and in parts of the plain loop's time.

usage: step_cost_table.py STEP_COST [--repetitions 20] [--filter REGEX]

STEP_COST is the program that `scripts/setup step_cost` builds. All cases of a size take turns, in an order shuffled
anew for each repetition, and the best of the repetitions counts: what else runs on the machine only makes it slower.
"""

import argparse
import json
import subprocess
import sys


def measure(program, repetitions, chosen):
    command = [
        program,
        f"--benchmark_filter={chosen}",
        f"--benchmark_repetitions={repetitions}",
        "--benchmark_enable_random_interleaving=true",
        "--benchmark_min_time=0.02",
        "--benchmark_format=json",
    ]
    runs = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["benchmarks"]
    best = {}
    for run in runs:
        if run["run_type"] == "iteration":
            case, size = run["run_name"].rsplit("/real_time", 1)[0].rsplit("/", 1)
            key = case, int(size)
            best[key] = min(best.get(key, float("inf")), 1e9 * run["a_spring"])
    return best


def print_table(best):
    sizes = sorted({size for _, size in best})
    cases = sorted({case for case, _ in best}, key=lambda case: (case != "plain", case))
    print("| case | " + " | ".join(f"{size} x {size}" for size in sizes) + " |")
    print("|---|" + "---|" * len(sizes))
    for case in cases:
        cells = []
        for size in sizes:
            time = best.get((case, size))
            plain = best.get(("plain", size))
            cells.append("-" if time is None else f"{time:.2f}" + (f" ({time / plain:.2f})" if plain else ""))
        print(f"| {case} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--repetitions", type=int, default=20)
    parser.add_argument("--filter", default=".")
    arguments = parser.parse_args()
    print_table(measure(arguments.program, arguments.repetitions, arguments.filter))


if __name__ == "__main__":
    sys.exit(main())
