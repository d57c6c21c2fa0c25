"""A second fork server, inside a cell, that has imported the policy's module.

It belongs to the policy: what the module started or shared when it was imported survives an
episode. So two runs of the same episodes in another order, in fresh sandboxes, must agree.
"""

import os
import signal
import socket
from typing import Final

from ..errors import InputError
from .limits import REASON
from .server import load, safely_told, serve
from .wire import packed

_ORDER: Final = 1000


def serve_forks(handle: int, place: str, parameters: str, size: int) -> None:
    """Import the policy's module, then fork a process for each order on a socket.

    The first message on the socket is answered by ``[1, "loaded"]``, or by why it cannot be, as in
    :mod:`.server`. An order brings the ends of a connection and of the output.
    """
    orders = socket.socket(fileno=handle)
    orders.recv(_ORDER)
    try:
        policy = load(place)
    except InputError as error:
        orders.send(packed([1, "failed", str(error)[:REASON]]))
        return
    except BaseException as error:  # Whatever the module does, it does to itself.
        orders.send(packed([1, "failed", safely_told(error)]))
        return
    orders.send(packed([1, "loaded"]))
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    while True:
        order, ends, _, _ = socket.recv_fds(orders, _ORDER, 2)
        if not order:
            return
        data, output = ends
        if os.fork() == 0:
            orders.detach()  # The connection takes its place; what the module has opened stays.
            for end, number in ((output, 1), (output, 2), (data, handle)):
                os.dup2(end, number)
            os.close(data)
            os.close(output)
            serve(handle, place, parameters, size, policy)
            os._exit(0)
        os.close(data)
        os.close(output)
