"""The types that lcm-gen makes of messages/*.lcm. They are no part of the sources."""
try:
    from .lcm_types.genio import (ack_t, cancel_t, command_reply_t, progress_t, server_status_t,
                                  shape_request_t)
except ImportError as error:
    raise ImportError(
        "genio_client: the message types are not made yet. Run this in the top folder of Genio:\n"
        "    lcm-gen -p --ppath python/genio_client/lcm_types messages/*.lcm") from error

__all__ = ["ack_t", "cancel_t", "command_reply_t", "progress_t", "server_status_t",
           "shape_request_t"]
