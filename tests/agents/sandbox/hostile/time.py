"""Policies that take the time of others."""

from .policy import LATE, Hostile

TIME = [
    Hostile(name="infinite loop", act="while True: pass", reason=LATE),
    Hostile(name="sleep", act="time.sleep(60)", reason=LATE),
    Hostile(name="sleep in reset", reset="time.sleep(60)", reason="took more than 2 s to start"),
    Hostile(name="sleep on import", top="time.sleep(60)", reason="no answer within 2 s"),
    Hostile(
        name="stops itself",
        reset="os.kill(os.getpid(), signal.SIGSTOP)",
        reason="took more than 2 s to start",
    ),
    Hostile(
        name="deaf to signals",
        reset="""
        for number in set(signal.Signals) - {signal.SIGKILL, signal.SIGSTOP}:
            signal.signal(number, signal.SIG_IGN)
        """,
        act="while True: pass",
        reason=LATE,
    ),
    Hostile(
        name="slow in all",
        act="time.sleep(0.1); return [0.0]",
        reason="took more than 2 s and 0.02 s a step in all",
    ),
    Hostile(
        name="burns processor time",
        top="signal.signal(signal.SIGXCPU, signal.SIG_DFL)",
        act="while time.process_time() < 30: pass",
        reason=LATE,
    ),
]
