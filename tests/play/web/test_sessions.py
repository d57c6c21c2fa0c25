"""Who may sit where: keys on the disk, and secrets in links."""

import stat

import pytest
from colift.benchmark.real_lifts.session_folder import SESSION
from colift.play.web.sessions import NAME, ROLES, Sessions


def test_nobody_else_may_read_the_key_and_the_lifts(tmp_path):
    session = Sessions(tmp_path / "live").make()
    assert stat.S_IMODE((session.folder / SESSION).stat().st_mode) == 0o600
    assert stat.S_IMODE(session.folder.stat().st_mode) == 0o700
    assert session.key.hex() not in repr(session)


def test_each_role_has_a_secret_of_its_own_that_is_the_same_after_a_restart(tmp_path):
    session = Sessions(tmp_path).make()
    again = Sessions(tmp_path).find(session.name)
    secrets = [session.secret(role) for role in ROLES]
    assert len(set(secrets)) == len(ROLES)
    assert [again.secret(role) for role in ROLES] == secrets
    assert [again.role_of(secret) for secret in secrets] == list(ROLES)
    assert again.cue_seed == session.cue_seed


@pytest.mark.parametrize("wrong", ["", "a", "é" * 24, "\ud800"])
def test_no_other_text_is_a_secret(tmp_path, wrong):
    assert Sessions(tmp_path).make().role_of(wrong) is None


def test_a_secret_of_one_session_opens_no_other(tmp_path):
    sessions = Sessions(tmp_path)
    one, other = sessions.make(), sessions.make()
    assert [other.role_of(one.secret(role)) for role in ROLES] == [None] * len(ROLES)
    assert one.cue_seed != other.cue_seed


@pytest.mark.parametrize("name", ["", "..", "../live", "20270301-0123456789ab", "x" * 5000, "a\0"])
def test_a_session_that_is_not_there_is_not_found(tmp_path, name):
    assert Sessions(tmp_path).find(name) is None


def test_a_session_without_a_key_is_not_found(tmp_path):
    session = Sessions(tmp_path).make()
    assert NAME.fullmatch(session.name)
    (session.folder / SESSION).write_text("[]")
    assert Sessions(tmp_path).find(session.name) is None
