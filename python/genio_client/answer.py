"""What the service answers, as plain values."""
import json
import math
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Muscle:
    """One muscle's force [N]. What was not computed is NaN."""

    best_N: float  # of the best fit
    median_N: float
    mean_N: float
    sd_N: float
    low_N: float  # 90 % interval
    high_N: float
    acts: float  # probability that it acts at all
    max_force_N: float  # that it can have
    information_bits: float  # that the points told


@dataclass(frozen=True)
class Estimate:
    """Something else that was estimated along, in its own unit."""

    value: float
    sd: float
    low: float  # 90 % interval
    high: float
    unit: str


@dataclass(frozen=True)
class Either:
    """Muscles of which one acts, though each may rest."""

    muscles: tuple[str, ...]
    acts: float  # probability
    low_N: float  # 90 % interval of their sum
    high_N: float


@dataclass(frozen=True)
class Alternative:
    """Another answer that fits."""

    weight: float  # its share of the posterior
    rms_mm: float
    forces_N: dict[str, float]


@dataclass(frozen=True)
class Answer:
    """`status`: "converged", "deadline", "cancelled", "failed" or "refused"; `message` says why.
    `verdict`: "explained", "unreachable", "mismatch" or "none"."""

    id: str
    status: str
    verdict: str
    message: str
    muscles: dict[str, Muscle]
    line: list[tuple[float, float]]  # predicted midsagittal line, x and z [mm]
    rms_mm: float
    max_mm: float
    chi2_per_dof: float
    unidentified: list[list[str]]  # muscles that the points cannot tell apart
    either: list[Either]
    others: dict[str, Estimate]
    alternatives: list[Alternative]  # likeliest first
    registration: dict[str, Any]  # of points in a device's frame; docs/service.md
    placed: tuple[float, ...] | None  # for further requests of that device; None: of no device
    label: str
    time_s: float
    wall_s: float  # that the computation took
    waited_s: float  # until it began
    retry_after_s: float  # of what was refused: when to ask again; 0: never the same
    raw: Any = field(repr=False)  # the command_reply_t

    @property
    def converged(self) -> bool:
        return self.status == "converged"

    @property
    def forces_N(self) -> dict[str, float]:
        """The best fit alone."""
        return {name: muscle.best_N for name, muscle in self.muscles.items()}


@dataclass(frozen=True)
class Progress:
    id: str
    stage: str  # "queued": the request was taken, and stands in the journal if there is one
    iteration: int
    rms_mm: float  # best so far


@dataclass(frozen=True)
class Status:
    """What a server does. Counts are since its start."""

    version: str
    models: dict[str, str]  # names, the first being the usual one, with the hashes of their files
    queued: int
    running: int
    workers: int
    uptime_s: float
    raw: Any = field(repr=False)  # the server_status_t, which has all counts


def answer_of(reply: Any) -> Answer:
    """From a command_reply_t that wire.decode gave."""
    r = reply
    muscles = {
        r.muscle[i]: Muscle(best_N=r.force_N[i], median_N=r.median_N[i], mean_N=r.mean_N[i],
                            sd_N=r.sd_N[i], low_N=r.low_N[i], high_N=r.high_N[i], acts=r.acts[i],
                            max_force_N=r.max_force_N[i], information_bits=r.information_bits[i])
        for i in range(r.muscle_count)}
    return Answer(
        id=r.id, status=r.status, verdict=r.verdict, message=r.message, muscles=muscles,
        line=list(zip(r.line_x_mm, r.line_z_mm)), rms_mm=r.rms_mm, max_mm=r.max_mm,
        chi2_per_dof=r.chi2_per_dof, unidentified=[names.split("+") for names in r.unidentified],
        either=[Either(tuple(names.split("+")), acts, low, high) for names, acts, low, high
                in zip(r.either, r.either_acts, r.either_low_N, r.either_high_N)],
        others={r.other[i]: Estimate(r.other_value[i], r.other_sd[i], r.other_low[i],
                                     r.other_high[i], r.other_unit[i])
                for i in range(r.other_count)},
        alternatives=[
            Alternative(r.alternative_weight[k], r.alternative_rms_mm[k],
                        dict(zip(r.muscle, r.alternative_force_N[k * r.muscle_count:])))
            for k in range(r.alternative_count)],
        registration=_registration(r.registration), placed=_placed(r), label=r.label,
        time_s=r.time_s, wall_s=r.wall_s, waited_s=r.waited_s, retry_after_s=r.retry_after_s, raw=r)


def progress_of(progress: Any) -> Progress:
    return Progress(progress.id, progress.stage, progress.iteration, progress.rms_mm)


def status_of(status: Any) -> Status:
    return Status(version=status.version, models=dict(zip(status.model, status.model_hash)),
                  queued=status.queued, running=status.running, workers=status.workers,
                  uptime_s=status.uptime_s, raw=status)


def wants_another_try(reply: Any) -> bool:
    """A refusal that holds for some time only, such as a full queue."""
    return reply.status == "refused" and 0 < reply.retry_after_s < math.inf


def _placed(r: Any) -> tuple[float, ...] | None:
    numbers = (r.scale, r.tilt_deg, r.shift_x_mm, r.shift_z_mm, r.shift_sd_mm, r.tilt_sd_deg)
    return numbers if r.registration and all(map(math.isfinite, numbers)) else None


def _registration(text: str) -> dict[str, Any]:
    try:
        value = json.loads(text) if text else {}
    except (ValueError, RecursionError):
        return {}
    return value if isinstance(value, dict) else {}
