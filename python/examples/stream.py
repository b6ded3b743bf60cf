#!/usr/bin/env python3
"""Sends the frames of a recording and prints the answers in order. Usage: stream.py FILE.csv

`genio serve` must run. Each frame is computed from the answer to the one before.
"""
import sys

from genio_client import Client, read_frames

with Client() as client:
    stream = client.stream("word")
    for frame in read_frames(sys.argv[1]):
        stream.send(frame)
    for answer in stream:
        acting = ", ".join(f"{name} {muscle.median_N:.2f} N"
                           for name, muscle in answer.muscles.items() if muscle.acts > 0.5)
        print(f"{answer.time_s:.3f} s: {answer.status}, {acting}")
