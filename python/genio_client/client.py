"""The requester's side of `genio serve`."""
import math
import os
import re
import secrets
import time
from collections.abc import Callable, Sequence
from typing import Unpack

from . import wire
from .address import choose_url
from .answer import Answer, Progress, Status, status_of
from .errors import InvalidInput, NoReply
from .exchange import Exchange
from .messages import cancel_t
from .pending import Pending
from .request import Point, RequestOptions, encode_request, make_request
from .seal import seal_of
from .stream import Stream

MAX_ID_CHARACTERS = 200
STATUS_PAUSE_S = 1.0  # before a status is asked for again

OnProgress = Callable[[Progress], None]


class Client:
    """Asks the service and waits for its answers. It asks again until an answer comes, connects
    again when the hub was away, and acknowledges what arrived. No wait is without a limit. One
    client serves one thread; give every thread a client of its own.

        with Client() as client:
            answer = client.invert(points)
    """

    def __init__(self, url: str | None = None, name: str | None = None,
                 key: bytes | str | os.PathLike[str] | None = None,
                 connect_timeout_s: float = 5.0):
        """`url`: of the hub; else LCM_DEFAULT_URL, else tcpq://127.0.0.1:7700. `name`: under which
        answers come, 1 to 40 letters, digits, '_' or '-'; one that nobody has unless given. Only a
        client of the same name may cancel. `key`: the file that `genio key` made, or its 32 bytes,
        for a server with a key; answers are believed only with its seal then. Raises InvalidInput
        for what cannot be used, HubError where no hub answers within `connect_timeout_s`."""
        self.name = name or f"py{os.getpid()}-{secrets.token_hex(8)}"
        if not re.fullmatch(r"[A-Za-z0-9_-]{1,40}", self.name):
            raise InvalidInput(f"name '{self.name}': expected 1 to 40 letters, digits, '_' or '-'")
        self._exchange = Exchange(choose_url(url), self.name, seal_of(key))
        # A name may be used again, the ids of an earlier run may not.
        self._id_prefix = f"{self.name}-{secrets.token_hex(4)}"
        self._asked = 0
        self._exchange.connect(_limit(connect_timeout_s, "connect_timeout_s"))

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """What was sent still arrives."""
        self._exchange.close()

    def invert(self, points: Sequence[Point], *, timeout_s: float = 120.0,
               progress: OnProgress | None = None, id: str = "",
               **options: Unpack[RequestOptions]) -> Answer:
        """The muscle forces that make the shape. `points`: x, z or x, y, z [mm] each, as
        RequestOptions explains with all options. `progress` is called with a Progress now and then;
        it may call cancel(). Whatever the service answers is returned, a refusal too. Raises
        InvalidInput before anything is sent, NoReply when nothing came within `timeout_s`."""
        limit_s = _limit(timeout_s, "timeout_s")
        id = self.ask(points, id=id, progress=progress, **options)
        try:
            return self.answer(id, timeout_s=limit_s)
        finally:
            self.forget(id)

    def ask(self, points: Sequence[Point], *, progress: OnProgress | None = None, id: str = "",
            stream: str = "", **options: Unpack[RequestOptions]) -> str:
        """Sends a request and returns its id; answer() gets what comes of it. Ids are made where
        none is given. The same id with other content is refused by the service."""
        request = make_request(points, **options)
        request.id, request.client = id or self._next_id(), self.name
        request.stream, request.utime = stream, _now_us()
        _check_id(request.id)
        if not re.fullmatch(r"[A-Za-z0-9_-]{0,40}", stream):
            raise InvalidInput(f"stream '{stream}': expected at most 40 letters, digits, '_', '-'")
        if request.id in self._exchange.requests:
            raise InvalidInput(f"id '{request.id}': it was asked already, and not taken yet")
        pending = Pending(request.id, "GENIO_REQUEST", encode_request(request), progress)
        with self._exchange.alone():
            self._exchange.requests[request.id] = pending
            self._exchange.send_due()
        return request.id

    def answer(self, id: str, *, timeout_s: float = 120.0) -> Answer:
        """Waits for the answer to a request that ask() sent, which is then forgotten. After
        NoReply it can be waited for again."""
        request = self._exchange.requests.get(id)
        if not request:
            raise InvalidInput(f"id '{id}': nothing was asked under it, or the answer was taken")
        until = time.monotonic() + _limit(timeout_s, "timeout_s")
        with self._exchange.alone():
            while not self._exchange.is_over(id, until):
                self._wait(until, f"no reply to '{id}' within {timeout_s:g} s", id)
            self.forget(id)
        answer = request.answer or request.refusal
        assert answer
        return answer

    def forget(self, id: str) -> None:
        """No longer asks for it. The service may compute it all the same; cancel() withdraws."""
        self._exchange.requests.pop(id, None)

    def stream(self, name: str, *, ahead: int = 32, timeout_s: float = 120.0,
               **options: Unpack[RequestOptions]) -> Stream:
        """Frames of one recording, each warm from the one before. `options` hold for all frames;
        `ahead` frames are at most on their way at once; `timeout_s` is for each wait."""
        return Stream(self, name, ahead, _limit(timeout_s, "timeout_s"), options)

    def cancel(self, id: str, *, timeout_s: float = 10.0) -> Answer:
        """Withdraws a request of this client's name, and gives what is answered to that: status
        "cancelled", the answer where it was quicker, or "refused" where there is nothing to
        withdraw. Raises NoReply when nothing came in time."""
        _check_id(id)
        until = time.monotonic() + _limit(timeout_s, "timeout_s")
        with self._exchange.alone():
            request = self._exchange.requests.get(id)
            if request and not request.answer:
                request.answer = request.refusal  # the service has nothing to withdraw
            if request and request.answer:
                return request.answer
            message = cancel_t()
            message.utime, message.id, message.client = _now_us(), id, self.name
            cancel = Pending(id, "GENIO_CANCEL", wire.encode(message))
            self._exchange.cancels[id] = cancel
            complaint = f"no reply to the cancel of '{id}' within {timeout_s:g} s"
            try:
                while not cancel.answer:
                    self._wait(until, complaint, id)
                return cancel.answer
            finally:
                self._exchange.cancels.pop(id, None)

    def status(self, *, timeout_s: float = 5.0) -> Status:
        """What the server is doing. Raises NoReply when nothing came in time."""
        until = time.monotonic() + _limit(timeout_s, "timeout_s")
        exchange, asked_at = self._exchange, -math.inf
        with exchange.alone():
            exchange.look()  # one that came after the last time is old
            exchange.status = None
            exchange.link.subscribe("GENIO_STATUS")
            try:
                while not exchange.status:
                    if exchange.link.connected and time.monotonic() >= asked_at + STATUS_PAUSE_S:
                        exchange.publish("GENIO_ASK_STATUS", b"\0")
                        asked_at = time.monotonic()
                    self._wait(until, f"no status within {timeout_s:g} s")
                return status_of(exchange.status)
            finally:
                exchange.link.unsubscribe("GENIO_STATUS")

    def _wait(self, until: float, complaint: str, id: str = "") -> None:
        """For one message at most. Raises NoReply once the time has passed."""
        if time.monotonic() >= until:
            raise NoReply(f"{complaint}; {self._exchange.trouble()}", id)
        self._exchange.step(until)

    def _next_id(self) -> str:
        self._asked += 1
        return f"{self._id_prefix}-{self._asked}"


def _now_us() -> int:
    return time.time_ns() // 1000


def _limit(seconds: float, what: str) -> float:
    if not 0 <= seconds < math.inf:
        raise InvalidInput(f"{what}: expected a number of seconds, and got {seconds}")
    return float(seconds)


def _check_id(id: str) -> None:
    if not 1 <= len(id.encode(errors="replace")) <= MAX_ID_CHARACTERS or not id.isprintable():
        raise InvalidInput(f"id '{id[:60]}': expected 1 to {MAX_ID_CHARACTERS} printable "
                           "characters")
