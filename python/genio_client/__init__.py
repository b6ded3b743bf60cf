"""A client of `genio serve`: asks over LCM for the muscle forces behind tongue shapes.

It needs Python 3.11 and nothing else, besides the message types that lcm-gen makes.
docs/other-languages.md shows how to use it.
"""
from .answer import Alternative, Answer, Either, Estimate, Muscle, Progress, Status
from .client import Client
from .errors import GenioError, HubError, InvalidInput, MessageError, NoReply
from .frames import Frame, read_frames
from .request import RequestOptions
from .stream import Stream

__all__ = ["Alternative", "Answer", "Client", "Either", "Estimate", "Frame", "GenioError",
           "HubError", "InvalidInput", "MessageError", "Muscle", "NoReply", "Progress",
           "RequestOptions", "Status", "Stream", "read_frames"]
