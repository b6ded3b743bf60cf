"""Frames of a stream: their answers come in the order of sending."""
import unittest

from fake_hub import FakeHub, answering, request_of
from genio_client import Client

POINTS = [(60.0, 90.0), (50.0, 95.0)]


class Streaming(unittest.TestCase):
    def test_answers_come_in_the_order_of_sending(self):
        held = []
        def backwards(hub, channel, payload):
            if channel == "GENIO_REQUEST":
                held.append(request_of(payload))
                if len(held) == 5:
                    for request in reversed(held):
                        hub.reply(request, label=request.label)
        with FakeHub(backwards) as hub, Client(hub.url) as client:
            stream = client.stream("word", deadline_s=3)
            for k in range(5):
                stream.send(POINTS, label=str(k))
            self.assertEqual(len(stream), 5)
            self.assertEqual([a.label for a in stream], list("01234"))
            self.assertEqual({(r.stream, r.deadline_s) for r in held}, {("word", 3.0)})

    def test_no_more_are_on_their_way_than_asked_for(self):
        on_way, most = [], []
        def slow(hub, channel, payload):
            if channel == "GENIO_REQUEST":
                on_way.append(request_of(payload))
                most.append(len(on_way))
                if len(on_way) == 3:
                    hub.reply(on_way.pop(0))
        with FakeHub(slow) as hub, Client(hub.url) as client:
            stream = client.stream("s", ahead=3)
            for _ in range(20):
                stream.send(POINTS)
            self.assertEqual(max(most), 3)

    def test_what_has_arrived_is_had_without_waiting(self):
        with FakeHub(answering()) as hub, Client(hub.url) as client:
            stream = client.stream("s")
            self.assertEqual(stream.arrived(), [])
            ids, got = [stream.send(POINTS) for _ in range(4)], []
            self.assertTrue(hub.eventually(lambda: got.extend(stream.arrived()) or len(got) == 4))
            self.assertEqual([a.id for a in got], ids)

    def test_the_order_is_kept_when_the_hub_went_away(self):
        def lost_once(hub, channel, payload):
            if hub.accepted == 1 and len(hub.of("GENIO_REQUEST")) == 4:
                hub.drop()
            elif hub.accepted == 2 and channel == "GENIO_REQUEST":
                hub.reply(request_of(payload), label=request_of(payload).label)
        with FakeHub(lost_once) as hub, Client(hub.url) as client:
            stream = client.stream("s")
            for k in range(4):
                stream.send(POINTS, label=str(k))
            self.assertEqual([a.label for a in stream], list("0123"))
            again = [request_of(p).label for p in hub.of("GENIO_REQUEST")[4:]]
            self.assertEqual(again, list("0123"))


if __name__ == "__main__":
    unittest.main()
