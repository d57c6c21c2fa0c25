"""The process of a room: a loop that sleeps to absolute deadlines, with one socket."""

import gc
import multiprocessing
import select
import signal
import socket
import time
from dataclasses import dataclass
from multiprocessing.process import BaseProcess
from typing import Final

from colift.play.rooms.priority import ORDINARY, TABLE, take_turn
from colift.play.rooms.room import Room, RoomConfig
from colift.play.rooms.seats import Message

JSON, BINARY, JOIN, LEAVE = b"J", b"B", b"+", b"-"
"""Kinds of a packet: JSON, a binary message, a seat that is taken, a seat that is left."""

LARGEST_PACKET: Final = 2**16

MOST_AT_ONCE: Final = 100
"""Packets that are read between two frames."""

SEND_S: Final = 1.0
"""Time that the room waits for a relay that accepts nothing [s]; then it ends."""


@dataclass(frozen=True)
class RoomProcess:
    """A running room, as seen by the process that relays."""

    socket: socket.socket
    """Packets to and from the room: a seat, a kind, and the message."""
    process: BaseProcess


def start_room(config: RoomConfig) -> RoomProcess:
    """Start the process of a room; it ends when its socket is closed."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([__name__])
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    process = context.Process(target=_run, args=(theirs, config), daemon=True, name="room")
    process.start()
    theirs.close()
    ours.setblocking(False)
    return RoomProcess(ours, process)


def packet(seat: int, message: str | bytes) -> bytes:
    """Return the packet of a message."""
    if isinstance(message, str):
        return bytes([seat]) + JSON + message.encode()
    return bytes([seat]) + BINARY + message


def parse_packet(data: bytes) -> tuple[int, bytes, bytes]:
    """Return seat, kind and message of a packet."""
    return data[0], data[1:2], data[2:]


def _run(connection: socket.socket, config: RoomConfig) -> None:
    """Serve a room until the socket is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that relays.
    connection.setblocking(False)
    room = Room(config)
    gc.collect()
    gc.freeze()
    try:
        while _turn(room, connection):
            pass
    except (BrokenPipeError, ConnectionResetError, TimeoutError):
        pass  # The process that relays has ended, or accepts nothing.
    finally:
        room.close()


def _turn(room: Room, connection: socket.socket) -> bool:
    """Wait for a message or the next frame, and answer; return whether to continue."""
    due = room.due
    timeout = 0.0 if room.has_work else None
    if due is not None:
        timeout = max(due - time.monotonic(), 0.0)
    ready = select.select([connection], [], [], timeout)[0]
    for _ in range(MOST_AT_ONCE if ready else 0):
        try:
            data = connection.recv(LARGEST_PACKET)
        except BlockingIOError:
            break
        if not data:
            return False
        _send(connection, _answer(room, data))
    due = room.due
    if due is not None:
        gc.disable()
        take_turn(TABLE)
        if due <= time.monotonic():
            _send(connection, room.tick(time.monotonic()))
    else:
        gc.enable()
        take_turn(ORDINARY)
        if not ready and room.has_work:
            _send(connection, room.work())
    return True


def _answer(room: Room, data: bytes) -> list[Message]:
    seat, kind, message = parse_packet(data)
    if kind == JOIN:
        return room.join(seat)
    if kind == LEAVE:
        return room.leave(seat)
    text = message.decode(errors="replace") if kind == JSON else message
    return room.receive(seat, text, time.monotonic())


def _send(connection: socket.socket, messages: list[Message]) -> None:
    for seat, message in messages:
        data = packet(seat, message)
        try:
            connection.send(data)
        except BlockingIOError:
            if not select.select([], [connection], [], SEND_S)[1]:
                raise TimeoutError from None
            connection.send(data)
