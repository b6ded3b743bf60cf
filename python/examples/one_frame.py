#!/usr/bin/env python3
"""Asks for the muscle forces behind one contour. Usage: one_frame.py FILE.csv

`genio serve` must run. Prints a line for each muscle that acts rather than not.
"""
import sys

from genio_client import Client, read_frames

frame = read_frames(sys.argv[1])[0]
with Client() as client:
    answer = client.invert(frame.points, **frame.options(), deadline_s=30)
print(f"{answer.status}: {answer.verdict} {answer.message}, RMS {answer.rms_mm:.2f} mm")
for name, muscle in answer.muscles.items():
    if muscle.acts > 0.5:
        print(f"{name:>8} {muscle.median_N:5.2f} N  "
              f"(90 %: {muscle.low_N:.2f} to {muscle.high_N:.2f} N)")
