"""What lcm-logger records beside the service replays to the same answers."""
import unittest

from genio_client import Client, messages, read_frames, wire
from genio_client.link import Link
from running import EXAMPLE, PATIENCE_S, Serving, end, eventually, start


class Replay(Serving):
    def test_a_recorded_request_gets_the_same_forces_of_a_fresh_server(self):
        server, record = self.serve(), self.folder / "session.log"
        logger = start("lcm-logger", f"--lcm-url={server.url}", "--quiet", "--flush-interval=10",
                       record)
        self.addCleanup(end, logger)
        # A status comes every second, so the logger has subscribed once the file grows.
        self.assertTrue(eventually(lambda: record.exists() and record.stat().st_size > 0))
        frame = read_frames(EXAMPLE)[0]
        with Client(server.url, name="recorded") as client:
            answer = client.invert(frame.points, **frame.options(), timeout_s=PATIENCE_S)
        self.assertTrue(answer.converged)
        self.assertTrue(eventually(lambda: b"GENIO_ACK" in record.read_bytes()))
        logger.terminate()
        logger.wait(PATIENCE_S)
        server.stop()

        fresh = self.serve()
        listener = Link(fresh.url)
        listener.subscribe("GENIO_REPLY.recorded")
        self.assertTrue(listener.connect(PATIENCE_S))
        player = start("lcm-logplayer", f"--lcm-url={fresh.url}", "--speed=100",
                       "--regexp=GENIO_REQUEST", record)
        self.addCleanup(end, player)
        received = listener.receive(PATIENCE_S)
        self.assertIsNotNone(received, listener.trouble)
        listener.close()
        reply = wire.decode(messages.command_reply_t, received[1])
        self.assertEqual((reply.id, reply.status), (answer.id, "converged"))
        self.assertGreater(reply.utime, answer.raw.utime)
        self.same_numbers(dict(zip(reply.muscle, reply.force_N)), answer.forces_N)
        self.assertEqual(player.wait(PATIENCE_S), 0)


if __name__ == "__main__":
    unittest.main()
