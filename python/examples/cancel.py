#!/usr/bin/env python3
"""Sends a request and withdraws it. Usage: cancel.py FILE.csv

`genio serve` must run. Only the client that asked may withdraw.
"""
import sys

from genio_client import Client, read_frames

with Client() as client:
    id = client.ask(read_frames(sys.argv[1])[0].points, starts=200)
    answer = client.cancel(id)
print(f"{answer.status}: {answer.message}")
