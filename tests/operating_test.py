#!/usr/bin/env python3
"""A server as an operator sees it: systemd's protocol, metrics, logs. Usage: operating_test.py GENIO SOURCE"""
import contextlib
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

GENIO, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
LONG = 180  # seconds; the machine may be busy
folder = pathlib.Path(tempfile.mkdtemp())
urllib.request.install_opener(urllib.request.build_opener(urllib.request.ProxyHandler({})))


def free_port():
    return random.randint(20000, 32000)


class Manager:
    """What systemd is to a service of Type=notify."""

    def __init__(self, address):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(address.replace("@", "\0") if address[0] == "@" else address)
        self.heard = []
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        while True:
            self.heard.append(self.socket.recv(4096).decode())

    def wait_for(self, message, times=1):
        wait_until(lambda: self.heard.count(message) >= times, f"{message}: {self.heard}")


@contextlib.contextmanager
def server(*arguments, port, stderr, environment={}):
    process = subprocess.Popen([GENIO, "serve", "--lcm", f"tcpq://127.0.0.1:{port}", *arguments],
                               stderr=stderr, env={**os.environ, **environment})
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def request(port, *arguments, timeout=LONG):
    return subprocess.run([GENIO, "request", *arguments, "--lcm", f"tcpq://127.0.0.1:{port}",
                           "--timeout-s", str(timeout)], capture_output=True, text=True)


def get(port, path="/metrics", host=None):
    asked = urllib.request.Request(f"http://127.0.0.1:{port}{path}")
    if host:
        asked.add_header("Host", host)
    with urllib.request.urlopen(asked, timeout=LONG) as response:
        return response.headers["Content-Type"], response.read().decode()


def figure(text, name):
    return next(float(line.split()[-1]) for line in text.splitlines() if line.startswith(name + " "))


def wait_until(is_true, what):
    end = time.monotonic() + LONG
    while not is_true():
        assert time.monotonic() < end, what
        time.sleep(0.1)


def serves_and_tells(address):
    """From the start to SIGTERM, with a manager at the address."""
    port, metrics_port = free_port(), free_port()
    manager = Manager(address)
    log = folder / "log"
    with open(log, "w") as stderr, server(
            "--metrics-port", str(metrics_port), "--log-json",
            "--journal", str(folder / f"journal{port}"), port=port, stderr=stderr,
            environment={"NOTIFY_SOCKET": address, "WATCHDOG_USEC": "1000000"}) as process:
        manager.wait_for("READY=1")
        begin = time.monotonic()
        status = request(port, "status", timeout=10)
        assert status.returncode == 0, status.stderr
        print(f"a status {time.monotonic() - begin:.3f} s after READY=1, a process's start included")
        manager.wait_for("WATCHDOG=1", times=3)
        assert any(h.startswith("STATUS=0 running, 0 queued") for h in manager.heard), manager.heard

        kind, text = get(metrics_port)
        assert kind == "text/plain; version=0.0.4; charset=utf-8", kind
        assert figure(text, "genio_received_total") == 0, text
        answer = request(port, "--target", str(SOURCE / "data/examples/example_shape.csv"))
        assert answer.returncode == 0, answer.stderr
        wait_until(lambda: figure(get(metrics_port)[1], "genio_replied_total") > 0, "no reply counted")
        text = get(metrics_port)[1]
        assert figure(text, "genio_received_total") >= 1, text  # a client asks again
        assert figure(text, "genio_computed_total") == 1, text
        assert figure(text, "genio_hub_accepted_total") >= 3, text
        for path, host, code in [("/", None, 404), ("/metrics", "evil.example", 403)]:
            try:
                get(metrics_port, path, host)
                assert False, "no error"
            except urllib.error.HTTPError as e:
                assert e.code == code, e.code

        second = subprocess.run([GENIO, "serve", "--lcm", f"tcpq://127.0.0.1:{free_port()}",
                                 "--metrics-port", str(metrics_port)], capture_output=True, text=True)
        assert second.returncode == 2, second
        assert len(second.stderr.splitlines()) == 1, second.stderr
        assert f"--metrics-port {metrics_port}" in second.stderr, second.stderr

        process.send_signal(signal.SIGTERM)
        manager.wait_for("STOPPING=1")
        assert process.wait(LONG) == 0
    events = [json.loads(line) for line in log.read_text().splitlines()]
    assert [e["event"] for e in events] == ["serving", "answered", "stopped"], events
    assert events[0]["url"] == f"tcpq://127.0.0.1:{port}", events[0]
    assert events[1]["status"] == "converged" and events[1]["seconds"] > 0, events[1]
    assert events[2]["finished"] == events[2]["journalled"] == events[2]["refused"] == 0, events[2]
    assert events[2]["replied"] >= 1, events[2]


def answers_with(stderr, close):
    """Whatever became of its standard error."""
    port = free_port()
    arguments = ["--journal", str(folder / f"journal{port}")]
    command = " ".join([f"exec '{GENIO}' serve --lcm tcpq://127.0.0.1:{port}", *arguments, close])
    process = subprocess.Popen(["bash", "-c", command], stderr=stderr)
    try:
        if stderr == subprocess.PIPE:
            process.stderr.close()  # nobody reads
        answer = request(port, "--target", str(SOURCE / "data/examples/example_shape.csv"))
        assert answer.returncode == 0, answer.stderr
        assert process.poll() is None, process.returncode
        process.terminate()
        assert process.wait(LONG) == 0, process.returncode
    finally:
        process.kill()
        process.wait()
    listed = subprocess.run([GENIO, "journal", str(folder / f"journal{port}"), "list"],
                            capture_output=True, text=True)
    assert listed.returncode == 0 and "converged" in listed.stdout, listed


def bad_environment_is_named():
    with open(folder / "bad", "w") as stderr, server(
            port=free_port(), stderr=stderr, environment={"NOTIFY_SOCKET": "nowhere"}) as process:
        assert process.wait(LONG) == 2
    text = (folder / "bad").read_text()
    assert text.startswith("genio: NOTIFY_SOCKET=nowhere: expected") and text.count("\n") == 1, text


serves_and_tells(str(folder / "notify"))
serves_and_tells(f"@genio-test-{os.getpid()}")
answers_with(None, "2>&-")
answers_with(subprocess.PIPE, "")
answers_with(None, "2>/dev/full")
bad_environment_is_named()
print("told as documented")
