#!/usr/bin/env python3
"""Whether two runs of a corpus give the same. Usage: same_corpus.py ONE/results.csv OTHER/results.csv

Each frame stands once in both, with the same status and verdict, and with forces that differ by a
tenth of their standard deviation at most, or a five-hundredth of their maximum: a task that was
stopped starts its next frame elsewhere.
Prints what is the same, to the byte or in that sense; else names the frames and fails.
"""
import csv
import sys


def rows(path):
    table, twice = {}, []
    for row in csv.DictReader(open(path, newline="")):
        key = row["recording"], int(row["frame"])
        if key in table:
            twice.append(key)
        table[key] = row
    return table, twice


def differs(a, b):
    if any(a[c] != b[c] for c in ("file", "speaker", "label", "take", "status", "verdict")):
        return True
    for column in a:
        posterior = ("_sd_N", "_median_N", "_low90_N", "_high90_N")
        if not column.endswith("_N") or column.endswith(posterior) or a[column] == b[column]:
            continue
        sd = float(a[column.replace("_N", "_sd_N")] or 0)
        if "" in (a[column], b[column]):
            return True
        activation = column.replace("_N", "_activation")
        if abs(float(a[activation] or 0) - float(b[activation] or 0)) < 2e-3:
            continue
        if abs(float(a[column]) - float(b[column])) > 0.1 * sd + 1e-6:
            return True
    return False


def main():
    (one, twice_one), (other, twice_other) = rows(sys.argv[1]), rows(sys.argv[2])
    twice = twice_one + twice_other
    missing = sorted(one.keys() ^ other.keys())
    different = [key for key in one.keys() & other.keys() if differs(one[key], other[key])]
    exact = sum(one[key] == other[key] for key in one.keys() & other.keys())
    print(f"{len(one)} frames, {exact} the same to the last digit, {len(different)} different,"
          f" {len(missing)} missing, {len(twice)} twice")
    for what, keys in (("different", different), ("missing", missing), ("twice", twice)):
        for key in keys[:10]:
            print(f"{what}: {key[0]} frame {key[1]}")
    return 1 if twice or missing or different else 0


sys.exit(main())
