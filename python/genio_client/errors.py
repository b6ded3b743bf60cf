"""What can go wrong, each kind with a class of its own."""


class GenioError(Exception):
    """Any of the errors below."""


class InvalidInput(GenioError, ValueError):
    """An argument cannot be used; the text names it and says what is expected."""


class HubError(GenioError, ConnectionError):
    """No hub answers at the URL, or what answers there is none."""


class NoReply(GenioError, TimeoutError):
    """Nothing came in time. `id` is that of the request, or empty. Asking again with the same id
    and content is safe: the service computes it once."""

    def __init__(self, text: str, id: str = ""):
        super().__init__(text)
        self.id = id


class MessageError(GenioError, ValueError):
    """Bytes that are no message of this version."""
