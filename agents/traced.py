"""Tracebacks of the errors of policies, for their authors."""

import traceback
from pathlib import Path

from colift.agents.agent import Action, Agent, Explaining, Observation, Printing


def own_traceback(error: BaseException, above: str, folder: Path | None = None) -> str:
    """Return the traceback of a policy's error, its files relative to a folder.

    Parameters
    ----------
    error
        The error.
    above
        Start of the paths of colift's files that call the policy; their frames are left out.
    folder
        The current one by default.
    """
    frames = error.__traceback__
    while frames is not None and frames.tb_frame.f_code.co_filename.startswith(above):
        frames = frames.tb_next
    text = "".join(traceback.format_exception(type(error), error, frames))
    return text.replace(f'File "{folder or Path.cwd()}/', 'File "')


class Traced:
    """An agent in this process whose output, for reports, is the traceback of its last error."""

    def __init__(self, agent: Agent) -> None:
        self._agent = agent
        self.printed = ""
        """The traceback; empty if no error was raised since the reset."""

    def reset(self, seed: int) -> None:
        """Reset the agent."""
        self.printed = ""
        try:
            self._agent.reset(seed)
        except (Exception, SystemExit) as error:
            self.printed = own_traceback(error, __file__)
            raise

    def act(self, observation: Observation) -> Action:
        """Return the agent's action."""
        try:
            return self._agent.act(observation)
        except (Exception, SystemExit) as error:
            self.printed = own_traceback(error, __file__)
            raise


class TracedExplaining(Traced):
    """The same of an agent that explains its actions."""

    def __init__(self, agent: Agent, explaining: Explaining) -> None:
        super().__init__(agent)
        self._explaining = explaining

    def internals(self) -> dict[str, float]:
        """Return the explanation of the agent's last action."""
        return self._explaining.internals()


def traced(agent: Agent) -> Agent:
    """Return an agent that keeps the traceback of its errors; itself if it keeps its output."""
    if isinstance(agent, Printing):
        return agent
    return TracedExplaining(agent, agent) if isinstance(agent, Explaining) else Traced(agent)
