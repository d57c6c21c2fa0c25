"""Policies that write to the other side themselves, and what is no answer."""

from .policy import ENDED, NO_ACTION, Hostile

FRAMES = [
    Hostile(
        name="malformed frame",
        act="os.write(end(), struct.pack('>I', 4) + bytes([0xC1] * 4)); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame without a list",
        act="os.write(end(), frame(7)); time.sleep(60)",
        reason="a int instead of a list",
    ),
    Hostile(
        name="frame with a map",
        act="os.write(end(), frame([1, {'a': 1}])); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame without end inside",
        act="os.write(end(), struct.pack('>I', 60_000) + bytes([0x91] * 60_000)); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame of other things",
        act="os.write(end(), frame([[], []])); time.sleep(60)",
        reason="an answer that is not serial number, word and content",
    ),
    Hostile(
        name="oversized frame",
        act="os.write(end(), struct.pack('>I', 1 << 31)); time.sleep(60)",
        reason="a message of 2147483648 bytes; at most 65536 are allowed",
    ),
    Hostile(
        name="truncated frame",
        act="os.write(end(), struct.pack('>I', 100) + bytes(10)); time.sleep(60)",
        reason="sent 14 bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="truncated frame, then closed",
        act="os.write(end(), struct.pack('>I', 100) + bytes(10)); os.close(end()); time.sleep(60)",
        reason="sent 14 bytes of an answer, then no more",
    ),
    Hostile(
        name="closed connection",
        act="os.close(end()); time.sleep(60)",
        reason="closed the connection",
    ),
    Hostile(
        name="connection found by gc",
        act="""
        for each in gc.get_objects():
            if isinstance(each, socket.socket):
                each.shutdown(socket.SHUT_RDWR)
        time.sleep(60)
        """,
        reason=f"closed the connection|{ENDED}",
    ),
    Hostile(
        name="duplicated frame",
        act="os.write(end(), 2 * frame([3, 'action', [0.0]])); time.sleep(60)",
        reason="more than one answer to a request",
    ),
    Hostile(
        name="answer before the answer",
        act="os.write(end(), frame([3, 'action', [0.0]])); return [0.0]",
        reason=r"more than one answer to a request|answer 3 to request 4",
    ),
    Hostile(
        name="late frame",
        top="""
        def late():
            time.sleep(0.1)
            os.write(end(), frame([3, "action", [0.0]]))
        """,
        act="""
        if not hasattr(self, "sent"):
            self.sent = threading.Thread(target=late)
            self.sent.start()
        else:
            time.sleep(0.3)
        return [0.0]
        """,
        reason="answer 3 to request 4",
    ),
    Hostile(
        name="early frame",
        act="os.write(end(), frame([4, 'action', [0.0]])); time.sleep(60)",
        reason="answer 4 to request 3",
    ),
    Hostile(
        name="flood of frames",
        act="while True: os.write(end(), frame([3, 'action', [0.0]]))",
        reason="more than one answer to a request|answer 3 to request 4",
    ),
    Hostile(
        name="words instead of numbers",
        act="os.write(end(), frame([3, 'action', ['up']])); time.sleep(60)",
        reason=NO_ACTION,
    ),
    Hostile(
        name="answer without numbers",
        act="os.write(end(), frame([3, 'action'])); time.sleep(60)",
        reason=NO_ACTION,
    ),
    Hostile(
        name="answer in drops",
        act="""
        for byte in struct.pack(">I", 60_000) + bytes(60_000):
            os.write(end(), bytes([byte]))
            time.sleep(0.01)
        """,
        reason=r"sent \d+ bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="another answer",
        act="os.write(end(), frame([3, 'made', True])); time.sleep(60)",
        reason="answered 'made' where 'action' was due",
    ),
    Hostile(
        name="a reason that is none",
        act="os.write(end(), frame([3, 'failed', ['x'] * 1000])); time.sleep(60)",
        reason="answered 'failed' where 'action' was due",
    ),
    Hostile(
        name="files sent along",
        act="""
        ours = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, os.dup(end()))
        for _ in range(3):
            socket.send_fds(ours, [b"\\0"], [0] * 30)
        time.sleep(60)
        """,
        reason="sent 3 bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="check taken out",
        top="import colift.agents.sandbox.guest.server as server",
        act="server.checked_action = lambda *arguments: [float('nan')]; return [0.0]",
        reason=NO_ACTION,
    ),
]
