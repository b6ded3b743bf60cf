"""LCM's tcpq URLs, and the addresses behind them."""
import os
import re
import socket
import threading

from .errors import InvalidInput

DEFAULT_URL = "tcpq://127.0.0.1:7700"


def choose_url(url: str | None) -> str:
    """The URL itself, else LCM_DEFAULT_URL, else that of `genio serve`."""
    return url or os.environ.get("LCM_DEFAULT_URL") or DEFAULT_URL


def host_and_port(url: str) -> tuple[str, int]:
    """Of "tcpq://HOST:PORT". Either may be left out; options after a question mark are ignored, as
    LCM ignores them. Raises InvalidInput for what is no such URL. A port begins with no 0, since
    LCM would read 07700 as octal."""
    found = re.fullmatch(r"tcpq://([^\s:/?]*)(?::([1-9]\d{0,4}))?/?(?:\?.*)?", url, re.ASCII)
    if not found or int(found[2] or 1) > 65535:
        raise InvalidInput(f"url '{url}': expected tcpq://HOST:PORT, such as {DEFAULT_URL}; for "
                           "other transports take LCM's own library")
    return found[1] or "127.0.0.1", int(found[2] or 7700)


def ipv4_of(host: str, longest_s: float) -> str:
    """The address of a host, as LCM speaks IPv4 alone. Raises OSError when the name is not known,
    or nobody could say in time: the system's own look-up has no limit that could be set."""
    found: list[str | OSError] = []

    def look_up() -> None:
        try:
            address = str(socket.getaddrinfo(host, None, socket.AF_INET)[0][4][0])
            # The hub of `genio serve` listens on 127.0.0.1, whatever the host was called.
            here = address.startswith("127.") or address == "0.0.0.0"
            found.append("127.0.0.1" if here else address)
        except (OSError, UnicodeError):
            found.append(OSError(f"the host '{host}' is not known"))

    thread = threading.Thread(target=look_up, daemon=True)
    thread.start()
    thread.join(longest_s)
    if not found:
        raise OSError(f"nobody said within {longest_s:g} s where the host '{host}' is")
    if isinstance(found[0], OSError):
        raise found[0]
    return found[0]
