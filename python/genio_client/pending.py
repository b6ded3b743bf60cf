"""What was asked and is not over yet."""
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from .answer import Answer, Progress

PAUSES_S = (1.0, 8.0)  # before asking again: the first, and the longest


@dataclass
class Pending:
    """A message that is sent again after 1, 2, 4 and then every 8 s, until `answer` is there."""

    id: str
    channel: str
    message: bytes
    progress: Callable[[Progress], None] | None = None
    answer: Answer | None = None
    refusal: Answer | None = None  # that holds until ask_at
    refusals: int = 0
    ask_at: float = field(default_factory=time.monotonic)
    pause_s: float = field(default_factory=lambda: PAUSES_S[0])

    def ask_now(self) -> None:
        """As if it had never been sent."""
        self.ask_at, self.pause_s = time.monotonic(), PAUSES_S[0]

    def was_sent(self) -> None:
        self.refusal = None
        self.ask_at = time.monotonic() + self.pause_s
        self.pause_s = min(2 * self.pause_s, PAUSES_S[1])

    def was_refused(self, answer: Answer) -> None:
        """The refusal says when to ask again."""
        self.refusal = answer
        self.ask_at, self.pause_s = time.monotonic() + answer.retry_after_s, PAUSES_S[0]
