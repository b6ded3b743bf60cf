"""What goes on between a client and the hub while somebody waits."""
import math
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from . import wire
from .answer import Answer, Progress, answer_of, progress_of, wants_another_try
from .errors import GenioError, HubError, MessageError
from .link import Link
from .messages import ack_t, command_reply_t, progress_t, server_status_t
from .pending import Pending
from .seal import NoSeal

MOST_REFUSALS_OF_A_CANCEL = 2
MOST_AT_A_LOOK = 1000  # messages
TURN_S = 1.0  # longest without a look at what is due


class Exchange:
    """Owns what was asked and is not over. Nothing is sent or taken but in step() and send_due(),
    which one thread calls."""

    def __init__(self, url: str, name: str, seal: NoSeal):
        """Raises InvalidInput for a URL that cannot be used. Does not connect yet."""
        self.requests: dict[str, Pending] = {}
        self.cancels: dict[str, Pending] = {}
        self.status: Any = None  # the last server_status_t
        self.link = Link(url)
        self._name, self._seal = name, seal
        self._seen_connections = 0
        self._unreadable = ""
        self._in_callback = self._closed = False
        self._turn = threading.RLock()
        self._reply_channel = f"GENIO_REPLY.{name}"
        self._progress_channel = f"GENIO_PROGRESS.{name}"
        # The dot of a pattern stands for any character; without other signs it is cheap for a hub.
        for channel in (self._reply_channel, self._progress_channel):
            self.link.subscribe(channel)

    def connect(self, longest_s: float) -> None:
        """Raises HubError where no hub answers in that time."""
        until = time.monotonic() + longest_s
        while not self.link.connect(until - time.monotonic()):
            if self.link.is_no_hub or time.monotonic() >= until:
                raise HubError(f"{self.link.url}: {self.link.trouble}")

    def close(self) -> None:
        """What was published still arrives."""
        self._closed = True
        self.link.close()

    def trouble(self) -> str:
        """What may be the reason that nothing comes."""
        if not self.link.connected:
            return f"{self.link.url}: {self.link.trouble}"
        return self._unreadable or f"is 'genio serve' running on {self.link.url}?"

    def is_over(self, id: str, until: float = math.inf) -> bool:
        """True where nothing more is to come for a request, or not before `until`, a time of
        time.monotonic(): the service may have asked for more patience than that."""
        request = self.requests.get(id)
        return not request or bool(request.answer or request.refusal and request.ask_at > until)

    def look(self) -> None:
        """Takes what has come, without waiting."""
        for _ in range(MOST_AT_A_LOOK):
            if not self.step(time.monotonic()):
                return

    def step(self, until: float) -> bool:
        """Sends what is due and takes one message, if one comes until then."""
        with self.alone():
            if not self.link.connect(min(until - time.monotonic(), TURN_S)):
                return False
            self.send_due()
            turn_ends = min([until, time.monotonic() + TURN_S] + [p.ask_at for p in self._open()])
            received = self.link.receive(turn_ends - time.monotonic())
            if received:
                self._take(*received)
            return received is not None

    def send_due(self) -> None:
        """Requests before cancels, which mean them, and in the order in which they were asked."""
        with self.alone():
            if self.link.connections != self._seen_connections:
                # What was on its way when the connection ended may be lost.
                self._seen_connections = self.link.connections
                for pending in self._open():
                    if not pending.refusal:
                        pending.ask_now()
            for pending in self._open():
                if time.monotonic() >= pending.ask_at and self.link.connected:
                    if self.publish(pending.channel, pending.message):
                        pending.was_sent()

    def publish(self, channel: str, message: bytes) -> bool:
        """False where it could not be sent."""
        return self.link.publish(channel, self._seal.wrap(channel, message))

    def _open(self) -> list[Pending]:
        waiting = [*self.requests.values(), *self.cancels.values()]
        return [p for p in waiting if not p.answer]

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Raises GenioError where another thread is at it, or after close()."""
        if not self._turn.acquire(blocking=False):
            raise GenioError("another thread uses this client now; give each a client of its own")
        try:
            if self._closed:
                raise GenioError("the client was closed")
            yield
        finally:
            self._turn.release()

    def _take(self, channel: str, payload: bytes) -> None:
        try:
            message = self._seal.unwrap(channel, payload)
            if channel == self._reply_channel:
                reply = answer_of(wire.decode(command_reply_t, message))
            elif channel == self._progress_channel:
                progress = progress_of(wire.decode(progress_t, message))
            elif channel == "GENIO_STATUS":
                self.status = wire.decode(server_status_t, message)
        except MessageError as error:
            self._unreadable = f"a message on {channel} could not be read: {error}"
            return
        if channel == self._reply_channel:
            self._take_reply(reply)
        elif channel == self._progress_channel:
            self._take_progress(progress)

    def _take_reply(self, answer: Answer) -> None:
        request, cancel = self.requests.get(answer.id), self.cancels.get(answer.id)
        refused = answer.status == "refused"
        if not refused and (request or cancel):
            self._acknowledge(answer.id)
        if cancel and not cancel.answer and refused:
            # There was nothing to withdraw: perhaps the request or its reply was lost on the way.
            cancel.refusals += 1
            if request and not request.answer and cancel.refusals < MOST_REFUSALS_OF_A_CANCEL:
                request.ask_now()
                cancel.ask_now()
            else:
                cancel.answer = answer
            return
        if cancel:
            cancel.answer = answer
        if request and not request.answer:
            if wants_another_try(answer.raw):
                request.was_refused(answer)
            else:
                request.answer = answer

    def _take_progress(self, progress: Progress) -> None:
        request = self.requests.get(progress.id)
        if request and request.progress and not self._in_callback:
            self._in_callback = True
            try:
                request.progress(progress)
            finally:
                self._in_callback = False

    def _acknowledge(self, id: str) -> None:
        message = ack_t()
        message.utime, message.id, message.client = time.time_ns() // 1000, id, self._name
        self.publish("GENIO_ACK", wire.encode(message))
