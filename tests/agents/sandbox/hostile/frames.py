"""Policies that write to the other side themselves, and what is no answer."""

from .policy import NO_ACTION, REFUSED, Hostile

FRAMES = [
    Hostile(
        name="malformed frame",
        act="send(struct.pack('>I', 4) + bytes([0xC1] * 4)); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame without a list",
        act="send(frame(7)); time.sleep(60)",
        reason="a int instead of a list",
    ),
    Hostile(
        name="frame with a map",
        act="send(frame([1, {'a': 1}])); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame without end inside",
        act="send(struct.pack('>I', 60_000) + bytes([0x91] * 60_000)); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame of other things",
        act="send(frame([[], []])); time.sleep(60)",
        reason="an answer that is not serial number, word and content",
    ),
    Hostile(
        name="oversized frame",
        act="send(struct.pack('>I', 1 << 31)); time.sleep(60)",
        reason="a message of 2147483648 bytes; at most 65536 are allowed",
    ),
    Hostile(
        name="truncated frame",
        act="send(struct.pack('>I', 100) + bytes(10)); time.sleep(60)",
        reason="sent 14 bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="closed connection",
        act="os.close(WIRE)",
        reason=REFUSED,
    ),
    Hostile(
        name="connection found by gc",
        act="""
        for each in gc.get_objects():
            if isinstance(each, socket.socket):
                each.shutdown(socket.SHUT_RDWR)
        """,
        reason=REFUSED,
    ),
    Hostile(
        name="duplicated frame",
        act="send(2 * frame([1, 'action', [0.0]])); time.sleep(60)",
        reason="more than one answer to a request",
    ),
    Hostile(
        name="answer before the answer",
        act="send(frame([1, 'action', [0.0]])); return [0.0]",
        reason=r"more than one answer to a request|answer 1 to request 2",
    ),
    Hostile(
        name="early frame",
        act="send(frame([2, 'action', [0.0]])); time.sleep(60)",
        reason="answer 2 to request 1",
    ),
    Hostile(
        name="flood of frames",
        act="while True: send(frame([1, 'action', [0.0]]))",
        reason="more than one answer to a request|answer 1 to request 2",
    ),
    Hostile(
        name="words instead of numbers",
        act="send(frame([1, 'action', ['up']])); time.sleep(60)",
        reason=NO_ACTION,
    ),
    Hostile(
        name="answer without numbers",
        act="send(frame([1, 'action'])); time.sleep(60)",
        reason=NO_ACTION,
    ),
    Hostile(
        name="answer in drops",
        act="""
        for byte in struct.pack(">I", 60_000) + bytes(60_000):
            send(bytes([byte]))
            time.sleep(0.01)
        """,
        reason=r"sent \d+ bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="another answer",
        act="send(frame([1, 'made', True])); time.sleep(60)",
        reason="answered 'made' where 'action' was due",
    ),
    Hostile(
        name="a reason that is none",
        act="send(frame([1, 'failed', ['x'] * 1000])); time.sleep(60)",
        reason="answered 'failed' where 'action' was due",
    ),
    Hostile(
        name="files sent along",
        init="self.ours = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, os.dup(WIRE))",
        act="socket.send_fds(self.ours, [b'x'], [0] * 30)",
        reason=REFUSED,
    ),
    Hostile(
        name="check taken out",
        top="import colift.agents.sandbox.guest.server as server",
        act="server.checked_action = lambda *arguments: [float('nan')]; return [0.0]",
        reason=NO_ACTION,
    ),
]
