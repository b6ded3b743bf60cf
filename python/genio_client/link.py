"""A connection to a hub that comes back when it was lost. One thread at a time."""
import socket
import time
from collections import deque

from . import tcpq
from .address import host_and_port, ipv4_of

CONNECT_S = 2.0  # that a hub may take to accept and to greet
SEND_S = 10.0  # that it may take for a message
PAUSES_S = (0.05, 1.0)  # between two tries to connect: the first, and the longest
CHUNK_BYTES = 1 << 16


class Link:
    """Publishes and receives. Nothing here waits longer than it is told, or than the times above.
    `trouble` says why there is no connection; `connections` counts those that were made."""

    def __init__(self, url: str):
        """Raises InvalidInput for a URL that cannot be used. Does not connect yet."""
        self.url = url
        self.trouble = "not tried yet"
        self.is_no_hub = False  # what listens there answers, and not as a hub
        self.connections = 0
        self._host, self._port = host_and_port(url)
        self._socket: socket.socket | None = None
        self._reader = tcpq.Publications()
        self._patterns: list[str] = []
        self._received: deque[tuple[str, bytes]] = deque()
        self._next_try = 0.0
        self._pause = PAUSES_S[0]

    @property
    def connected(self) -> bool:
        return self._socket is not None

    def connect(self, longest_s: float) -> bool:
        """Tries once, after a pause that grows with the tries; False without a connection."""
        if self._socket:
            return True
        until = time.monotonic() + longest_s
        time.sleep(max(0.0, min(self._next_try, until) - time.monotonic()))
        if time.monotonic() < self._next_try:
            return False
        try:
            self._socket = self._greeted(min(CONNECT_S, max(until - time.monotonic(), 0.05)))
            self._reader = tcpq.Publications()
            self.connections += 1
            self._pause = PAUSES_S[0]
            for pattern in self._patterns:
                self._send(tcpq.subscription(pattern))
        except (OSError, tcpq.ProtocolError) as error:
            self._drop(error)
            self.is_no_hub = isinstance(error, tcpq.ProtocolError)
            self._next_try = time.monotonic() + self._pause
            self._pause = min(2 * self._pause, PAUSES_S[1])
        return self.connected

    def _greeted(self, longest_s: float) -> socket.socket:
        until = time.monotonic() + longest_s
        address = ipv4_of(self._host, longest_s)
        left = max(until - time.monotonic(), 0.01)
        connection = socket.create_connection((address, self._port), timeout=left)
        try:
            # Small messages are not to wait for an acknowledgement.
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            connection.sendall(tcpq.greeting())
            answer = b""
            while len(answer) < tcpq.GREETING_BYTES:
                connection.settimeout(max(until - time.monotonic(), 0.01))
                try:
                    part = connection.recv(tcpq.GREETING_BYTES - len(answer))
                except TimeoutError:
                    raise OSError("something listens there and does not greet as a hub "
                                  f"within {longest_s:.1f} s") from None
                if not part:
                    raise OSError("the connection was closed before a hub greeted")
                answer += part
            tcpq.check_greeting(answer)
            return connection
        except BaseException:
            connection.close()
            raise

    def subscribe(self, pattern: str) -> None:
        self._patterns.append(pattern)
        self._try_to_send(tcpq.subscription(pattern))

    def unsubscribe(self, pattern: str) -> None:
        self._patterns.remove(pattern)
        self._try_to_send(tcpq.subscription(pattern, tcpq.UNSUBSCRIBE))

    def publish(self, channel: str, payload: bytes) -> bool:
        """False where it could not be sent. True says nothing about who got it."""
        return self._try_to_send(tcpq.publication(channel, payload))

    def receive(self, longest_s: float) -> tuple[str, bytes] | None:
        """Channel and payload of the next message; None when none came, or the hub is gone."""
        until = time.monotonic() + longest_s
        while not self._received and self._socket:
            left = until - time.monotonic()
            try:
                self._socket.settimeout(max(left, 0.0))
                piece = self._socket.recv(CHUNK_BYTES)
                if not piece:
                    raise OSError("the hub closed the connection")
                self._received.extend(self._reader.take(piece))
            except (TimeoutError, BlockingIOError):
                break
            except (OSError, tcpq.ProtocolError) as error:
                self._drop(error)
        return self._received.popleft() if self._received else None

    def close(self) -> None:
        """What was published still arrives: the hub reads to the end before this side is gone."""
        if self._socket:
            try:
                self._socket.shutdown(socket.SHUT_WR)
                until = time.monotonic() + 0.5
                while (left := until - time.monotonic()) > 0:
                    self._socket.settimeout(left)
                    if not self._socket.recv(CHUNK_BYTES):
                        break
            except OSError:
                pass
            self._socket.close()
            self._socket = None

    def _try_to_send(self, data: bytes) -> bool:
        try:
            self._send(data)
        except OSError:
            return False
        return self.connected

    def _send(self, data: bytes) -> None:
        if not self._socket:
            return
        try:
            self._socket.settimeout(SEND_S)
            self._socket.sendall(data)
        except BaseException as error:  # an interrupt too: half a message may have gone
            self._drop(error)
            raise

    def _drop(self, reason: BaseException) -> None:
        text = getattr(reason, "strerror", None) or str(reason) or type(reason).__name__
        self.trouble = text[:1].lower() + text[1:]
        if self._socket:
            self._socket.close()
        self._socket = None
