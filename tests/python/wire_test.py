"""Messages as bytes: nothing of the wire is believed."""
import math
import pathlib
import random
import re
import struct
import tracemalloc
import unittest

from genio_client import MessageError, messages, wire

SOURCE = pathlib.Path(__file__).resolve().parents[2]
TYPES = [getattr(messages, name) for name in messages.__all__]
LETTERS = {"int64_t": "l", "int32_t": "i", "int8_t": "b", "double": "d", "string": "s"}


def layout_of_file(name):
    text = re.sub(r"//.*", "", (SOURCE / "messages" / f"{name}.lcm").read_text())
    body = text[text.index("{"):]
    fields = re.findall(r"(\w+)\s+(\w+)(?:\[(\w+)\])?;", body)
    counts = {count for _, _, count in fields if count}
    return "".join("n" if name in counts else LETTERS[kind].upper() if count else LETTERS[kind]
                   for kind, name, count in fields)


def reply():
    """A reply with something in every kind of field."""
    r = messages.command_reply_t()
    r.id, r.status, r.time_s = "a-1", "converged", math.nan
    r.muscle_count, r.muscle = 2, ["GGP", "Zungenmuskel-ä"]
    for field in ("force_N", "max_force_N", "sd_N", "low_N", "high_N", "acts", "median_N", "mean_N",
                  "information_bits"):
        setattr(r, field, [1.5, math.nan])
    r.trade_count, r.trade_group, r.trade_muscle, r.trade_amount_N = 1, [7], ["GGP"], [0.25]
    return r


class Wire(unittest.TestCase):
    def test_the_layouts_are_those_of_the_message_files(self):
        self.assertEqual(set(messages.__all__), set(wire.LAYOUTS))
        for name in messages.__all__:
            self.assertEqual(wire.LAYOUTS[name], layout_of_file(name), name)

    def test_what_was_encoded_is_decoded(self):
        for kind in TYPES:
            data = wire.encode(kind())
            self.assertEqual(wire.encode(wire.decode(kind, data)), data)
        r = wire.decode(messages.command_reply_t, wire.encode(reply()))
        self.assertEqual((r.id, r.muscle, r.trade_group), ("a-1", ["GGP", "Zungenmuskel-ä"], (7,)))

    def test_a_message_cut_anywhere_is_refused(self):
        data = wire.encode(reply())
        for size in range(len(data)):
            with self.assertRaises(MessageError):
                wire.decode(messages.command_reply_t, data[:size])

    def test_bytes_after_the_end_are_refused(self):
        for kind in TYPES:
            with self.assertRaisesRegex(MessageError, "after the end"):
                wire.decode(kind, wire.encode(kind()) + b"\0")

    def test_one_type_is_not_taken_for_another(self):
        for kind in TYPES:
            for other in TYPES:
                if kind._get_packed_fingerprint() != other._get_packed_fingerprint():
                    with self.assertRaisesRegex(MessageError, "fingerprint"):
                        wire.decode(kind, wire.encode(other()))

    def test_hostile_lengths_are_refused_before_anything_is_made(self):
        data = bytearray(wire.encode(reply()))
        count_at = data.index(b"\0\0\0\2\0\0\0\4GGP")  # of the muscles
        string_at = count_at + 4
        tracemalloc.start()
        for at in (count_at, string_at):
            for length in (-1, -2**31, 0x20000000, 2**31 - 1, 20001, 65538):
                hostile = bytearray(data)
                hostile[at:at + 4] = struct.pack(">i", length)
                with self.assertRaises(MessageError):
                    wire.decode(messages.command_reply_t, bytes(hostile))
        with self.assertRaises(MessageError):  # a string has its end at least
            wire.decode(messages.command_reply_t,
                        bytes(data[:string_at] + b"\0\0\0\0" + data[string_at + 8:]))
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        self.assertLess(peak, 1 << 20)

    def test_a_string_ends_with_a_zero(self):
        data = wire.encode(reply())
        with self.assertRaisesRegex(MessageError, "zero"):
            wire.decode(messages.command_reply_t, data.replace(b"GGP\0", b"GGPX", 1))

    def test_a_message_above_the_limit_is_refused_both_ways(self):
        huge = messages.progress_t._get_packed_fingerprint() + bytes(wire.MAX_MESSAGE_BYTES)
        with self.assertRaisesRegex(MessageError, "at most"):
            wire.decode(messages.progress_t, huge)
        p = messages.progress_t()
        p.id = "x" * wire.MAX_MESSAGE_BYTES
        with self.assertRaisesRegex(MessageError, "at most"):
            wire.encode(p)

    def test_changed_bytes_are_decoded_or_refused_and_nothing_else(self):
        chance = random.Random(25)
        data = wire.encode(reply())
        refused = 0
        for _ in range(4000):
            hostile = bytearray(data)
            for _ in range(chance.randint(1, 8)):
                hostile[chance.randrange(8, len(hostile))] = chance.randrange(256)
            try:
                wire.decode(messages.command_reply_t, bytes(hostile))
            except MessageError:
                refused += 1
        self.assertGreater(refused, 100)
        for _ in range(2000):
            with self.assertRaises(MessageError):
                wire.decode(messages.command_reply_t, chance.randbytes(chance.randrange(200)))


if __name__ == "__main__":
    unittest.main()
