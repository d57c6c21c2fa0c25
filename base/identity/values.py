"""Values that definitions have once they are imported, whoever set them."""

from typing import Any, Final

PLAIN: Final = (bool, int, str, bytes, complex, type(None))


def value_text(value: object) -> str:
    """Return an immutable value as text: of a class, its attributes; of anything else, nothing.

    Another module or the environment may set them, where no source that is reached tells.
    """
    if isinstance(value, type):
        texts = {name: _text(each) for name, each in vars(value).items() if name[:2] != "__"}
        return " ".join([f"{name} {texts[name]}" for name in sorted(texts) if texts[name]])
    return "" if value is None else _text(value)


def _text(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.12g}"  # The last bits of functions depend on the machine.
    if isinstance(value, tuple):
        return f"({', '.join([_text(each) for each in value])})"
    if type(value) not in PLAIN:
        fields = () if isinstance(value, type) else getattr(value, "__dataclass_fields__", ())
        return _text(tuple(getattr(value, each) for each in fields)) if fields else ""
    is_path = isinstance(value, str) and ("/" in value or "\\" in value)
    return "" if is_path else repr(value)
