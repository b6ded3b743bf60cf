"""A hub on a free port of this host that does what a test wants of it."""
import socket
import struct
import threading
import time

from genio_client import messages, tcpq, wire


class FakeHub:
    """Greets, and gives every publication to `on_message(hub, channel, payload)`, which may call
    reply() or drop(). `greeting` None: never says a word."""

    def __init__(self, on_message=lambda *_: None, greeting=tcpq.greeting(tcpq.SERVER_MARK)):
        self.on_message, self.greeting = on_message, greeting
        self.published, self.subscribed = [], []  # (channel, payload), patterns
        self.accepted = 0
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"tcpq://127.0.0.1:{self._listener.getsockname()[1]}"
        self._connection = None
        threading.Thread(target=self._serve, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        self.drop()

    def send(self, channel, payload):
        self._connection.sendall(tcpq.publication(channel, payload))

    def send_raw(self, data):
        self._connection.sendall(data)

    def reply(self, request, status="converged", **fields):
        """To a shape_request_t or a cancel_t."""
        r = messages.command_reply_t()
        r.id, r.status, r.verdict = request.id, status, "explained"
        for name, value in fields.items():
            setattr(r, name, value)
        self.send(f"GENIO_REPLY.{request.client}", wire.encode(r))

    def progress(self, request, stage, iteration=0):
        p = messages.progress_t()
        p.id, p.stage, p.iteration = request.id, stage, iteration
        self.send(f"GENIO_PROGRESS.{request.client}", wire.encode(p))

    def drop(self):
        if self._connection:
            try:
                self._connection.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def of(self, channel):
        return [payload for name, payload in self.published if name == channel]

    def eventually(self, condition, longest_s=20):
        until = time.monotonic() + longest_s
        while not condition():
            if time.monotonic() > until:
                return False
            time.sleep(0.01)
        return True

    def _serve(self):
        while True:
            try:
                self._connection, _ = self._listener.accept()
            except OSError:
                return
            self.accepted += 1
            try:
                if self.greeting is not None:
                    self._connection.sendall(self.greeting)
                self._read(self._connection.makefile("rb"))
            except (OSError, struct.error):
                pass
            self._connection.close()

    def _read(self, stream):
        stream.read(tcpq.GREETING_BYTES)
        while True:
            kind, length = struct.unpack(">II", stream.read(8))
            name = stream.read(length).decode()
            if kind == tcpq.PUBLISH:
                payload = stream.read(struct.unpack(">I", stream.read(4))[0])
                self.published.append((name, payload))
                self.on_message(self, name, payload)
            elif kind == tcpq.SUBSCRIBE:
                self.subscribed.append(name)


def request_of(payload):
    return wire.decode(messages.shape_request_t, payload)


def cancel_of(payload):
    return wire.decode(messages.cancel_t, payload)


def answering(status="converged", **fields):
    """For a hub behind which a service answers each request at once."""
    def on_message(hub, channel, payload):
        if channel == "GENIO_REQUEST":
            hub.reply(request_of(payload), status, **fields)
    return on_message
