"""The client against hubs and services that fail in every way. No wait is without an end."""
import math
import threading
import time
import unittest
from unittest import mock

from fake_hub import FakeHub, answering, request_of
from genio_client import Client, GenioError, NoReply, messages, wire

POINTS = [(60.0, 90.0), (50.0, 95.0)]
QUICK = mock.patch("genio_client.pending.PAUSES_S", (0.05, 0.2))


class Asking(unittest.TestCase):
    def test_an_answer_is_plain_values_and_is_acknowledged(self):
        fields = dict(muscle_count=2, muscle=["GGP", "SL"], alternative_count=1,
                      alternative_weight=[0.25], alternative_rms_mm=[0.5],
                      alternative_force_count=2, alternative_force_N=[3.0, 4.0],
                      group_count=1, unidentified=["GGP+SL"], rms_mm=0.5, line_count=1,
                      line_x_mm=[1.0], line_z_mm=[2.0], registration='{"scale": 1.5}',
                      scale=1.5, shift_sd_mm=0.5, tilt_sd_deg=1.0, other_count=1, other=["a"], other_unit=["deg"],
                      other_value=[2.0], other_sd=[1.0], other_low=[0.0], other_high=[4.0])
        for name in ("force_N", "max_force_N", "sd_N", "low_N", "high_N", "acts", "median_N",
                     "mean_N", "information_bits"):
            fields[name] = [float(len(fields)), math.nan]
        with FakeHub(answering(**fields)) as hub, Client(hub.url) as client:
            answer = client.invert(POINTS)
            self.assertTrue(answer.converged)
            self.assertEqual(answer.muscles["GGP"].best_N, fields["force_N"][0])
            self.assertEqual(answer.muscles["GGP"].acts, fields["acts"][0])
            self.assertEqual(answer.alternatives[0].forces_N, {"GGP": 3.0, "SL": 4.0})
            self.assertEqual((answer.line, answer.unidentified), ([(1.0, 2.0)], [["GGP", "SL"]]))
            self.assertEqual(answer.registration, {"scale": 1.5})
            self.assertEqual(answer.placed, (1.5, 0, 0, 0, 0.5, 1))
            self.assertEqual((answer.others["a"].value, answer.others["a"].unit), (2, "deg"))
            self.assertTrue(hub.eventually(lambda: hub.of("GENIO_ACK")))
            ack = wire.decode(messages.ack_t, hub.of("GENIO_ACK")[0])
            self.assertEqual((ack.id, ack.client), (answer.id, client.name))

    def test_an_acknowledgement_arrives_though_the_client_ends(self):
        for _ in range(20):
            with FakeHub(answering()) as hub:
                with Client(hub.url) as client:
                    client.invert(POINTS)
                    hub.send("GENIO_REPLY." + client.name, b"unread" * 1000)
                self.assertTrue(hub.eventually(lambda: hub.of("GENIO_ACK")))

    def test_nothing_is_asked_for_longer_than_the_limit(self):
        with FakeHub() as hub, Client(hub.url) as client:
            with self.assertRaisesRegex(NoReply, "'a'.*serve") as caught:
                client.invert(POINTS, id="a", timeout_s=0.3)
            self.assertEqual(caught.exception.id, "a")
            with self.assertRaises(NoReply):
                client.cancel("a", timeout_s=0.3)
            with self.assertRaises(NoReply):
                client.status(timeout_s=0.3)
            stream = client.stream("s", ahead=1, timeout_s=0.3)
            stream.send(POINTS)
            with self.assertRaises(NoReply):
                stream.send(POINTS)
            with self.assertRaises(NoReply):
                next(stream)
            stream.skip()
            self.assertEqual(list(stream), [])

    def test_a_hub_that_went_away_is_told_after_the_limit(self):
        with FakeHub() as hub:
            client = Client(hub.url)
        with self.assertRaisesRegex(NoReply, "refused"):
            client.invert(POINTS, timeout_s=0.5)

    @QUICK
    def test_a_request_is_sent_again_until_its_answer_comes(self):
        def late(hub, channel, payload):
            if channel == "GENIO_REQUEST" and len(hub.of(channel)) == 4:
                hub.reply(request_of(payload))
        with FakeHub(late) as hub, Client(hub.url) as client:
            self.assertTrue(client.invert(POINTS).converged)
            self.assertEqual(len(set(hub.of("GENIO_REQUEST"))), 1)

    def test_pauses_double_from_one_to_eight_seconds(self):
        from genio_client.pending import Pending
        with mock.patch("time.monotonic", return_value=100.0):
            pending, pauses = Pending("a", "C", b""), []
            for _ in range(6):
                pending.was_sent()
                pauses.append(pending.ask_at - 100)
        self.assertEqual(pauses, [1, 2, 4, 8, 8, 8])

    def test_the_client_connects_again_and_asks_at_once(self):
        def second_time(hub, channel, payload):
            if hub.accepted < 3:
                hub.drop()
            elif channel == "GENIO_REQUEST":
                hub.reply(request_of(payload))
        with FakeHub(second_time) as hub, Client(hub.url) as client:
            self.assertTrue(client.invert(POINTS).converged)
            self.assertEqual(hub.accepted, 3)
            self.assertEqual(hub.subscribed[-2:], [f"GENIO_REPLY.{client.name}",
                                                   f"GENIO_PROGRESS.{client.name}"])

    def test_bytes_that_are_no_message_are_passed_over(self):
        def noisy(hub, channel, payload):
            if channel != "GENIO_REQUEST":
                return
            request = request_of(payload)
            for junk in (b"", b"\0" * 8, messages.command_reply_t._get_packed_fingerprint(),
                         messages.command_reply_t().encode() + b"\0", b"\xff" * 100000):
                hub.send(f"GENIO_REPLY.{request.client}", junk)
                hub.send(f"GENIO_PROGRESS.{request.client}", junk)
                hub.send("ANOTHER", junk)
            hub.reply(request)
        with FakeHub(noisy) as hub, Client(hub.url) as client:
            self.assertTrue(client.invert(POINTS, progress=lambda _: None).converged)

    def test_unreadable_replies_are_named_where_nothing_else_comes(self):
        def old(hub, channel, payload):
            hub.send(f"GENIO_REPLY.{request_of(payload).client}", b"another version")
        with FakeHub(old) as hub, Client(hub.url) as client:
            with self.assertRaisesRegex(NoReply, "fingerprint"):
                client.invert(POINTS, timeout_s=0.5)

    def test_a_hub_that_talks_nonsense_is_left_and_found_again(self):
        def nonsense(hub, channel, payload):
            if hub.accepted == 1:
                hub.send_raw(b"\0\0\0\1\xff\xff\xff\xff")
            elif channel == "GENIO_REQUEST":
                hub.reply(request_of(payload))
        with FakeHub(nonsense) as hub, Client(hub.url) as client:
            self.assertTrue(client.invert(POINTS).converged)
            self.assertEqual(hub.accepted, 2)

    def test_answers_to_others_are_not_taken(self):
        def other_first(hub, channel, payload):
            if channel == "GENIO_REQUEST":
                request = request_of(payload)
                wanted, request.id = request.id, "other"
                hub.reply(request, "failed")
                request.id = wanted
                hub.reply(request)
        with FakeHub(other_first) as hub, Client(hub.url) as client:
            self.assertTrue(client.invert(POINTS).converged)

    def test_ids_are_new_in_every_run_of_a_client(self):
        with FakeHub(answering()) as hub:
            ids = set()
            for _ in range(3):
                with Client(hub.url, name="lab") as client:
                    ids.add(client.invert(POINTS).id)
        self.assertEqual(len(ids), 3)

    def test_two_threads_cannot_share_a_client(self):
        with FakeHub() as hub, Client(hub.url) as client:
            waiting = threading.Event()
            def wait():
                client.ask(POINTS, id="a")
                waiting.set()
                try:
                    client.answer("a", timeout_s=2)
                except NoReply:
                    pass
            thread = threading.Thread(target=wait)
            thread.start()
            waiting.wait()
            time.sleep(0.1)
            for call in (client.status, lambda: client.ask(POINTS, id="b"),
                         lambda: client.cancel("a"), lambda: client.answer("a")):
                with self.assertRaisesRegex(GenioError, "thread"):
                    call()
            thread.join()
            self.assertNotIn("b", [request_of(p).id for p in hub.of("GENIO_REQUEST")])

    def test_a_closed_client_says_so(self):
        with FakeHub() as hub:
            with Client(hub.url) as client:
                pass
            for call in (client.status, lambda: client.invert(POINTS), lambda: client.cancel("a")):
                with self.assertRaisesRegex(GenioError, "closed"):
                    call()
            client.close()
            self.assertEqual(hub.accepted, 1)


