"""The client beside a real server."""
import json
import unittest
from contextlib import ExitStack

from genio_client import Client, NoReply, read_frames
from running import EXAMPLE, GENIO, PATIENCE_S, WORD, Serving, eventually

LONG = {"starts": 1000}  # no machine computes it within a test
PATIENT = {"timeout_s": PATIENCE_S}


class OneServer(Serving):
    shared = True

    def test_a_frame_gets_the_forces_that_genio_request_gets(self):
        frame = read_frames(EXAMPLE)[0]
        stages = []
        with Client(self.server.url) as client:
            answer = client.invert(frame.points, **frame.options(), **PATIENT,
                                   progress=lambda p: stages.append(p.stage))
        self.assertEqual((answer.status, answer.verdict), ("converged", "explained"))
        self.assertEqual((stages[0], stages[-1]), ("queued", "running"))
        expected = json.loads(self.output_of(GENIO, "request", "--lcm", self.server.url,
                                             "--target", EXAMPLE, "--json"))
        muscles = answer.muscles.items()
        self.same_numbers(answer.forces_N, expected["forces_N"])
        self.same_numbers({n: m.median_N for n, m in muscles}, expected["median_N"])
        self.same_numbers({n: m.acts for n, m in muscles}, expected["acts"])
        self.same_numbers({n: m.low_N for n, m in muscles},
                          {n: low for n, (low, _) in expected["interval90_N"].items()})
        self.assertAlmostEqual(answer.rms_mm, expected["rms_mm"], places=6)
        self.assertGreater(len(answer.line), 10)

    def test_a_stream_is_answered_in_order(self):
        frames = read_frames(WORD)
        with Client(self.server.url) as client:
            stream = client.stream("word", **PATIENT)
            for frame in frames:
                stream.send(frame)
            answers = list(stream)
        self.assertEqual([(a.status, a.time_s) for a in answers],
                         [("converged", f.time_s) for f in frames])

    def test_what_runs_and_what_waits_can_be_cancelled(self):
        points = read_frames(EXAMPLE)[0].points
        with Client(self.server.url) as client, Client(self.server.url) as other:
            running, waiting = client.ask(points, **LONG), client.ask(points, **LONG)
            refused = other.cancel(waiting, **PATIENT)
            self.assertEqual((refused.status, refused.id), ("refused", waiting))
            self.assertEqual(client.cancel(waiting, **PATIENT).status, "cancelled")
            self.assertEqual(client.cancel(running, **PATIENT).status, "cancelled")
            self.assertEqual(client.answer(running).status, "cancelled")
            self.assertEqual(client.cancel("unknown", **PATIENT).status, "refused")

    def test_at_the_deadline_comes_the_best_so_far(self):
        points = read_frames(EXAMPLE)[0].points
        with Client(self.server.url) as client:
            answer = client.invert(points, **LONG, deadline_s=3, **PATIENT)
        self.assertEqual(answer.status, "deadline")

    def test_what_the_service_refuses_is_an_answer_that_names_the_field(self):
        with Client(self.server.url) as client:
            answer = client.invert([(1, 2)], priority=11, **PATIENT)
        self.assertEqual(answer.status, "refused")
        self.assertIn("priority", answer.message)


    def test_many_clients_may_be_there_at_once(self):
        with ExitStack() as clients:
            many = [clients.enter_context(Client(self.server.url)) for _ in range(120)]
            versions = {client.status(**PATIENT).version for client in many[::30]}
        self.assertEqual(len(versions), 1)


class ServersThatEnd(Serving):
    def test_a_killed_server_with_a_journal_owes_no_reply(self):
        journal = self.folder / "journal"
        server = self.serve("--journal", journal)
        frames = read_frames(WORD)
        with Client(server.url) as client:
            stream = client.stream("word", **PATIENT)
            for frame in frames:
                stream.send(frame)
            answers = [next(stream)]
            server.kill_and_start_again()
            answers += stream
        self.assertEqual([(a.status, a.time_s) for a in answers],
                         [("converged", f.time_s) for f in frames])
        # The acknowledgement of the first may have come to the server that was killed; that of the
        # last is on its way.
        def delivered():
            listed = self.output_of(GENIO, "journal", journal, "list")
            return listed.count("\tdelivered\tconverged\t")
        eventually(lambda: delivered() >= len(frames) - 1)
        server.stop()
        listed = self.output_of(GENIO, "journal", journal, "list")
        self.assertGreaterEqual(listed.count("\tdelivered\tconverged\t"), len(frames) - 1, listed)
        self.assertEqual(listed.count("\tconverged\t"), len(frames), listed)

    def test_a_killed_server_without_a_journal_is_asked_again(self):
        server = self.serve()
        frame = read_frames(EXAMPLE)[0]
        killed = []

        def kill_once(progress):
            if not killed and progress.stage == "running":
                killed.append(progress.id)
                server.kill_and_start_again()

        with Client(server.url) as client:
            answer = client.invert(frame.points, **PATIENT, progress=kill_once)
            self.assertTrue(answer.converged)
            self.assertEqual(killed, [answer.id])
            server.stop()
            with self.assertRaisesRegex(NoReply, "refused"):
                client.invert(frame.points, timeout_s=2)


if __name__ == "__main__":
    unittest.main()
