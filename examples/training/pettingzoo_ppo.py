"""
PPO for both seats of the PettingZoo environment
================================================

The robot and the person both learn in the engine, each by its own PPO, in plain PyTorch: their
observations and actions differ, so they share no network. The person is rewarded for its private
target and for a level table, the robot for the level table alone. At the end, the robot is scored
on the quick suite, with the benchmark's people, whom it has not met. The CPU build of PyTorch is
enough, and smaller than the default build::

    pip install torch --index-url https://download.pytorch.org/whl/cpu

It takes five minutes of one processor core, and is not run by the tests or with the documentation.
With PyTorch 2.13.0 and PettingZoo 1.27.0 it printed an RMSE of 7.95 mm.
"""

import colift
import numpy as np
import torch
from colift.agents.agent import HumanObservation
from colift.agents.submissions.network.policy import CORRECTION, FIXED, Senses, line, scales
from torch import nn
from torch.distributions import Normal

STEPS = 20  # Steps of the human's motion that the robot sees.
ENVS, LENGTH, UPDATES = 8, 512, 50  # Environments, their steps per update, and updates.
EPOCHS, BATCH, RATE = 10, 256, 3e-4
DISCOUNT, TRACE, CLIP = 0.9, 0.9, 0.2


class Robot:
    """The robot's seat: a straight line through the human's last heights, and a correction."""

    inputs = FIXED + STEPS

    def __init__(self) -> None:
        self.senses = Senses(STEPS)

    def reset(self) -> None:
        """Begin a lift."""
        self.senses.reset()

    def sense(self, observation: np.ndarray) -> np.ndarray:
        """Return the inputs of the network."""
        self.seen = self.senses(observation)
        return self.seen / scales(STEPS)

    def act(self, correction: float) -> np.ndarray:
        """Return the change of the hands' height [m]."""
        return np.array([line(self.seen) + CORRECTION * np.clip(correction, -1, 1)])


class Person:
    """The person's seat: the private target, and the height at which the hand is held above it."""

    inputs = 14

    def reset(self) -> None:
        """Begin a lift."""

    def sense(self, observation: np.ndarray) -> np.ndarray:
        """Return the inputs of the network: target, own motion, other end and force."""
        self.target = observation[HumanObservation.TARGET]
        height = observation[HumanObservation.OWN_HEIGHT][-1]
        velocity = observation[HumanObservation.OWN_VELOCITY][-1]
        other = observation[HumanObservation.OTHER_END][-1] - height
        force = observation[HumanObservation.HAND_FORCE][-1]
        now = [height / 0.1, velocity / 0.2, other / 0.02, force / 10]
        return np.array([*now, *(self.target - height) / 0.02])

    def act(self, correction: float) -> np.ndarray:
        """Return the hand's reference in each frame of the step [m]."""
        return self.target + CORRECTION * np.clip(correction, -1, 1)


class Learner(nn.Module):
    """The networks of the corrections and of the value, and their optimiser."""

    def __init__(self, inputs: int) -> None:
        super().__init__()
        self.actor, self.critic = perceptron(inputs, 0.01), perceptron(inputs, 1.0)
        self.log_noise = nn.Parameter(torch.tensor(np.log(0.3), dtype=torch.float32))
        self.optimizer = torch.optim.Adam(self.parameters(), RATE, eps=1e-5)

    def policy(self, inputs: torch.Tensor) -> Normal:
        """Return the distribution of the corrections, in shares of the largest."""
        return Normal(self.actor(inputs).squeeze(-1), self.log_noise.exp())

    def value(self, inputs: torch.Tensor) -> torch.Tensor:
        """Return the estimated sum of the rewards to come."""
        return self.critic(inputs).squeeze(-1)

    def learn(self, inputs, actions, rewards, ended) -> None:
        """Improve the networks from a rollout; each argument has the axes (steps, environments)."""
        with torch.no_grad():
            values = self.value(inputs)
            before = self.policy(inputs[:-1]).log_prob(actions)
        advantage, gain = torch.zeros_like(rewards), torch.zeros(ENVS)
        for step in reversed(range(LENGTH)):
            going = 1 - ended[step]
            surprise = rewards[step] + DISCOUNT * going * values[step + 1] - values[step]
            gain = surprise + DISCOUNT * TRACE * going * gain
            advantage[step] = gain
        aim = advantage + values[:-1]
        flat = [each.flatten(0, 1) for each in (inputs[:-1], actions, before, advantage, aim)]
        for _ in range(EPOCHS):
            for chosen in torch.randperm(ENVS * LENGTH).split(BATCH):
                self.step(*(each[chosen] for each in flat))

    def step(self, inputs, actions, before, advantage, aim) -> None:
        """Take a step along the clipped objective."""
        advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
        ratio = (self.policy(inputs).log_prob(actions) - before).exp()
        gain = torch.min(ratio * advantage, ratio.clamp(1 - CLIP, 1 + CLIP) * advantage)
        loss = 0.5 * ((self.value(inputs) - aim) ** 2).mean() - gain.mean()
        self.optimizer.zero_grad()
        loss.backward()
        nn.utils.clip_grad_norm_(self.parameters(), 0.5)
        self.optimizer.step()