class Refusing(unittest.TestCase):
    def test_a_refusal_for_good_is_an_answer_and_acknowledges_nothing(self):
        with FakeHub(answering("refused", message="the id is taken")) as hub:
            with Client(hub.url) as client:
                answer = client.invert(POINTS)
                self.assertEqual((answer.status, answer.message), ("refused", "the id is taken"))
                client.ask(POINTS)
            self.assertTrue(hub.eventually(lambda: len(hub.of("GENIO_REQUEST")) == 2))
            self.assertEqual(hub.of("GENIO_ACK"), [])

    def test_a_refusal_for_the_time_being_is_asked_again(self):
        def full_twice(hub, channel, payload):
            if channel == "GENIO_REQUEST":
                full = len(hub.of("GENIO_REQUEST")) < 3
                hub.reply(request_of(payload), "refused" if full else "converged",
                          retry_after_s=0.05 if full else 0.0)
        with FakeHub(full_twice) as hub, Client(hub.url) as client:
            self.assertTrue(client.invert(POINTS).converged)
            self.assertEqual(len(hub.of("GENIO_REQUEST")), 3)

    def test_a_refusal_that_outlasts_the_limit_is_the_answer(self):
        with FakeHub(answering("refused", retry_after_s=100.0)) as hub, Client(hub.url) as client:
            self.assertEqual(client.invert(POINTS, timeout_s=50).status, "refused")


class Status(unittest.TestCase):
    def test_a_status_is_asked_for_and_then_no_longer_heard(self):
        def status(hub, channel, payload):
            if channel == "GENIO_ASK_STATUS":
                s = messages.server_status_t()
                s.version, s.model_count, s.model, s.model_hash = "9", 1, ["m"], ["ab"]
                hub.send("GENIO_STATUS", wire.encode(s))
        with FakeHub(status) as hub, Client(hub.url) as client:
            for _ in range(2):
                self.assertEqual(client.status().models, {"m": "ab"})
            self.assertEqual(hub.subscribed.count("GENIO_STATUS"), 2)

    def test_a_status_that_came_too_late_is_not_taken_for_a_new_one(self):
        def two_at_once(hub, channel, payload):
            if channel == "GENIO_ASK_STATUS":
                for k in range(2):
                    s = messages.server_status_t()
                    s.received = 2 * len(hub.of(channel)) + k
                    hub.send("GENIO_STATUS", wire.encode(s))
        with FakeHub(two_at_once) as hub, Client(hub.url) as client:
            self.assertEqual(client.status().raw.received, 2)
            time.sleep(0.2)
            self.assertEqual(client.status().raw.received, 4)


if __name__ == "__main__":
    unittest.main()
