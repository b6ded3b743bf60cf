"""Clients with a key, before a service with it and before one that fakes answers."""
import unittest
from unittest import mock

from fake_hub import FakeHub, request_of
from genio_client import Client, NoReply, messages, wire
from genio_client.seal import seal_of

POINTS = [(60.0, 90.0), (50.0, 95.0)]
QUICK = mock.patch("genio_client.pending.PAUSES_S", (0.05, 0.2))


class WithAKey(unittest.TestCase):
    KEY = bytes(range(32))

    def hub_with(self, key):
        """What comes without its seal is not read; what it sends is sealed."""
        seal = seal_of(key)
        def on_message(hub, channel, payload):
            message = seal.unwrap(channel, payload)
            if channel == "GENIO_REQUEST":
                request, reply = request_of(message), messages.command_reply_t()
                reply.id, reply.status = request.id, "converged"
                channel = f"GENIO_REPLY.{request.client}"
                sealed = seal.wrap(channel, wire.encode(reply))
                changed = sealed[:-1] + bytes([sealed[-1] ^ 1])
                hub.send(channel, changed)
                hub.send(channel, sealed)
        return FakeHub(on_message)

    def test_the_key_opens_what_the_key_sealed(self):
        with self.hub_with(self.KEY) as hub, Client(hub.url, key=self.KEY) as client:
            self.assertTrue(client.invert(POINTS).converged)

    @QUICK
    def test_a_request_is_sealed_anew_each_time(self):
        with FakeHub() as hub, Client(hub.url, key=self.KEY) as client:
            with self.assertRaises(NoReply):
                client.invert(POINTS, timeout_s=1)
            sent = hub.of("GENIO_REQUEST")
            self.assertGreater(len(sent), 1)
            self.assertEqual(len(set(sent)), len(sent))

    def test_an_answer_without_the_seal_is_not_believed(self):
        def faker(hub, channel, payload):
            reply = messages.command_reply_t()
            reply.id, reply.status = "a", "converged"
            hub.send(f"GENIO_REPLY.{client.name}", wire.encode(reply))
        with FakeHub(faker) as hub, Client(hub.url, key=self.KEY) as client:
            with self.assertRaisesRegex(NoReply, "no seal"):
                client.invert(POINTS, id="a", timeout_s=1)


if __name__ == "__main__":
    unittest.main()
