"""Addresses of the pages: at the service, and in a folder of files."""

from dataclasses import dataclass
from urllib.parse import quote


@dataclass(frozen=True)
class ServiceLinks:
    """The addresses of the service."""

    root: str = ""
    """Path below which it is served, without a slash at its end."""
    documentation: str = ""
    """Address of the documentation, if there is one."""
    lifting: str = ""
    """Address of live lifts, if there are any."""

    @property
    def live(self) -> bool:
        """Whether the board takes submissions: a service does."""
        return True

    def board(self, season: str | None = None) -> str:
        """Return ``/`` or ``/seasons/SEASON``."""
        return f"{self.root}/" if season is None else self._season(season)

    def policy(self, season: str, digest: str) -> str:
        """Return ``/seasons/SEASON/policies/DIGEST``."""
        return f"{self._season(season)}/policies/{quote(digest)}"

    def replays(self, season: str, digest: str) -> str:
        """Return ``/seasons/SEASON/policies/DIGEST/replays``."""
        return f"{self.policy(season, digest)}/replays"

    def replay(self, season: str, digest: str, name: str) -> str:
        """Return ``/seasons/SEASON/policies/DIGEST/replays/NAME.html``."""
        return f"{self.replays(season, digest)}/{quote(name)}.html"

    def compare(self, season: str) -> str:
        """Return ``/seasons/SEASON/compare``."""
        return f"{self._season(season)}/compare"

    def scenarios(self, season: str) -> str:
        """Return ``/seasons/SEASON/scenarios``."""
        return f"{self._season(season)}/scenarios"

    def scenario(self, season: str, behaviour: str, subject: str) -> str:
        """Return ``/seasons/SEASON/scenarios/BEHAVIOUR/SUBJECT``."""
        return f"{self.scenarios(season)}/{quote(behaviour)}/{quote(subject)}"

    def method(self) -> str:
        """Return ``/method``."""
        return f"{self.root}/method"

    def submit(self) -> str:
        """Return ``/submit``."""
        return f"{self.root}/submit"

    def job(self, job: str) -> str:
        """Return ``/jobs/JOB``."""
        return f"{self.root}/jobs/{quote(job)}"

    def csv(self, season: str) -> str:
        """Return the API's CSV."""
        return f"{self.root}/api/v1/standings.csv?season={quote(season)}"

    def json(self, season: str) -> str:
        """Return the API's JSON."""
        return f"{self.root}/api/v1/standings?season={quote(season)}"

    def bundle(self, season: str, digest: str) -> str:
        """Return the API's archive."""
        return f"{self.root}/api/v1/entries/{quote(season)}/{quote(digest)}/bundle.zip"

    def feed(self, season: str) -> str:
        """Return ``/seasons/SEASON/feed.atom``."""
        return f"{self._season(season)}/feed.atom"

    def badge(self, season: str, digest: str) -> str:
        """Return ``/seasons/SEASON/policies/DIGEST/badge.svg``."""
        return f"{self.policy(season, digest)}/badge.svg"

    def open(self) -> str:
        """Return ``/open``."""
        return f"{self.root}/open"

    def template(self) -> str:
        """Return ``/template.zip``."""
        return f"{self.root}/template.zip"

    def api(self) -> str:
        """Return ``/api``."""
        return f"{self.root}/api"

    def docs(self, page: str = "") -> str:
        """Return the address of the documentation, or of one of its pages; nothing without one."""
        if not (self.documentation and page):
            return self.documentation
        return f"{self.documentation.removesuffix('index.html').rstrip('/')}/{page}.html"

    def play(self) -> str:
        """Return ``/play/``; nothing without live lifts."""
        return self.lifting

    def asset(self, name: str) -> str:
        """Return ``/static/NAME``."""
        return f"{self.root}/static/{name}"

    def _season(self, season: str) -> str:
        return f"{self.root}/seasons/{quote(season)}"


@dataclass(frozen=True)
class SiteLinks:
    """The names of files, all in one folder except styles, scripts and data."""

    current: str
    """Name of the season whose table is ``index.html``."""

    @property
    def live(self) -> bool:
        """Whether the board takes submissions: files do not."""
        return False

    def board(self, season: str | None = None) -> str:
        """Return ``index.html`` or ``season-SEASON.html``."""
        return "index.html" if season in (None, self.current) else f"season-{season}.html"

    def policy(self, season: str, digest: str) -> str:
        """Return ``policy-SEASON-DIGEST.html``."""
        return f"policy-{season}-{digest[:16]}.html"

    def replays(self, season: str, digest: str) -> str:
        """Return ``replays-SEASON-DIGEST.html``."""
        return f"replays-{season}-{digest[:16]}.html"

    def replay(self, season: str, digest: str, name: str) -> str:
        """Return ``replay-SEASON-DIGEST-NAME.html``."""
        return f"replay-{season}-{digest[:16]}-{name}.html"

    def compare(self, season: str) -> str:
        """Return ``compare-SEASON.html``."""
        return f"compare-{season}.html"

    def scenarios(self, season: str) -> str:
        """Return ``scenarios-SEASON.html``."""
        return f"scenarios-{season}.html"

    def scenario(self, season: str, behaviour: str, subject: str) -> str:
        """Return ``scenario-SEASON-BEHAVIOUR-SUBJECT.html``."""
        return f"scenario-{season}-{behaviour}-{subject}.html"

    def method(self) -> str:
        """Return ``method.html``."""
        return "method.html"

    def submit(self) -> str:
        """Return ``submit.html``."""
        return "submit.html"

    def job(self, job: str) -> str:
        """Return the page on submitting: there are no jobs without a service."""
        return self.submit()

    def rows(self, season: str, page: int) -> str:
        """Return the address of a page of rows: the board's page is the first."""
        return self.board(season) if page == 1 else f"rows-{season}-{page}.html"

    def rest(self, season: str) -> str:
        """Return ``data/SEASON-rows.js``, which has the rows behind the first page."""
        return f"data/{season}-rows.js"

    def csv(self, season: str) -> str:
        """Return ``data/SEASON.csv``."""
        return f"data/{season}.csv"

    def json(self, season: str) -> str:
        """Return ``data/SEASON.json``."""
        return f"data/{season}.json"

    def bundle(self, season: str, digest: str) -> str:
        """Return ``data/SEASON-DIGEST.zip``."""
        return f"data/{season}-{digest[:16]}.zip"

    def feed(self, season: str) -> str:
        """Return ``data/SEASON.atom``."""
        return f"data/{season}.atom"

    def badge(self, season: str, digest: str) -> str:
        """Return ``data/SEASON-DIGEST.svg``."""
        return f"data/{season}-{digest[:16]}.svg"

    def open(self) -> str:
        """Return ``open.html``."""
        return "open.html"

    def template(self) -> str:
        """Return ``data/template.zip``."""
        return "data/template.zip"

    def api(self) -> str:
        """Return nothing."""
        return ""

    def docs(self, page: str = "") -> str:
        """Return nothing."""
        return ""

    def play(self) -> str:
        """Return nothing: lifts need a service."""
        return ""

    def asset(self, name: str) -> str:
        """Return ``static/NAME``."""
        return f"static/{name}"


Links = ServiceLinks | SiteLinks
"""The addresses of the pages, for links between them."""
