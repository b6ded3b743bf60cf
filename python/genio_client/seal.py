"""Where a shared key would sign what leaves and check what comes."""


class NoSeal:
    """Without a key, messages go as they are."""

    def wrap(self, channel: str, message: bytes) -> bytes:
        """What is published on the channel for the message; made anew each time it is sent."""
        return message

    def unwrap(self, channel: str, payload: bytes) -> bytes:
        """The message. Raises MessageError for a payload that is not to be believed."""
        return payload
