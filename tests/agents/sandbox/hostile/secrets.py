"""Policies that look for what is not theirs, or write where they may not."""

from .policy import Hostile

SECRETS = [
    Hostile(name="board's secret", reset="denied(lambda: open('@secret@').read())"),
    Hostile(name="other submission", reset="denied(lambda: open('@other@').read())"),
    Hostile(
        name="other submissions",
        reset="""
        try:
            seen = os.listdir("@board@")
        except OSError:
            seen = []
        if set(seen) - {"mine"}: raise Through(str(seen))
        """,
    ),
    Hostile(name="suite's seeds", reset="denied(lambda: open('@suite@').read())"),
    Hostile(name="shadow", reset="denied(lambda: open('/etc/shadow').read())"),
    Hostile(name="disk", reset="denied(lambda: os.listdir('/var'))"),
    Hostile(
        name="write beside",
        # In a private /tmp it may: what it writes there is gone, as the files outside show.
        reset="""
        try:
            touch("@board@/written")
        except OSError:
            pass
        """,
    ),
    Hostile(name="write into its folder", reset="denied(lambda: touch('written'))"),
    Hostile(name="write into the system", reset="denied(lambda: touch('/usr/lib/written'))"),
    Hostile(
        name="link out of its folder",
        reset="""
        link = os.environ["TMPDIR"] + "/link"
        os.symlink("@secret@", link)
        denied(lambda: open(link).read())
        denied(lambda: open("../secret").read())
        denied(lambda: open("../other/policy.py").read())
        """,
    ),
    Hostile(
        name="folder of who scores",
        reset="denied(lambda: os.listdir('/proc/@process@/cwd'))",
    ),
    Hostile(name="write into packages", reset="denied(lambda: touch(np.__file__))"),
    Hostile(name="change itself", reset="denied(lambda: open(__file__, 'a'))"),
    Hostile(
        name="rewrite the kernel",
        reset="denied(lambda: os.open('/proc/sys/kernel/core_pattern', os.O_WRONLY))",
    ),
]