def perceptron(inputs: int, gain: float) -> nn.Sequential:
    """Return a network with two hidden layers, whose last weights are of the size ``gain``."""
    layers = [nn.Linear(inputs, 64), nn.Linear(64, 64), nn.Linear(64, 1)]
    for layer, size in zip(layers, (2**0.5, 2**0.5, gain), strict=True):
        nn.init.orthogonal_(layer.weight, size)
        nn.init.zeros_(layer.bias)
    first, second, last = layers
    return nn.Sequential(first, nn.Tanh(), second, nn.Tanh(), last)


def rollout(envs, seats, learners, now):
    """Play with both seats; return the last inputs, and the data for each learner."""
    played = {name: ([now[name]], [], [], []) for name in learners}
    for _ in range(LENGTH):
        with torch.no_grad():
            actions = {name: learners[name].policy(now[name]).sample() for name in learners}
        sensed = {name: [] for name in learners}
        paid = {name: [] for name in learners}
        over = []
        for index, env in enumerate(envs):
            own = seats[index]
            done = {name: own[name].act(float(actions[name][index])) for name in own}
            observations, rewards, dropped, at_end, _ = env.step(done)
            over.append(float(dropped["robot"] or at_end["robot"]))
            if over[-1]:
                observations, _ = env.reset()
            for name, seat in own.items():
                if over[-1]:
                    seat.reset()
                sensed[name].append(seat.sense(observations[name]))
                paid[name].append(rewards[name])
        now = {name: as_tensor(sensed[name]) for name in learners}
        for name, parts in played.items():
            new = (now[name], actions[name], as_tensor(paid[name]), as_tensor(over))
            for part, each in zip(parts, new, strict=True):
                part.append(each)
    return now, {name: [torch.stack(part) for part in parts] for name, parts in played.items()}


def as_tensor(values) -> torch.Tensor:
    """Return numbers in single precision."""
    return torch.as_tensor(np.array(values), dtype=torch.float32)


class Trained:
    """The trained robot as a policy of the benchmark."""

    def __init__(self, learner: Learner) -> None:
        self.learner, self.seat = learner, Robot()

    def reset(self, seed: int) -> None:
        """Begin a lift."""
        self.seat.reset()

    def act(self, observation: np.ndarray) -> np.ndarray:
        """Return the change of the hands' height [m]."""
        with torch.no_grad():
            mean = self.learner.policy(as_tensor(self.seat.sense(observation))).mean
        return self.seat.act(float(mean))


if __name__ == "__main__":
    torch.manual_seed(0)
    torch.set_num_threads(1)
    learners = {"human": Learner(Person.inputs), "robot": Learner(Robot.inputs)}
    envs = [colift.parallel_env("any", "draw", reward="score") for _ in range(ENVS)]
    seats = [{"human": Person(), "robot": Robot()} for _ in envs]
    first = {name: [] for name in learners}
    for seed, (env, own) in enumerate(zip(envs, seats, strict=True)):
        observations, _ = env.reset(seed=seed)
        for name, seat in own.items():
            seat.reset()
            first[name].append(seat.sense(observations[name]))
    now = {name: as_tensor(inputs) for name, inputs in first.items()}
    for update in range(UPDATES):
        now, played = rollout(envs, seats, learners, now)
        for name, learner in learners.items():
            learner.optimizer.param_groups[0]["lr"] = RATE * (1 - update / UPDATES)
            learner.learn(*played[name])
        means = {name: float(parts[2].mean()) for name, parts in played.items()}
        print(f"{(update + 1) * ENVS * LENGTH} steps, mean reward: {means}", flush=True)
    for env in envs:
        env.close()
    torch.save(learners["robot"].state_dict(), "pettingzoo_robot.pt")
    print(colift.evaluate(Trained(learners["robot"]), suite="quick-v1"))
