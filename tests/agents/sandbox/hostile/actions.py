"""Policies whose answers are no actions."""

from .policy import LATE, NUMBERS, Hostile

ACTIONS = [
    Hostile(name="NaN", act="return [float('nan')]", reason="robot's action must be finite, .*"),
    Hostile(name="infinity", act="return [np.inf]", reason="robot's action must be finite, .*"),
    Hostile(name="none", act="return None", reason=NUMBERS + "None"),
    Hostile(name="text", act="return 'up'", reason=NUMBERS + "'up'"),
    Hostile(name="number as text", act="return '0.01'", reason=NUMBERS + "'0.01'"),
    Hostile(name="huge array", act="return np.zeros(10_000_000)", reason=NUMBERS + "array.*"),
    Hostile(name="endless list", act="return [0.0] * 10**6", reason=NUMBERS + r"\[0.0.*"),
    Hostile(name="wrong shape", act="return np.zeros((1, 1))", reason=NUMBERS + ".*"),
    Hostile(name="too many", act="return [0.0, 0.0]", reason=NUMBERS + r"\[0.0, 0.0\]"),
    Hostile(name="too few", act="return []", reason=NUMBERS + r"\[\]"),
    Hostile(name="complex", act="return [1j]", reason=NUMBERS + ".*"),
    Hostile(
        name="hostile __array__",
        top="""
        class Bad:
            def __array__(self, *arguments, **keywords): raise KeyError("no")
            def __repr__(self): raise KeyError("no")
        """,
        act="return Bad()",
        reason=NUMBERS + "a Bad that cannot be shown",
    ),
    Hostile(
        name="__array__ without end",
        top="""
        class Bad:
            def __array__(self, *arguments, **keywords):
                while True: pass
        """,
        act="return Bad()",
        reason=LATE,
    ),
    Hostile(
        name="hostile __float__",
        top="""
        class Bad:
            def __float__(self): os._exit(9)
        """,
        act="return [Bad()]",
        reason=r"ended its process \(exit code 9\)",
    ),
    Hostile(
        name="array of objects",
        act="return np.array([object()])",
        reason=NUMBERS + ".*",
    ),
    Hostile(
        name="internals that are none",
        more="def internals(self): return None",
        reason="TypeError: .*",
    ),
    Hostile(
        name="internals without end",
        more="def internals(self): return {str(i): 0.0 for i in range(10**5)}",
        reason="ValueError: more than 64 internals.*",
    ),
    Hostile(
        name="infinite internals",
        more="def internals(self): return {'role': float('inf')}",
        reason="its internals are not names and finite numbers",
    ),
    Hostile(
        name="internals that raise",
        more="def internals(self): raise ValueError('inside')",
        reason="ValueError: inside",
    ),
]
