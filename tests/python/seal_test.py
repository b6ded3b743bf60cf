"""Sealed messages: what was not sealed with the key, for the channel and just now is not taken."""
import os
import pathlib
import random
import tempfile
import unittest
from unittest import mock

from genio_client import Client, InvalidInput, MessageError
from genio_client.seal import NoSeal, Seal, seal_of

KEY = bytes(range(32))
NOW_US = 1800000000123456
# The example of docs/threat-model.md.
EXAMPLE = bytes.fromhex("fe11e72441b4c733 00066517289a6240 6465666768696a6b6c6d6e6f70717273"
                        "0000000a 47454e494f5f41434b00 00000004 626f6479"
                        "ce03480c7057cbb4ae596d9bf2f4d029ae561625dd5a2a7f83c32c1c01986f2f")


class Sealing(unittest.TestCase):
    def setUp(self):
        self.now = NOW_US
        patch = mock.patch("genio_client.seal._now_us", lambda: self.now)
        patch.start()
        self.addCleanup(patch.stop)
        self.seal = Seal(KEY)

    def test_the_example_of_the_page_is_made_and_taken(self):
        made = self.seal.sealed("GENIO_ACK", b"body", NOW_US, bytes(range(100, 116)))
        self.assertEqual(made, EXAMPLE)
        self.assertEqual(self.seal.unwrap("GENIO_ACK", EXAMPLE), b"body")

    def test_what_is_sealed_is_opened_once(self):
        for message in (b"", b"x" * (4 << 20)):
            sealed = self.seal.wrap("C", message)
            self.assertEqual(self.seal.unwrap("C", sealed), message)
            with self.assertRaisesRegex(MessageError, "came before"):
                self.seal.unwrap("C", sealed)

    def test_no_two_seals_are_alike(self):
        self.assertEqual(len({self.seal.wrap("C", b"same") for _ in range(100)}), 100)

    def test_every_flipped_bit_is_found(self):
        for bit in range(8 * len(EXAMPLE)):
            changed = bytearray(EXAMPLE)
            changed[bit // 8] ^= 1 << bit % 8
            with self.assertRaises(MessageError):
                self.seal.unwrap("GENIO_ACK", bytes(changed))

    def test_what_is_cut_or_longer_is_refused(self):
        for size in range(len(EXAMPLE)):
            with self.assertRaises(MessageError):
                self.seal.unwrap("GENIO_ACK", EXAMPLE[:size])
        with self.assertRaises(MessageError):
            self.seal.unwrap("GENIO_ACK", EXAMPLE + b"\0")

    def test_another_key_another_channel_or_none_is_refused(self):
        with self.assertRaisesRegex(MessageError, "another key"):
            Seal(KEY[::-1]).unwrap("GENIO_ACK", EXAMPLE)
        for channel in ("GENIO_CANCEL", "GENIO_AC", "GENIO_ACKS", ""):
            with self.assertRaisesRegex(MessageError, "another channel"):
                self.seal.unwrap(channel, EXAMPLE)
        with self.assertRaisesRegex(MessageError, "without a key"):
            self.seal.unwrap("GENIO_ACK", b"plain")
        with self.assertRaisesRegex(MessageError, "a key is needed"):
            NoSeal().unwrap("GENIO_ACK", EXAMPLE)

    def test_a_right_seal_with_wrong_lengths_is_refused(self):
        """Only who has the key can make one."""
        at_size = EXAMPLE.index(b"\0\0\0\4body")
        for size in (b"\0\0\0\3", b"\0\0\0\5", b"\xff\xff\xff\xff", b""):
            above = EXAMPLE[:at_size] + size + b"body"
            with self.assertRaises(MessageError):
                self.seal.unwrap("GENIO_ACK", above + self.seal._mac(above))

    def test_what_is_old_or_ahead_or_from_before_the_start_is_refused(self):
        for seconds, taken in ((0, True), (29, True), (31, False), (-0.9, True), (-1.1, False)):
            message = self.seal.sealed("C", b"", NOW_US + int(1e6 * seconds), os.urandom(16))
            if taken:
                self.seal.unwrap("C", message)
            else:
                with self.assertRaisesRegex(MessageError, "clocks", msg=seconds):
                    self.seal.unwrap("C", message)

    def test_a_full_memory_takes_nothing_twice(self):
        chance = random.Random(1)
        with mock.patch("genio_client.seal.REMEMBERED", 10):
            taken = []
            for _ in range(200):
                self.now += chance.randrange(100000)
                message = self.seal.sealed("C", b"", self.now - chance.randrange(200000),
                                           chance.randbytes(16))
                try:
                    self.seal.unwrap("C", message)
                    taken.append(message)
                except MessageError:
                    pass
                self.assertLessEqual(len(self.seal._seen), 10)
            self.assertGreater(len(taken), 50)
            for message in taken:
                with self.assertRaises(MessageError):
                    self.seal.unwrap("C", message)


class Keys(unittest.TestCase):
    def file(self, text, mode=0o600):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "genio.key"
        path.write_bytes(text)
        path.chmod(mode)
        return path

    def test_a_key_is_bytes_or_a_file(self):
        digits = KEY.hex().encode()
        for key in (KEY, self.file(digits), self.file(digits + b"\n"), str(self.file(digits)),
                    self.file(digits.upper(), 0o400)):
            self.assertEqual(seal_of(key)._key, KEY)
        self.assertIsInstance(seal_of(None), NoSeal)

    def test_what_is_no_key_is_refused(self):
        digits = KEY.hex().encode()
        for text in (b"", digits[:-1], digits + b"0", digits + b"\n\n", digits[:-1] + b"g",
                     digits[:-3] + b" ab", b"\xff" * 64):
            with self.assertRaisesRegex(InvalidInput, "no key"):
                seal_of(self.file(text))
        with self.assertRaisesRegex(InvalidInput, "expected 32"):
            seal_of(KEY[:-1])
        with self.assertRaisesRegex(InvalidInput, "nowhere"):
            seal_of("nowhere.key")
        with self.assertRaises(InvalidInput):
            Client("tcpq://127.0.0.1:1", key="nowhere.key")

    def test_a_file_that_others_may_read_or_that_is_none_is_refused(self):
        for mode in (0o640, 0o604, 0o620, 0o602, 0o644, 0o610):
            with self.assertRaisesRegex(InvalidInput, "chmod"):
                seal_of(self.file(KEY.hex().encode(), mode))
        pipe = self.file(b"").with_name("pipe")
        os.mkfifo(pipe, 0o600)
        with self.assertRaisesRegex(InvalidInput, "no file"):
            seal_of(pipe)


if __name__ == "__main__":
    unittest.main()
