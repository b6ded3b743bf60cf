"""The protocol of LCM's tcpq transport, as bytes. Nothing here touches a socket.

It is made of words of 32 bits, the high byte first. Either side begins with two words, its mark and
the version. After them a client sends publish (1, length, channel, size, payload), subscribe (2,
length, pattern) and unsubscribe (3, length, pattern). The hub sends nothing but publish.
"""
import struct
from collections.abc import Iterator

SERVER_MARK, CLIENT_MARK, VERSION = 0x287617FA, 0x287617FB, 0x0100
PUBLISH, SUBSCRIBE, UNSUBSCRIBE = 1, 2, 3
GREETING_BYTES = 8
MAX_NAME_BYTES = 256  # of a channel or a pattern, as `genio serve` limits them
MAX_PAYLOAD_BYTES = (4 << 20) + (64 << 10)


class ProtocolError(Exception):
    """The other side does not speak tcpq, or goes beyond a limit."""


def greeting(mark: int = CLIENT_MARK) -> bytes:
    return struct.pack(">II", mark, VERSION)


def check_greeting(data: bytes) -> None:
    """Raises ProtocolError unless these are the 8 bytes with which a hub begins."""
    if len(data) != GREETING_BYTES or struct.unpack(">I", data[:4])[0] != SERVER_MARK:
        raise ProtocolError("what listens there is no LCM hub: it greets otherwise")


def publication(channel: str, payload: bytes) -> bytes:
    name = channel.encode()
    return struct.pack(f">II{len(name)}sI", PUBLISH, len(name), name, len(payload)) + payload


def subscription(pattern: str, kind: int = SUBSCRIBE) -> bytes:
    """`pattern`: a regular expression that matches a whole channel."""
    name = pattern.encode()
    return struct.pack(f">II{len(name)}s", kind, len(name), name)


class Publications:
    """Takes the bytes of a hub, in pieces of any size, and gives the publications in them. It holds
    one publication at most, and of the limits' size at most, besides the piece itself."""

    def __init__(self, max_payload_bytes: int = MAX_PAYLOAD_BYTES):
        self._max_payload_bytes = max_payload_bytes
        self._held = bytearray()

    def take(self, piece: bytes) -> Iterator[tuple[str, bytes]]:
        """Channel and payload of each publication that is complete now. Raises ProtocolError."""
        self._held += piece
        while (end := self._end()) is not None:
            length = self._word(4)
            channel = self._held[8 : 8 + length].decode(errors="replace")
            payload = bytes(self._held[12 + length : end])
            del self._held[:end]
            yield channel, payload

    def _word(self, at: int) -> int:
        return int.from_bytes(self._held[at : at + 4])

    def _end(self) -> int | None:
        """Where the first publication ends, if it is there. Lengths are checked as they come."""
        held = len(self._held)
        if held >= 4 and self._word(0) != PUBLISH:
            raise ProtocolError(f"the hub sent {self._word(0)} where a publication begins with 1")
        if held < 8:
            return None
        length = self._word(4)
        if length > MAX_NAME_BYTES:
            raise ProtocolError(f"the hub sent a channel of {length} bytes; expected at most "
                                f"{MAX_NAME_BYTES}")
        if held < 12 + length:
            return None
        size = self._word(8 + length)
        if size > self._max_payload_bytes:
            raise ProtocolError(f"the hub sent a message of {size} bytes; expected at most "
                                f"{self._max_payload_bytes}")
        return 12 + length + size if held >= 12 + length + size else None
