"""What a manifest may say, and what is told where it is wrong."""

from importlib.resources import files

import pytest
from colift.agents.submissions.manifest import LONGEST, Manifest, read_manifest
from colift.agents.submissions.packages import PACKAGES
from colift.base.errors import InputError

GOOD = {
    "name": '"mine"',
    "authors": '["Ada Lovelace"]',
    "description": '"Does it."',
    "licence": '"MIT"',
    "trained_on": '"nothing"',
}


def written(**values):
    """Return a manifest with other values, or without those that are None."""
    content = {key: value for key, value in {**GOOD, **values}.items() if value is not None}
    return "".join(f"{key} = {value}\n" for key, value in content.items()).encode()


def test_what_is_not_said_has_a_default():
    assert read_manifest(written()) == Manifest(
        name="mine",
        authors=("Ada Lovelace",),
        description="Does it.",
        licence="MIT",
        trained_on="nothing",
        link="",
        entry_point="policy:Policy",
        packages=(),
        preload=False,
    )


def test_the_template_is_read():
    template = files("colift.agents.submissions") / "template" / "policy.toml"
    manifest = read_manifest(template.read_bytes())
    assert manifest.packages == ("numpy",)
    assert manifest.entry_point == "policy:Policy"


def test_the_template_names_every_package():
    text = (files("colift.agents.submissions") / "template" / "policy.toml").read_text()
    assert ", ".join(PACKAGES) in text


@pytest.mark.parametrize(
    ("key", "value", "kept"),
    [
        ("name", '"Fast blend v1.2+rc_3"', "Fast blend v1.2+rc_3"),
        ("authors", '["Ana Šimić", " 山田太郎 "]', ("Ana Šimić", "山田太郎")),
        ("description", '"""\nTwo\nlines."""', "Two\nlines."),
        ("link", '"https://example.org/a?b=c#d"', "https://example.org/a?b=c#d"),
        ("link", '""', ""),
        ("entry_point", '"nets.controller:Main"', "nets.controller:Main"),
        ("packages", '["numpy", "scipy", "numpy"]', ("numpy", "scipy")),
        ("preload", "true", True),
    ],
)
def test_good_values_are_kept(key, value, kept):
    assert getattr(read_manifest(written(**{key: value})), key) == kept


WRONG = [
    ("name", '""', "1 to 40 letters, digits, spaces"),
    ("name", "3", "got a number"),
    ("name", f'"{"a" * 41}"', "1 to 40 letters"),
    ("name", '" mine"', "1 to 40"),
    ("name", '"mine "', "1 to 40"),
    ("name", '"<b>mine</b>"', "got '<b>mine</b>'"),
    ("name", '"[red]mine"', "1 to 40"),
    ("name", '"../mine"', "1 to 40"),
    ("name", '"blend"', "differ from colift's own"),
    ("name", '"Minimum-Jerk"', "differ from colift's own"),
    ("name", '"human human"', "differ from colift's own"),
    ("authors", '"Ada"', "a list of 1 to 50 names"),
    ("authors", "[]", "a list of 1 to 50 names"),
    ("authors", '[""]', "1 to 200 characters"),
    ("authors", "[1]", "got a number"),
    ("authors", str(["a"] * 51), "a list of 1 to 50 names"),
    ("authors", r'["\u001b[2J"]', r"without control characters; got '\x1b[2J'"),
    ("authors", r'["a\u202eb"]', r"without control characters; got 'a\u202eb'"),
    ("description", '"  "', "1 to 1000 characters"),
    ("description", f'"{"a" * 1001}"', "(1001 characters)"),
    ("description", r'"\u0007"', "without control characters"),
    ("licence", "true", "got true"),
    ("licence", r'"a\nb"', "on one line"),
    ("trained_on", "1979-05-27", "got a date"),
    ("link", '"javascript:alert(1)"', "https:// or http://"),
    ("link", '"example.org"', "https:// or http://"),
    ("link", '"https://"', "https:// or http://"),
    ("link", '"https://a b"', "https:// or http://"),
    ("link", '"https://user@evil.org"', "https:// or http://"),
    ("link", '"http://[::1"', "https:// or http://"),
    ("link", "[]", "got a list"),
    ("entry_point", '"policy"', "module:Class"),
    ("entry_point", '":Policy"', "module:Class"),
    ("entry_point", '"policy:"', "module:Class"),
    ("entry_point", '"../policy:Policy"', "got '../policy:Policy'"),
    ("entry_point", '"..policy:Policy"', "module:Class"),
    ("entry_point", '"/etc/passwd:Policy"', "module:Class"),
    ("entry_point", '"a:b:c"', "module:Class"),
    ("entry_point", '"class:Policy"', "no keyword"),
    ("entry_point", '"random:Policy"', "random is a module of Python"),
    ("entry_point", '"numpy.x:Policy"', "numpy is a module of Python or of a package"),
    ("entry_point", '"colift.benchmark.episode.lift:Lift"', "colift is a module"),
    ("entry_point", "{ module = 1 }", "got a table"),
    ("packages", '"numpy"', "a list of some of: filterpy, numpy, scikit-learn, scipy"),
    ("packages", '["torch"]', "'torch', which boards do not provide; known: filterpy, numpy"),
    ("packages", "[[]]", "has a list, which"),
    ("preload", '"true"', "true or false, without quotes"),
    ("preload", "1", "true or false"),
]


