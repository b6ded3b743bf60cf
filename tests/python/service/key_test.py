"""A server with a shared key, and clients with it, without it, and with another."""
import unittest

from genio_client import Client, NoReply, read_frames
from running import EXAMPLE, GENIO, PATIENCE_S, Serving


class Key(Serving):
    def make_key(self, name):
        self.output_of(GENIO, "key", self.folder / name)
        return self.folder / name

    def test_only_the_key_opens_the_service(self):
        key, points = self.make_key("genio.key"), read_frames(EXAMPLE)[0].points
        server = self.serve("--key", key, key=key)
        with Client(server.url, key=key) as client:
            self.assertTrue(client.invert(points, timeout_s=PATIENCE_S).converged)
        with Client(server.url) as client:
            answer = client.invert(points, timeout_s=PATIENCE_S)
            self.assertEqual(answer.status, "refused")
            self.assertIn("key", answer.message)
            with self.assertRaisesRegex(NoReply, "a key is needed"):
                client.status(timeout_s=5)
        with Client(server.url, key=self.make_key("other.key")) as client:
            with self.assertRaisesRegex(NoReply, "another key"):
                client.status(timeout_s=5)

    def test_a_server_without_a_key_is_not_believed(self):
        server = self.serve()
        with Client(server.url, key=self.make_key("genio.key")) as client:
            with self.assertRaisesRegex(NoReply, "without a key"):
                client.status(timeout_s=5)


if __name__ == "__main__":
    unittest.main()
