"""The client against hubs and services that fail in every way. No wait is without an end."""
import math
import threading
import time
import unittest
from unittest import mock

from fake_hub import FakeHub, answering, cancel_of, request_of
from genio_client import Client, GenioError, HubError, InvalidInput, NoReply, messages, wire
from genio_client.seal import seal_of

POINTS = [(60.0, 90.0), (50.0, 95.0)]
QUICK = mock.patch("genio_client.pending.PAUSES_S", (0.05, 0.2))


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


class Asking(unittest.TestCase):
    def test_an_answer_is_plain_values_and_is_acknowledged(self):
        fields = dict(muscle_count=2, muscle=["GGP", "SL"], alternative_count=1,
                      alternative_weight=[0.25], alternative_rms_mm=[0.5],
                      alternative_force_count=2, alternative_force_N=[3.0, 4.0],
                      group_count=1, unidentified=["GGP+SL"], rms_mm=0.5, line_count=1,
                      line_x_mm=[1.0], line_z_mm=[2.0], registration='{"scale": 1.5}')
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
