"""Clients where no hub is, or one that hangs, or something else. No wait is without an end."""
import math
import threading
import time
import unittest

from fake_hub import FakeHub
from genio_client import Client, HubError, InvalidInput

POINTS = [(60.0, 90.0), (50.0, 95.0)]


class Connecting(unittest.TestCase):
    def refused(self, url, expected, longest_s=1.0):
        began = time.monotonic()
        with self.assertRaisesRegex(HubError, expected):
            Client(url, connect_timeout_s=longest_s)
        return time.monotonic() - began

    def test_nobody_there_is_told(self):
        with FakeHub() as hub:
            free = hub.url
        self.refused(free, "refused")

    def test_a_hub_that_never_greets_is_told(self):
        with FakeHub(greeting=None) as hub:
            self.assertLess(self.refused(hub.url, "does not greet"), 60)

    def test_what_greets_otherwise_is_no_hub_and_told_at_once(self):
        with FakeHub(greeting=b"HTTP/1.1 400 Bad Request") as hub:
            self.refused(hub.url, "no LCM hub", longest_s=600)

    def test_a_hub_that_closes_at_once_is_told(self):
        with FakeHub(greeting=b"") as hub:
            stop = threading.Event()
            def close():
                while not stop.wait(0.01):
                    hub.drop()
            thread = threading.Thread(target=close)
            thread.start()
            self.refused(hub.url, "closed|reset")
            stop.set()
            thread.join()

    def test_a_host_that_nobody_knows_is_told(self):
        self.refused("tcpq://host.invalid:7700", "host.invalid")

    def test_all_names_of_this_host_lead_to_its_hub(self):
        with FakeHub() as hub:
            port = hub.url.rsplit(":")[-1]
            for host in ("localhost", "127.0.0.2", "127.1", "0.0.0.0", ""):
                Client(f"tcpq://{host}:{port}").close()

    def test_arguments_are_refused_by_name(self):
        with FakeHub() as hub:
            for name in ("a b", "x" * 41, "ä", "a\n"):
                with self.assertRaisesRegex(InvalidInput, "name"):
                    Client(hub.url, name=name)
            with self.assertRaisesRegex(InvalidInput, "connect_timeout_s"):
                Client(hub.url, connect_timeout_s=math.inf)
            with Client(hub.url) as client:
                for id in ("x" * 201, "a\nb"):
                    with self.assertRaisesRegex(InvalidInput, "id"):
                        client.ask(POINTS, id=id)
                with self.assertRaisesRegex(InvalidInput, "stream"):
                    client.ask(POINTS, stream="a b")
                with self.assertRaisesRegex(InvalidInput, "timeout_s"):
                    client.invert(POINTS, timeout_s=math.nan)
                with self.assertRaisesRegex(InvalidInput, "nothing was asked"):
                    client.answer("unknown")
            self.assertEqual(hub.of("GENIO_REQUEST"), [])


if __name__ == "__main__":
    unittest.main()
