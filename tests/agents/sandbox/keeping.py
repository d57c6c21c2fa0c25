"""What is left to a policy that wants to remember: the process that is forked counts its lifts.

It sees the order to fork, and so that there was a lift before, and how long it took.
"""

COUNTING = """
import socket

lifts = 0
received = socket.recv_fds

def counting(*arguments):
    global lifts
    order = received(*arguments)
    lifts += 1
    return order

socket.recv_fds = counting
"""
