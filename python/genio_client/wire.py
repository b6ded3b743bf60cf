"""Messages as bytes. The decoders that lcm-gen makes believe the lengths they read, so lengths are
checked first; `server/wire/wire.hpp` does the same for the server."""
from typing import Any

from .errors import MessageError

MAX_MESSAGE_BYTES = 4 << 20
MAX_ARRAY_LENGTH = 20000
MAX_STRING_BYTES = 1 << 16

# Fields of a message in order: l int64, i int32, b int8, d double, s string, n int32 that counts
# the arrays after it, D double[n], I int32[n], S string[n].
LAYOUTS = {
    "shape_request_t": "lsssssdissddddddnDDnDDDDSddbi",
    "command_reply_t": "lssssssdssdsnSDDDDDDDDDdinSSDDDDnISDnSnSDDDdddiiddisddddddnDDdnDDnD",
    "progress_t": "lssid",
    "cancel_t": "lss",
    "ack_t": "lss",
    "server_status_t": "lsnSSiiillllllllllllllddddd",
}
_SIZES = {"l": 8, "d": 8, "i": 4, "b": 1, "I": 4, "D": 8}


def check_layout(data: bytes, at: int, fields: str) -> None:
    """Walks the bytes from `at` along `fields`; raises MessageError unless they fit exactly."""
    count = 0
    for field in fields:
        if field == "n":
            count = int.from_bytes(_part(data, at, 4), signed=True)
            at += 4
            if not 0 <= count <= MAX_ARRAY_LENGTH:
                raise MessageError(f"an array claims {count} entries; expected 0 to "
                                   f"{MAX_ARRAY_LENGTH}")
        elif field in "sS":
            for _ in range(count if field == "S" else 1):
                at = _end_of_string(data, at)
        else:
            at += _SIZES[field] * (count if field in "ID" else 1)
    if at > len(data):
        raise MessageError("the message ends early")
    if at < len(data):
        raise MessageError("there are bytes after the end of the message")


def _part(data: bytes, at: int, size: int) -> bytes:
    if at + size > len(data):
        raise MessageError("the message ends early")
    return data[at : at + size]


def _end_of_string(data: bytes, at: int) -> int:
    length = int.from_bytes(_part(data, at, 4))
    if not 1 <= length <= MAX_STRING_BYTES + 1:
        raise MessageError(f"a string claims {length} bytes; expected 1 to {MAX_STRING_BYTES + 1}")
    if _part(data, at + 4, length)[-1]:
        raise MessageError("a string does not end with a zero")
    return at + 4 + length


def decode(kind: type, data: bytes) -> Any:
    """The message of that type of lcm-gen. Raises MessageError for anything else."""
    name = kind.__name__
    if len(data) > MAX_MESSAGE_BYTES:
        raise MessageError(f"a message of {len(data)} bytes; expected at most {MAX_MESSAGE_BYTES}")
    if data[:8] != kind._get_packed_fingerprint():
        raise MessageError(f"not a {name} of this version (fingerprint differs)")
    check_layout(data, 8, LAYOUTS[name])
    return kind.decode(data)


def encode(message: Any) -> bytes:
    """Raises MessageError for one that the service would not take for its size."""
    data = message.encode()
    if len(data) > MAX_MESSAGE_BYTES:
        raise MessageError(f"the message has {len(data)} bytes; expected at most "
                           f"{MAX_MESSAGE_BYTES}")
    return data
