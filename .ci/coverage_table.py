#!/usr/bin/env python3
"""What of each folder the tests have run, as a table.

usage: coverage_table.py REPORT.csv [--files N]

REPORT.csv is what `gcovr --csv` writes, a row a file. Prints a row a folder, with lines and branches that were taken at least once, and with
--files the N files with most lines that never were.
"""
import argparse
import collections
import csv
import pathlib


def share(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "none"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=0)
    options = parser.parse_args()
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    files = []
    with options.report.open(newline="") as report:
        for row in csv.DictReader(report):
            counts = [int(row[key]) for key in ("line_total", "line_covered", "branch_total", "branch_covered")]
            path = pathlib.PurePosixPath(row["filename"])
            files.append((counts[0] - counts[1], path, counts))
            for folder in (str(path.parent), "all"):
                folders[folder] = [a + b for a, b in zip(folders[folder], counts)]
    print("| folder | lines | run | branches | taken |\n|---|---|---|---|---|")
    for folder, (lines, run, branches, taken) in sorted(folders.items(), key=lambda f: (f[0] == "all", f[0])):
        print(f"| {folder} | {lines} | {share(run, lines)} | {branches} | {share(taken, branches)} |")
    for never, path, (lines, run, _, _) in sorted(files, key=lambda f: (-f[0], f[1]))[:options.files]:
        print(f"{never:5} of {lines:5} lines never run: {path}")


if __name__ == "__main__":
    main()
