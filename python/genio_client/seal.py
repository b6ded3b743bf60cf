"""What signs messages with a shared key and checks them. docs/threat-model.md has the layout."""
import hashlib
import hmac
import os
import secrets
import stat
import struct
import time
from bisect import insort

from .errors import InvalidInput, MessageError
from .wire import MAX_MESSAGE_BYTES

KEY_BYTES, NONCE_BYTES, MAC_BYTES = 32, 16, 32
WINDOW_US = 30_000_000  # between the time of a seal and that of the receiver
BEFORE_START_US = 1_000_000  # nothing is taken that was sealed longer before the receiver began
REMEMBERED = 1 << 16  # seals that were taken
FINGERPRINT = bytes.fromhex("fe11e72441b4c733")  # of sealed_t
DOMAIN = b"genio.sealed_t.1"


class NoSeal:
    """Without a key, messages go as they are."""

    def wrap(self, channel: str, message: bytes) -> bytes:
        """What is published on the channel for the message; made anew each time it is sent."""
        return message

    def unwrap(self, channel: str, payload: bytes) -> bytes:
        """The message. Raises MessageError for a payload that is not to be believed."""
        if payload[:8] == FINGERPRINT:
            raise MessageError("the server there seals its messages, so a key is needed")
        return payload


class Seal(NoSeal):
    """With a key, every message is signed, and only signed ones are taken, each once. Times are
    microseconds since 1970."""

    def __init__(self, key: bytes):
        self._key = key
        self._seen: list[tuple[int, bytes]] = []  # times and nonces, oldest first
        self._oldest = _now_us() - BEFORE_START_US  # what was sealed then or before is not known

    def wrap(self, channel: str, message: bytes) -> bytes:
        return self.sealed(channel, message, _now_us(), secrets.token_bytes(NONCE_BYTES))

    def sealed(self, channel: str, message: bytes, utime: int, nonce: bytes) -> bytes:
        name = channel.encode() + b"\0"
        above = (FINGERPRINT + struct.pack(f">q{NONCE_BYTES}sI", utime, nonce, len(name)) + name
                 + struct.pack(">I", len(message)) + message)
        return above + self._mac(above)

    def unwrap(self, channel: str, payload: bytes) -> bytes:
        if payload[:8] != FINGERPRINT:
            raise MessageError("it has no seal, so the server there runs without a key")
        above, mac = payload[:-MAC_BYTES], payload[-MAC_BYTES:]
        if not hmac.compare_digest(mac, self._mac(above)):
            raise MessageError("it is sealed with another key, or was changed")
        utime, nonce, message = self._parts(channel, above)
        self._take(utime, nonce)
        return message

    def _parts(self, channel: str, above: bytes) -> tuple[int, bytes, bytes]:
        name = channel.encode() + b"\0"
        begin = len(FINGERPRINT) + 8 + NONCE_BYTES
        start = begin + 4 + len(name) + 4
        if above[begin:start - 4] != struct.pack(">I", len(name)) + name:
            raise MessageError("it is sealed for another channel")
        size = int.from_bytes(above[start - 4:start])
        if len(above) != start + size or size > MAX_MESSAGE_BYTES:
            raise MessageError("a length in its seal is wrong")
        utime = int.from_bytes(above[8:16], signed=True)
        return utime, above[16:16 + NONCE_BYTES], above[start:]

    def _take(self, utime: int, nonce: bytes) -> None:
        now = _now_us()
        # A clock that was set back would shut everybody out until it has come as far again.
        if self._oldest > now + WINDOW_US:
            self._oldest = now - WINDOW_US
        while self._seen and self._seen[0][0] < now - WINDOW_US:
            self._forget_first()
        if utime <= self._oldest or abs(utime - now) > WINDOW_US:
            raise MessageError(f"it was sealed more than {WINDOW_US // 1_000_000} s ago or ahead, "
                               "or before this client began; do the clocks differ?")
        if (utime, nonce) in self._seen:
            raise MessageError("it came before")
        insort(self._seen, (utime, nonce))
        if len(self._seen) > REMEMBERED:
            self._forget_first()

    def _forget_first(self) -> None:
        self._oldest = max(self._oldest, self._seen.pop(0)[0])

    def _mac(self, above: bytes) -> bytes:
        return hashlib.blake2b(DOMAIN + above, key=self._key, digest_size=MAC_BYTES).digest()


def seal_of(key: bytes | str | os.PathLike[str] | None) -> NoSeal:
    """`key`: the 32 bytes themselves, or the file that `genio key` made. Raises InvalidInput for a
    file that others than its owner may read or write, or that holds anything else."""
    if key is None:
        return NoSeal()
    secret = key if isinstance(key, bytes) else _read_key(key)
    if len(secret) != KEY_BYTES:
        raise InvalidInput(f"key: {len(secret)} bytes; expected {KEY_BYTES}, or the path of a file")
    return Seal(secret)


def _read_key(path: str | os.PathLike[str]) -> bytes:
    expected = "expected one line of 64 hexadecimal digits, as genio key makes"
    try:
        # Without waiting for the other end of a pipe.
        with open(os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK), "rb") as file:
            _check_is_private(path, os.fstat(file.fileno()))
            text = file.read(2 * KEY_BYTES + 2)
    except OSError as error:
        raise InvalidInput(f"key {path}: cannot be read: {error.strerror}") from None
    try:
        digits = text.removesuffix(b"\n").decode("ascii")
        if len(digits) == 2 * KEY_BYTES and digits.isalnum():
            return bytes.fromhex(digits)
    except ValueError:
        pass
    raise InvalidInput(f"key {path}: is no key; {expected}")


def _check_is_private(path: str | os.PathLike[str], status: os.stat_result) -> None:
    """Judged by the open file, which nobody can exchange."""
    if not stat.S_ISREG(status.st_mode):
        raise InvalidInput(f"key {path}: is no file")
    if status.st_mode & 0o077:
        raise InvalidInput(f"key {path}: its mode {stat.S_IMODE(status.st_mode):04o} lets others "
                           "than its owner at the key; expected 0600 or 0400 (chmod 600)")
    if status.st_uid not in (os.geteuid(), 0):
        raise InvalidInput(f"key {path}: belongs to another user, who knows the key")


def _now_us() -> int:
    return time.time_ns() // 1000
