"""A server, and programs beside it, that end with the test. Environment: GENIO is the program."""
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from genio_client import Client, HubError, NoReply

SOURCE = pathlib.Path(__file__).resolve().parents[3]
EXAMPLE = SOURCE / "data/examples/example_shape.csv"
WORD = SOURCE / "data/examples/word/contours.csv"
GENIO = os.environ.get("GENIO", "genio")
PATIENCE_S = 300.0  # the machine may be busy


def start(*words, output=subprocess.DEVNULL):
    return subprocess.Popen([str(w) for w in words], cwd=SOURCE, stdout=output,
                            stderr=subprocess.STDOUT)


def end(program):
    program.kill()
    program.wait()


def eventually(condition):
    """True as soon as it holds; False where it did not happen in all that time."""
    until = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > until:
            return False
        time.sleep(0.05)
    return True


class Server:
    """`genio serve` on a port of its own, which it keeps when it is started again."""

    def __init__(self, folder, *options, key=None):
        with socket.create_server(("127.0.0.1", 0)) as listener:
            self.port = listener.getsockname()[1]
        self.url = f"tcpq://127.0.0.1:{self.port}"
        self._log = folder / f"serve{self.port}.log"
        self._options, self._key = options, key
        self._start()
        self._await()

    def _start(self):
        with open(self._log, "ab") as log:
            self._program = start(GENIO, "serve", "--lcm", self.url, *self._options, output=log)

    def _await(self):
        until = time.monotonic() + PATIENCE_S
        while True:
            try:
                with Client(self.url, key=self._key, connect_timeout_s=1) as client:
                    client.status(timeout_s=5)
                return
            except (HubError, NoReply) as error:
                if self._program.poll() is not None or time.monotonic() > until:
                    self.kill()
                    raise AssertionError(f"no server: {error}\n{self._log.read_text()}") from None

    def kill(self):
        end(self._program)

    def kill_and_start_again(self):
        """As after a power failure. Does not wait for the new one."""
        self.kill()
        self._start()

    def stop(self):
        self._program.send_signal(signal.SIGTERM)
        self._program.wait(PATIENCE_S)


class Serving(unittest.TestCase):
    """Its tests share a server where `shared`, and start servers of their own else. Each has a
    folder."""

    shared = False

    @classmethod
    def setUpClass(cls):
        if cls.shared:
            folder = tempfile.TemporaryDirectory()
            cls.addClassCleanup(folder.cleanup)
            cls.server = Server(pathlib.Path(folder.name))
            cls.addClassCleanup(cls.server.kill)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def serve(self, *options, key=None):
        server = Server(self.folder, *options, key=key)
        self.addCleanup(server.kill)
        return server

    def output_of(self, *words, **environment):
        """What a program prints; it must end well."""
        done = subprocess.run([str(w) for w in words], cwd=SOURCE, text=True, timeout=PATIENCE_S,
                              capture_output=True, check=False, env={**os.environ, **environment})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def same_numbers(self, a, b):
        """[N], by name; what is written and read again is rounded."""
        self.assertEqual(a.keys(), b.keys())
        for name in a:
            self.assertAlmostEqual(a[name], b[name], places=6, msg=name)
