"""Genio's own table of contours, as `genio invert --target` reads it too."""
import csv
import math
import os
from dataclasses import dataclass, field

from .errors import InvalidInput
from .request import Point, RequestOptions


@dataclass
class Frame:
    """The points of one moment: x, z or x, y, z each [mm]."""

    points: list[Point]
    kinds: list[str] = field(default_factory=list)  # empty: all "curve"
    sigma_mm: list[float] = field(default_factory=list)  # empty: the usual noise
    label: str = ""
    time_s: float = math.nan

    def options(self) -> RequestOptions:
        return {"kinds": self.kinds or None, "sigma_mm": self.sigma_mm or None,
                "label": self.label, "time_s": self.time_s}


def read_frames(path: str | os.PathLike[str]) -> list[Frame]:
    """Frames of a CSV file with the columns frame, x_mm, z_mm and perhaps y_mm, sigma_mm, kind,
    label, time_s; others are not read. Raises InvalidInput, which names the file and the line."""
    frames: dict[str, Frame] = {}
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            rows = csv.DictReader(file, restval="")
            missing = {"frame", "x_mm", "z_mm"} - set(rows.fieldnames or ())
            if missing:
                raise InvalidInput(f"{path}: no column {', '.join(sorted(missing))}")
            for row in rows:
                _add(row, frames.setdefault(row["frame"], Frame([])))
    except InvalidInput:
        raise
    except (OSError, UnicodeError, csv.Error) as error:
        raise InvalidInput(f"{path}: {error}") from None
    except ValueError as error:
        raise InvalidInput(f"{path}:{rows.line_num}: {error}") from None
    return list(frames.values())


def _add(row: dict[str, str], frame: Frame) -> None:
    y = row.get("y_mm") or "nan"
    frame.points.append((float(row["x_mm"]), float(y), float(row["z_mm"])))
    frame.kinds.append(row.get("kind") or "curve")
    frame.sigma_mm.append(float(row.get("sigma_mm") or 0))
    if len(frame.points) == 1:
        frame.label = row.get("label") or ""
        frame.time_s = float(row.get("time_s") or "nan")
