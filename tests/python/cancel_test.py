"""What becomes of a request that is withdrawn, whatever is lost on the way."""
import time
import unittest

from fake_hub import FakeHub, answering, cancel_of, request_of
from genio_client import Client

POINTS = [(60.0, 90.0), (50.0, 95.0)]


class Cancelling(unittest.TestCase):
    def test_the_reply_to_the_request_answers_the_cancel(self):
        def cancelled(hub, channel, payload):
            if channel == "GENIO_CANCEL":
                hub.reply(cancel_of(payload), "cancelled")
        with FakeHub(cancelled) as hub, Client(hub.url) as client:
            id = client.ask(POINTS)
            self.assertEqual(client.cancel(id).status, "cancelled")
            self.assertEqual(client.answer(id).status, "cancelled")

    def test_what_is_unknown_is_refused(self):
        def unknown(hub, channel, payload):
            hub.reply(cancel_of(payload), "refused")
        with FakeHub(unknown) as hub, Client(hub.url) as client:
            self.assertEqual(client.cancel("unknown").status, "refused")

    def test_an_answer_that_is_there_is_given(self):
        with FakeHub(answering()) as hub, Client(hub.url) as client:
            id = client.ask(POINTS)
            client._exchange.step(time.monotonic() + 20)
            self.assertTrue(client.cancel(id).converged)
            self.assertEqual(hub.of("GENIO_CANCEL"), [])

    def test_a_request_that_the_service_lost_is_not_computed_after_its_cancel(self):
        known = []
        def forgetful(hub, channel, payload):
            if channel == "GENIO_REQUEST" and len(hub.of(channel)) > 1:
                known.append(request_of(payload).id)
            elif channel == "GENIO_CANCEL":
                c = cancel_of(payload)
                hub.reply(c, "cancelled" if c.id in known else "refused")
        with FakeHub(forgetful) as hub, Client(hub.url) as client:
            self.assertEqual(client.cancel(client.ask(POINTS)).status, "cancelled")

    def test_a_refused_cancel_leaves_the_request_alone(self):
        def not_yours(hub, channel, payload):
            if channel == "GENIO_CANCEL":
                hub.reply(cancel_of(payload), "refused", message="not yours")
                if len(hub.of("GENIO_CANCEL")) == 2:
                    hub.reply(cancel_of(payload), "converged")
        with FakeHub(not_yours) as hub, Client(hub.url) as client:
            id = client.ask(POINTS)
            self.assertEqual(client.cancel(id).message, "not yours")
            self.assertTrue(client.answer(id).converged)

    def test_progress_may_cancel(self):
        def working(hub, channel, payload):
            if channel == "GENIO_REQUEST":
                for k in range(5):
                    hub.progress(request_of(payload), "running", k)
            elif channel == "GENIO_CANCEL":
                hub.reply(cancel_of(payload), "cancelled")
        with FakeHub(working) as hub, Client(hub.url) as client:
            seen = []
            def stop(progress):
                seen.append(progress.iteration)
                if progress.iteration == 0:
                    client.cancel(progress.id)
            self.assertEqual(client.invert(POINTS, progress=stop).status, "cancelled")
            self.assertEqual(seen[0], 0)


if __name__ == "__main__":
    unittest.main()
