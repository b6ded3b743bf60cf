"""From arguments to a request: what is wrong is named before anything is sent."""
import math
import pathlib
import tempfile
import unittest

from genio_client import InvalidInput, read_frames
from genio_client.address import choose_url, host_and_port
from genio_client.request import encode_request, make_request

POINTS = [(60.0, 90.0), (50.5, 95)]


class Request(unittest.TestCase):
    def test_points_have_two_or_three_coordinates(self):
        r = make_request([(1, 2), [3, 4, 5]])
        self.assertEqual((r.point_count, r.x_mm, r.z_mm), (2, [1, 3], [2, 5]))
        self.assertTrue(math.isnan(r.y_mm[0]))
        self.assertEqual(r.y_mm[1], 4)
        self.assertEqual((r.kind, r.sigma_mm, r.bilateral), (["curve"] * 2, [0, 0], -1))

    def test_what_holds_for_all_points_is_said_once(self):
        r = make_request(POINTS, kinds="surface", sigma_mm=0.3)
        self.assertEqual((r.kind, r.sigma_mm), (["surface"] * 2, [0.3] * 2))
        r = make_request(POINTS, kinds=["tip", "curve"], sigma_mm=(0.3, 1))
        self.assertEqual((r.kind, r.sigma_mm), (["tip", "curve"], [0.3, 1]))

    def test_every_option_stands_in_its_field(self):
        r = make_request(POINTS, model="m", prior="a = 1", label="i", time_s=0.5, priority=-3,
                         deadline_s=2, bilateral=False, starts=7)
        self.assertEqual((r.model, r.prior, r.label, r.time_s, r.priority, r.deadline_s,
                          r.bilateral, r.starts), ("m", "a = 1", "i", 0.5, -3, 2, 0, 7))
        r = make_request(POINTS, palate=[(1, 2), (3, 4)])
        self.assertEqual((r.frame, r.palate_count, r.palate_x_mm, r.palate_z_mm),
                         ("device", 2, [1, 3], [2, 4]))
        r = make_request(POINTS, placed=(1.1, 2, 3, 4), bilateral=True)
        self.assertEqual((r.frame, r.scale, r.tilt_deg, r.shift_x_mm, r.shift_z_mm, r.bilateral),
                         ("placed", 1.1, 2, 3, 4, 1))
        self.assertEqual((r.shift_sd_mm, r.tilt_sd_deg), (0, 0))
        r = make_request(POINTS, placed=(1.1, 2, 3, 4, 0.5, 0.25))
        self.assertEqual((r.shift_z_mm, r.shift_sd_mm, r.tilt_sd_deg), (4, 0.5, 0.25))
        self.assertTrue(math.isnan(make_request(POINTS).time_s))

    def test_what_is_wrong_is_named(self):
        many = [(0.0, 0.0)] * 20001
        for name, points, options in (
                ("point 2", [(1, 2), (1,)], {}), ("point 1", [(1, "b")], {}), ("point 1", [3], {}),
                ("points", many, {}), ("palate", POINTS, {"palate": many}),
                ("palate point 1", POINTS, {"palate": [(1, 2, 3)]}),
                ("placed", POINTS, {"placed": (1, 2)}), ("placed", POINTS, {"placed": range(5)}),
                ("palate", POINTS, {"palate": POINTS, "placed": (1, 0, 0, 0)}),
                ("kinds", POINTS, {"kinds": ["tip"]}), ("kinds", POINTS, {"kinds": [1, 2]}),
                ("sigma_mm", POINTS, {"sigma_mm": [1]}), ("sigma_mm", POINTS, {"sigma_mm": "a"}),
                ("model", POINTS, {"model": "a\0b"}), ("label", POINTS, {"label": "\ud800"}),
                ("prior", POINTS, {"prior": "x" * 65537}), ("label", POINTS, {"label": 3}),
                ("prior", POINTS, {"prior": pathlib.Path("/nowhere.toml")}),
                ("priority", POINTS, {"priority": 2**31}), ("starts", POINTS, {"starts": 1.5}),
                ("deadline_s", POINTS, {"deadline_s": "soon"})):
            with self.assertRaisesRegex(InvalidInput, name, msg=name):
                make_request(points, **options)
        with self.assertRaises(TypeError):
            make_request(POINTS, modle="m")

    def test_a_request_above_the_limit_is_refused(self):
        with self.assertRaisesRegex(InvalidInput, "at most 4194304"):
            encode_request(make_request(POINTS * 9000, kinds="k" * 300))

    def test_a_prior_may_be_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "prior.toml"
            file.write_text("noise_mm = 1\n")
            self.assertEqual(make_request(POINTS, prior=file).prior, "noise_mm = 1\n")


class Frames(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.csv"
            file.write_bytes(text if isinstance(text, bytes) else text.encode())
            return read_frames(file)

    def test_a_table_is_read_frame_by_frame(self):
        one, two = self.read("frame,point,x_mm,y_mm,z_mm,sigma_mm,kind,label,time_s\n"
                             "1,1,1,,2,0.3,tip,i,0.25\n1,2,3,4,5,,,i,0.25\n2,1,6,,7,,,,\n")
        self.assertEqual(one.points[1], (3, 4, 5))
        self.assertTrue(math.isnan(one.points[0][1]))
        self.assertEqual((one.kinds, one.sigma_mm, one.label, one.time_s),
                         (["tip", "curve"], [0.3, 0], "i", 0.25))
        self.assertEqual((two.label, math.isnan(two.time_s)), ("", True))
        self.assertEqual(make_request(one.points, **one.options()).point_count, 2)

    def test_what_is_wrong_names_file_and_line(self):
        for expected, text in (("a.csv:3", "frame,x_mm,z_mm\n1,1,2\n1,x,2\n"),
                               ("a.csv:2", "frame,x_mm,z_mm\n1,1\n"),
                               ("no column z_mm", "frame,x_mm\n1,1\n"), ("no column", ""),
                               ("a.csv", b"frame,x_mm,z_mm\n1,1,\xff\n")):
            with self.assertRaisesRegex(InvalidInput, expected):
                self.read(text)
        with self.assertRaisesRegex(InvalidInput, "nowhere"):
            read_frames("nowhere.csv")


class Address(unittest.TestCase):
    def test_a_url_has_host_and_port_or_leaves_them_out(self):
        self.assertEqual(host_and_port("tcpq://a.b:12"), ("a.b", 12))
        self.assertEqual(host_and_port("tcpq://"), ("127.0.0.1", 7700))
        self.assertEqual(host_and_port("tcpq://:8000?x=1"), ("127.0.0.1", 8000))

    def test_any_other_url_is_refused(self):
        for url in ("udpm://239.255.76.67:7667", "tcpq:/a", "tcpq://a:0", "tcpq://a:07700", "",
                    "tcpq://a:70000", "tcpq://a:b", "tcpq://a b:1", "tcpq://a:1:2"):
            with self.assertRaisesRegex(InvalidInput, "url", msg=url):
                host_and_port(url)

    def test_the_environment_counts_where_nothing_is_said(self):
        import os
        from unittest import mock
        with mock.patch.dict(os.environ, {"LCM_DEFAULT_URL": "tcpq://:1"}):
            self.assertEqual(choose_url(None), "tcpq://:1")
            self.assertEqual(choose_url("tcpq://:2"), "tcpq://:2")
        with mock.patch.dict(os.environ, {"LCM_DEFAULT_URL": ""}):
            self.assertEqual(choose_url(None), "tcpq://127.0.0.1:7700")


if __name__ == "__main__":
    unittest.main()
