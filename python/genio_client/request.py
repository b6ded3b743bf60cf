"""From points to a request message. Model frame: x backwards (tip to root), y to the speaker's
right, z up; millimetres."""
import math
import numbers
import pathlib
from collections.abc import Sequence
from typing import Any, TypedDict

from . import wire
from .errors import InvalidInput
from .messages import shape_request_t

Point = Sequence[float]  # x, z or x, y, z [mm]


class RequestOptions(TypedDict, total=False):
    """What a request may say besides its points. messages/shape_request_t.lcm has every field."""

    kinds: str | Sequence[str] | None  # "curve" (the usual), "surface", or a flesh point: "tip"
    sigma_mm: float | Sequence[float] | None  # noise, of all points or of each [mm]
    model: str  # that is to answer; the server's first unless given
    prior: str | pathlib.Path  # TOML as in docs/inversion.md: the text, or the file that holds it
    label: str  # comes back with the answer
    time_s: float | None  # of the frame; comes back with the answer
    priority: int  # -10 to 10; higher ones come first
    deadline_s: float  # from the arrival; the best answer so far comes then. 0: none
    bilateral: bool | None  # left and right together or apart; None: as the points allow
    starts: int  # descents, to find other answers that fit; 0: until the shape is explained
    palate: Sequence[Point] | None  # the points are in a device's frame; its palate trace, x, z
    placed: Sequence[float] | None  # likewise, and laid before: an earlier answer's `placed`


def make_request(points: Sequence[Point], *, kinds: str | Sequence[str] | None = None,
                 sigma_mm: float | Sequence[float] | None = None, model: str = "",
                 prior: str | pathlib.Path = "", label: str = "", time_s: float | None = None,
                 priority: int = 0, deadline_s: float = 0.0, bilateral: bool | None = None,
                 starts: int = 0, palate: Sequence[Point] | None = None,
                 placed: Sequence[float] | None = None) -> Any:
    """A shape_request_t without id, client, stream and time. Raises InvalidInput, which names the
    argument, for what cannot be written into the message; what it means is the server's to say."""
    request = shape_request_t()
    xyz = [_point(p, f"point {k}", (2, 3)) for k, p in enumerate(points, 1)]
    request.point_count = _count(xyz, "points")
    request.x_mm, request.y_mm, request.z_mm = ([p[i] for p in xyz] for i in range(3))
    request.kind = [_text(k, "kinds") for k in _of_each("kinds", kinds, "curve", len(xyz))]
    request.sigma_mm = [_number(s, "sigma_mm")
                        for s in _of_each("sigma_mm", sigma_mm, 0.0, len(xyz))]
    request.model, request.label = _text(model, "model"), _text(label, "label")
    request.prior = _text(_prior(prior), "prior")
    request.time_s = math.nan if time_s is None else _number(time_s, "time_s")
    request.deadline_s = _number(deadline_s, "deadline_s")
    request.priority, request.starts = _integer(priority, "priority"), _integer(starts, "starts")
    request.bilateral = -1 if bilateral is None else int(bool(bilateral))
    if palate is not None and placed is not None:
        raise InvalidInput("palate and placed: expected one of them, or neither")
    if palate is not None:
        trace = [_point(p, f"palate point {k}", (2,)) for k, p in enumerate(palate, 1)]
        request.frame, request.palate_count = "device", _count(trace, "palate")
        request.palate_x_mm, request.palate_z_mm = [p[0] for p in trace], [p[2] for p in trace]
    elif placed is not None:
        request.frame = "placed"
        if len(placed) not in (4, 6):
            raise InvalidInput("placed: expected scale, tilt_deg, shift_x_mm and shift_z_mm, and "
                               "if they are not known exactly shift_sd_mm and tilt_sd_deg")
        (request.scale, request.tilt_deg, request.shift_x_mm, request.shift_z_mm,
         request.shift_sd_mm, request.tilt_sd_deg) = (
             _number(v, "placed") for v in (*placed, 0.0, 0.0)[:6])
    return request


def encode_request(request: Any) -> bytes:
    """Raises InvalidInput for a request that is too large for the service."""
    try:
        return wire.encode(request)
    except ValueError as error:
        raise InvalidInput(f"the request: {error}") from None


def _point(point: Point, what: str, sizes: tuple[int, ...]) -> tuple[float, float, float]:
    """x, y, z; y is NaN where it was not given."""
    try:
        numbers_ = [float(v) for v in point]
    except (TypeError, ValueError, OverflowError):
        numbers_ = []
    if len(numbers_) not in sizes:
        expected = " or ".join("x, z" if n == 2 else "x, y, z" for n in sizes)
        raise InvalidInput(f"{what}: expected {expected} in mm, and got {str(point)[:60]}")
    return numbers_[0], numbers_[1] if len(numbers_) == 3 else math.nan, numbers_[-1]


def _of_each(what: str, given: Any, usual: Any, count: int) -> Sequence[Any]:
    if given is None or isinstance(given, (str, numbers.Real)):
        return [usual if given is None else given] * count
    values = list(given)
    if len(values) != count:
        raise InvalidInput(f"{what}: {len(values)} for {count} points; expected one each")
    return values


def _count(values: Sequence[Any], what: str) -> int:
    if len(values) > wire.MAX_ARRAY_LENGTH:
        raise InvalidInput(f"{what}: {len(values)}; expected at most {wire.MAX_ARRAY_LENGTH}")
    return len(values)


def _number(value: Any, what: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise InvalidInput(f"{what}: expected a number, and got {str(value)[:60]}") from None


def _integer(value: Any, what: str) -> int:
    if not isinstance(value, numbers.Integral) or not -(2**31) <= value < 2**31:
        raise InvalidInput(f"{what}: expected a whole number, and got {str(value)[:60]}")
    return int(value)


def _text(value: Any, what: str) -> str:
    if not isinstance(value, str) or "\0" in value:
        raise InvalidInput(f"{what}: expected a text without zeros, and got {str(value)[:60]!r}")
    try:
        size = len(value.encode())
    except UnicodeEncodeError:
        raise InvalidInput(f"{what}: the text cannot be written as UTF-8") from None
    if size > wire.MAX_STRING_BYTES:
        raise InvalidInput(f"{what}: {size} bytes; expected at most {wire.MAX_STRING_BYTES}")
    return value


def _prior(prior: str | pathlib.Path) -> str:
    if not isinstance(prior, pathlib.Path):
        return prior
    try:
        return prior.read_text(encoding="utf-8")
    except (OSError, UnicodeError) as error:
        raise InvalidInput(f"prior {prior}: {error}") from None
