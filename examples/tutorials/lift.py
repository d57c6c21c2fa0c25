"""A lift, step by step, with the scripted human."""

import colift

env = colift.parallel_env("pause", "S3")
observations, infos = env.reset(seed=7)
human = env.scripted_human()
error = []
while env.agents:
    human_end, robot_end, hand, command, time = observations["robot"]
    follow = 1.8 * (human_end - hand)
    actions = {"robot": follow, "human": human.act(observations["human"])}
    observations, rewards, terminations, truncations, infos = env.step(actions)
    error.append(-rewards["robot"])
env.close()
print(f"{1000 * max(error):.0f} mm apart at most, in {len(error)} steps")