@pytest.mark.parametrize(("key", "value", "told"), WRONG)
def test_wrong_values_are_refused_with_file_key_value_and_what_is_right(key, value, told):
    with pytest.raises(InputError) as caught:
        read_manifest(written(**{key: value}), "mine/policy.toml")
    message = str(caught.value)
    assert message.startswith(f"mine/policy.toml: {key} ")
    assert told in message
    assert len(message) < 500
    assert message.isprintable()


@pytest.mark.parametrize("key", GOOD)
def test_what_is_missing_is_named(key):
    with pytest.raises(InputError, match=f"policy.toml: {key} is missing; it must have name, "):
        read_manifest(written(**{key: None}))


@pytest.mark.parametrize(
    ("key", "told"),
    [
        ("license", "did you mean licence?"),
        ("author", "did you mean authors?"),
        ("entrypoint", "did you mean entry_point?"),
        ("package", "did you mean packages?"),
        (
            "zzz",
            "known: name, authors, description, licence, trained_on, link, model, view, entry_p",
        ),
        ('"\\u001b[2J"', r"unknown key '\x1b[2J'"),
        ("a" * 9000, "(9000 characters)"),
    ],
)
def test_unknown_keys_are_refused_with_the_nearest(key, told):
    with pytest.raises(InputError) as caught:
        read_manifest(written(**{key: "1"}))
    assert told in str(caught.value)
    assert str(caught.value).isprintable()


BOMBS = {
    "too long": (b"#" * (LONGEST + 1), f"at most {LONGEST} are allowed"),
    "deep lists": (b"name = " + b"[" * 8000, "too deep"),
    "deep tables": (b"name = " + b"{a=" * 4000, "too deep"),
    "dotted keys": (written(name=None) + b"name" + b".a" * 4000 + b" = 1", "got a table"),
    "long number": (b"name = " + b"9" * 9000, "digits"),
    "long hexadecimal number": (written(name="0x" + "f" * 9000), "got a number"),
    "many keys": (b"".join(b"k%d=1\n" % k for k in range(1500)), "unknown key 'k0'"),
    "no UTF-8": (b'name = "\xff"', "must be UTF-8; byte 8 is not"),
    "control characters": (b'name = "\x1b[2J"', "line 1"),
    "twice": (b"name = 1\nname = 2", "Cannot overwrite a value"),
    "no TOML": (b"name: mine", "line 1"),
    "nothing": (b"", "name is missing"),
    "binary": (bytes(range(256)), "policy.toml"),
}


@pytest.mark.parametrize("bomb", BOMBS)
def test_bombs_are_refused_in_a_line(bomb):
    data, told = BOMBS[bomb]
    with pytest.raises(InputError) as caught:
        read_manifest(data)
    assert told in str(caught.value)
    assert "policy.toml" in str(caught.value)
    assert len(str(caught.value)) < 500


def test_a_package_that_is_not_installed_is_named(monkeypatch):
    monkeypatch.setattr("colift.agents.submissions.fields.installed", lambda package: False)
    with pytest.raises(InputError, match=r"'scipy', which is not installed here: pip install"):
        read_manifest(written(packages='["scipy"]'))
