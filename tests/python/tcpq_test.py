"""The protocol of the hub, as bytes."""
import struct
import unittest

from genio_client import tcpq

MANY = [("GENIO_STATUS", b""), ("A.b", bytes(range(256)) * 40), ("Ä", b"x")]


class Tcpq(unittest.TestCase):
    def test_the_words_are_those_of_lcm(self):
        self.assertEqual(tcpq.greeting(), bytes.fromhex("287617fb 00000100"))
        self.assertEqual(tcpq.publication("AB", b"xyz"),
                         bytes.fromhex("00000001 00000002 4142 00000003 78797a"))
        self.assertEqual(tcpq.subscription("A.*"), bytes.fromhex("00000002 00000003 412e2a"))
        self.assertEqual(tcpq.subscription("A", tcpq.UNSUBSCRIBE),
                         bytes.fromhex("00000003 00000001 41"))

    def test_publications_come_whole_however_they_are_cut(self):
        data = b"".join(tcpq.publication(*p) for p in MANY)
        for size in (1, 2, 3, 7, 100, len(data)):
            reader, got = tcpq.Publications(), []
            for at in range(0, len(data), size):
                got += reader.take(data[at:at + size])
            self.assertEqual(got, MANY, size)

    def test_lengths_are_refused_as_soon_as_they_are_read(self):
        for data in (struct.pack(">II", 1, 257), struct.pack(">II", 1, 0xFFFFFFFF),
                     struct.pack(">II2sI", 1, 2, b"AB", tcpq.MAX_PAYLOAD_BYTES + 1),
                     struct.pack(">II2sI", 1, 2, b"AB", 0xFFFFFFFF),
                     struct.pack(">I", 2), struct.pack(">I", 0x287617FA), b"HTTP/1.1 400"):
            with self.assertRaises(tcpq.ProtocolError):
                list(tcpq.Publications().take(data))

    def test_a_channel_that_is_no_text_is_no_error(self):
        [(channel, payload)] = tcpq.Publications().take(struct.pack(">II2sI", 1, 2, b"\xff\xfe", 0))
        self.assertEqual((len(channel), payload), (2, b""))

    def test_only_a_hub_greets_as_one(self):
        tcpq.check_greeting(tcpq.greeting(tcpq.SERVER_MARK))
        for data in (b"", tcpq.greeting(), b"HTTP/1.1", tcpq.greeting(tcpq.SERVER_MARK)[:7]):
            with self.assertRaises(tcpq.ProtocolError):
                tcpq.check_greeting(data)


if __name__ == "__main__":
    unittest.main()
