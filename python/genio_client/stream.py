"""Frames of one recording, sent one after another."""
import time
from collections import deque
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Unpack

from .answer import Answer
from .errors import InvalidInput
from .frames import Frame
from .request import Point, RequestOptions

if TYPE_CHECKING:
    from .client import Client


class Stream:
    """Sends frames and gives their answers in the order of sending. Frames of the same client and
    stream are computed in order, each from the answer to the one before.

        stream = client.stream("word")
        for frame in frames:
            stream.send(frame)
        for answer in stream:
            print(answer.label, answer.forces_N)
    """

    def __init__(self, client: "Client", name: str, ahead: int, timeout_s: float,
                 options: RequestOptions):
        """Use Client.stream()."""
        if not name:
            raise InvalidInput("stream: expected a name")
        if ahead < 1:
            raise InvalidInput(f"ahead: expected 1 or more, and got {ahead}")
        self.name = name
        self._client, self._exchange = client, client._exchange
        self._ahead, self._timeout_s, self._options = ahead, timeout_s, options
        self._ids: deque[str] = deque()  # in the order of sending, until their answers are taken

    def send(self, frame: Frame | Sequence[Point], **options: Unpack[RequestOptions]) -> str:
        """Sends a frame and returns its id. Waits while `ahead` frames are without an answer;
        raises NoReply, and sends nothing, when that lasts longer than `timeout_s`."""
        until = time.monotonic() + self._timeout_s
        while self._on_the_way() >= self._ahead:
            self._client._wait(until, f"stream '{self.name}': no reply within {self._timeout_s:g} s"
                               f", and {self._ahead} frames are on their way")
        own: RequestOptions = frame.options() if isinstance(frame, Frame) else {}
        points = frame.points if isinstance(frame, Frame) else frame
        id = self._client.ask(points, stream=self.name, **{**self._options, **own, **options})
        self._ids.append(id)
        return id

    def __len__(self) -> int:
        """Frames whose answers were not taken yet."""
        return len(self._ids)

    def __iter__(self) -> Iterator[Answer]:
        return self

    def __next__(self) -> Answer:
        """The next answer in the order of sending. It ends when those of all frames were taken, and
        goes on after further ones are sent. Raises NoReply after `timeout_s`; the frame stays the
        next one then, so that it can be waited for again, or skipped with skip()."""
        if not self._ids:
            raise StopIteration
        answer = self._client.answer(self._ids[0], timeout_s=self._timeout_s)
        self._ids.popleft()
        return answer

    def arrived(self) -> list[Answer]:
        """The answers, in order, that can be had without waiting."""
        self._exchange.look()
        answers = []
        while self._ids and self._exchange.is_over(self._ids[0]):
            answers.append(next(self))
        return answers

    def skip(self) -> None:
        """Gives up the answer to the next frame."""
        if self._ids:
            self._client.forget(self._ids.popleft())

    def _on_the_way(self) -> int:
        return sum(not self._exchange.is_over(id) for id in self._ids)
